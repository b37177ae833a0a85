#include "base/text/markup.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(MarkupText, IsTextAndNoMarkup) {
  EXPECT_EQ(markup_text("<b> & \"Co\""), "&lt;b&gt; &amp; &quot;Co&quot;");
  EXPECT_EQ(markup_text("Östliche\nKarwendelspitze"), "Östliche\nKarwendelspitze");
}

TEST(MarkupText, WhatXmlCannotHoldIsABlank) {
  EXPECT_EQ(markup_text(std::string("a\0b\x01"
                                    "c",
                                    5)),
            "a b c");
}

TEST(FilledPage, WordsOfTheTemplateBecomeTheirTexts) {
  EXPECT_EQ(filled_page("<h1>{title}</h1> {a} b { c: {title} }", {{"title", "of {a}"}, {"a", "1"}}),
            "<h1>of {a}</h1> 1 b { c: of {a} }");
  EXPECT_EQ(filled_page("open {", {}), "open {");
}

TEST(ScriptJson, NoTextEndsTheScript) {
  EXPECT_EQ(script_json("{\"name\": \"</script><!--\"}"),
            "{\"name\": \"\\u003c/script>\\u003c!--\"}");
}

}  // namespace
}  // namespace belvedere
