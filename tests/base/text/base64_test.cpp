#include "base/text/base64.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

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

}  // namespace
}  // namespace belvedere
