#include "base/text/hex_colour.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(HexColour, IsReadAsItIsWritten) {
  EXPECT_EQ(hex_colour({0.F, 0.5F, 1.F}), "#0080ff");
  EXPECT_EQ(hex_colour({-1.F, 2.F, 0.2F}), "#00ff33");
  for (int byte = 0; byte < 256; ++byte) {
    const glm::vec3 colour = glm::vec3(byte, 255 - byte, byte / 2) / 255.F;
    EXPECT_EQ(colour_of_hex(hex_colour(colour)), colour);
  }
  EXPECT_EQ(colour_of_hex("#C0fFeE"), glm::vec3(0xc0, 0xff, 0xee) / 255.F);
}

TEST(HexColour, OtherTextsAreNone) {
  for (const char* text :
       {"", "#", "c0ffee", "#c0ffe", "#c0ffee0", "#c0ffeg", "# 0ffee", "#-0ffee", "#0x0000", "red"})
    EXPECT_FALSE(colour_of_hex(text)) << text;
}

}  // namespace
}  // namespace belvedere
