#include "base/text/text_encoding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere {
namespace {

using test::error_of;
using testing::HasSubstr;

TEST(TextEncoding, TextBecomesUtf8) {
  EXPECT_EQ(text_to_utf8("W\xf6rner", "ISO-8859-1", "a.csv"), "Wörner");
  EXPECT_EQ(text_to_utf8("\xcc\xee\xed\xf2", "windows-1251", "a.csv"), "Монт");
  EXPECT_EQ(text_to_utf8(std::string("\xff\xfe"
                                     "A\0\xf6\0",
                                     6),
                         "UTF-16", "a.csv"),
            "Aö");
}

TEST(TextEncoding, UnknownNamesAndWrongBytesAreRefused) {
  EXPECT_THAT(test::usage_error([] { check_text_encoding("latin-nine", "p.shp"); }),
              HasSubstr("latin-nine"));
  EXPECT_NO_THROW(check_text_encoding("windows-1252", "p.shp"));
  const Error wrong = error_of([] { text_to_utf8("abc\xf6rner", "UTF-8", "a.csv"); });
  EXPECT_THAT(wrong.what(), HasSubstr("byte 3"));
}

TEST(TextEncoding, Utf8IsReturnedWithoutItsByteOrderMark) {
  EXPECT_EQ(require_utf8("\xef\xbb\xbf"
                         "a = \"ö\"\r\n",
                         "a.toml"),
            "a = \"ö\"\r\n");
  EXPECT_EQ(require_utf8("", "a.toml"), "");
  EXPECT_EQ(require_utf8("𐍈", "a.toml"), "𐍈");
}

// The position of the first byte that is wrong; columns count letters.
TEST(TextEncoding, AByteOfACodePageIsNamedWithItsPosition) {
  const Error error =
      error_of([] { require_utf8("a = 1\nb = \"Öf\xf6\"\n", "my scene.toml", "its key"); });
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(error.where(), "my scene.toml:2:8");
  EXPECT_THAT(error.found(), HasSubstr("byte 14 is 0xF6, in Windows-1252 \"ö\""));
  EXPECT_THAT(error.allowed(),
              HasSubstr("iconv -f WINDOWS-1252 -t UTF-8 'my scene.toml' > 'my scene_utf8.toml'"));
  EXPECT_THAT(error.allowed(), HasSubstr("or its key"));
  // Windows-1252 has no letter 0x81; a text that ends within a letter; half of a surrogate pair.
  EXPECT_THAT(error_of([] { require_utf8("\x81", "a.csv"); }).found(), HasSubstr("is 0x81"));
  EXPECT_EQ(error_of([] { require_utf8("ab\xc3", "a.csv"); }).where(), "a.csv:1:3");
  EXPECT_EQ(error_of([] { require_utf8("\xed\xa0\x80", "a.csv"); }).where(), "a.csv:1:1");
  EXPECT_THAT(error_of([] {
                require_utf8({"a = 1\n\n\n\n\0x", 11}, "a.csv");
              }).found(),
              HasSubstr("byte 9 is zero"));
}

TEST(TextEncoding, WideTextIsNamedWithAndWithoutItsMark) {
  for (const char* encoding : {"UTF-16LE", "UTF-16BE", "UTF-32LE", "UTF-32BE"}) {
    const bool wide = std::string(encoding).starts_with("UTF-32");
    const bool little = std::string(encoding).ends_with("LE");
    const std::size_t size = wide ? 4 : 2;
    std::string text;
    for (const char c : std::string("a = 1 # and more text, ASCII\n")) {
      std::string unit(size, '\0');
      unit[little ? 0 : size - 1] = c;
      text += unit;
    }
    const std::string mark = little ? std::string("\xff\xfe\0\0", size)
                                    : std::string("\0\0\xfe\xff", 4).substr(4 - size);
    const Error marked = error_of([&] { require_utf8(mark + text, "a.toml"); });
    EXPECT_THAT(marked.what(), HasSubstr(encoding));
    EXPECT_THAT(marked.what(), HasSubstr("byte order mark"));
    EXPECT_THAT(marked.what(), HasSubstr(std::string("iconv -f ") + encoding));
    EXPECT_EQ(marked.where(), "a.toml:1:1");
    if (wide) continue;  // without a mark it is no text
    const Error bare = error_of([&] { require_utf8(text, "a.toml"); });
    EXPECT_THAT(bare.what(), HasSubstr(encoding));
    EXPECT_THAT(bare.what(), HasSubstr(little ? "byte 1 is zero" : "byte 0 is zero"));
  }
}

TEST(Letters, AreMadeSmall) {
  EXPECT_EQ(lower_case("Grüße AZ az @[ 09"), "grüße az az @[ 09");
  EXPECT_EQ(lower_extension("Folder.X/Dem.TIF"), ".tif");
  EXPECT_EQ(lower_extension("folder.x/dem"), "");
  EXPECT_EQ(lower_extension("x.tar.GZ"), ".gz");
  EXPECT_EQ(lower_extension("x.ÄÖ"), ".ÄÖ")
      << "letters of other alphabets are left alone, whatever the locale";
}

TEST(Letters, LongNumbersAreGrouped) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1 000");
  EXPECT_EQ(grouped(1234567), "1 234 567");
}

// RFC 4648, section 10.
TEST(Base64, IsThePublishedOneBothWays) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64_bytes(text), bytes);
  }
}

TEST(Base64, AllBytesComeBack) {
  std::string all;
  for (int k = 0; k < 256; ++k) all += static_cast<char>(k);
  EXPECT_EQ(base64_bytes(base64(all)), all);
}

TEST(Base64, OtherTextsAreNone) {
  for (const char* text : {"Z", "Zg", "Zg=", "Zh==", "Zm9=", "Zm 9", "Zm9v\n", "=Zm9", "Zg==Zg=="})
    EXPECT_FALSE(base64_bytes(text)) << text;
}

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

TEST(OneLine, LineFeedsAndBackslashesComeBack) {
  const std::string text = "a\nb\\n\\\\c\n";
  EXPECT_EQ(on_one_line(text), "a\\nb\\\\n\\\\\\\\c\\n");
  EXPECT_EQ(from_one_line(on_one_line(text)), text);
  EXPECT_EQ(from_one_line("a\\"), "a\\");
}

}  // namespace
}  // namespace belvedere
