#include "base/text/letters.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

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

}  // namespace
}  // namespace belvedere
