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

}  // namespace
}  // namespace belvedere
