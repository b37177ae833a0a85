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
  const Error unknown = error_of([] { check_text_encoding("latin-nine", "p.shp"); });
  EXPECT_EQ(unknown.kind(), ErrorKind::usage);
  EXPECT_THAT(unknown.what(), HasSubstr("latin-nine"));
  EXPECT_NO_THROW(check_text_encoding("windows-1252", "p.shp"));
  const Error wrong = error_of([] { text_to_utf8("abc\xf6rner", "UTF-8", "a.csv"); });
  EXPECT_THAT(wrong.what(), HasSubstr("byte 3"));
}

}  // namespace
}  // namespace belvedere
