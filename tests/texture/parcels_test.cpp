#include "texture/parcels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace belvedere {
namespace {

TEST(Parcels, CropsChangeOnlyAtBorders) {
  double last_border = 0.0;
  float last_crop = 2.F;
  int changes = 0;
  for (int step = 0; step < 4000; ++step) {
    const Parcel parcel = parcel_at(3, 680000.0 + step, 5236000.0, 0.F);
    EXPECT_GE(parcel.border_m, 0.F);
    EXPECT_LE(std::abs(parcel.crop), 0.5F);
    if (step > 0 && parcel.crop != last_crop) {
      ++changes;
      // Within a step of 1 m both sides are about as near to the border.
      EXPECT_LT(parcel.border_m, 3.F);
      EXPECT_LT(last_border, 3.0);
    }
    last_crop = parcel.crop;
    last_border = static_cast<double>(parcel.border_m);
  }
  EXPECT_GT(changes, 12);
}

TEST(Parcels, StaysOfASizeThatCanBePainted) {
  // 60 m in half a millimetre: parcels of 90 m would be dots.
  const Parcel near = parcel_at(3, 680000.0, 5236000.0, 2.F);
  const Parcel far = parcel_at(3, 680000.0, 5236000.0, 60.F);
  EXPECT_FLOAT_EQ(near.width_m, 90.F);
  EXPECT_GE(far.width_m, 8.F * 60.F);
  EXPECT_LT(far.width_m, 16.F * 60.F);
}

TEST(Parcels, AreManyKinds) {
  std::set<float> crops;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y) crops.insert(parcel_at(3, 100.0 * x, 100.0 * y, 0.F).crop);
  EXPECT_GT(crops.size(), 300U);
}

}  // namespace
}  // namespace belvedere
