#include "renderer/image/srgb.h"

#include <gtest/gtest.h>

#include <cmath>


namespace belvedere {
namespace {

TEST(SrgbTable, IsTheCurveToWithinAFloat) {
  for (int k = 0; k <= 1000000; ++k) {
    const float encoded = static_cast<float>(k) * 1e-6F;
    const auto truth = static_cast<float>(srgb_decoded(static_cast<double>(encoded)));
    const float found = srgb_decoded_fast(encoded);
    ASSERT_GE(found, std::nextafter(truth, -1.F)) << encoded;
    ASSERT_LE(found, std::nextafter(truth, 2.F)) << encoded;
  }
}

TEST(SrgbTable, RisesThroughItsKnotsAndItsEnds) {
  EXPECT_EQ(srgb_decoded_fast(0.F), 0.F);
  EXPECT_EQ(srgb_decoded_fast(1.F), 1.F);
  float before = -1.F;
  for (int k = 0; k <= 4096; ++k) {
    const float next = srgb_decoded_fast(static_cast<float>(k) / 4096.F);
    EXPECT_GT(next, before) << k;
    before = next;
  }
}

TEST(SrgbTable, BeyondWhatFilesHoldItIsTheCurve) {
  for (const float encoded : {-0.25F, -1e-3F, 1.0001F, 1.7F}) {
    EXPECT_EQ(srgb_decoded_fast(encoded),
              static_cast<float>(srgb_decoded(static_cast<double>(encoded))))
        << encoded;
  }
  EXPECT_TRUE(std::isnan(srgb_decoded_fast(std::nanf(""))));
}

}  // namespace
}  // namespace belvedere
