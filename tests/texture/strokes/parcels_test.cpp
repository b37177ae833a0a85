#include "texture/strokes/parcels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace belvedere {
namespace {

constexpr glm::vec2 eastward{1.F, 0.F};  // a = 0
constexpr double east = 680000.0;
constexpr double north = 5236000.0;

TEST(Parcels, CropsChangeOnlyAtBorders) {
  Parcel last;
  int changes = 0;
  for (int step = 0; step < 4000; ++step) {
    const Parcel parcel = parcel_at(3, east + step, north, 0.F, eastward);
    EXPECT_GE(parcel.border_m, 0.F);
    EXPECT_LE(std::abs(parcel.shade), 1.F);
    if (step > 0 && (parcel.crop != last.crop || parcel.shade != last.shade)) {
      ++changes;
      // Within a step of 1 m both sides are at about the same distance from the border.
      EXPECT_LT(parcel.border_m, 3.F);
      EXPECT_LT(last.border_m, 3.F);
    }
    last = parcel;
  }
  EXPECT_GT(changes, 12);
}

TEST(Parcels, StaysOfASizeThatCanBePainted) {
  // 60 m in half a millimetre: parcels of 90 m would be dots.
  const Parcel near = parcel_at(3, east, north, 2.F);
  const Parcel far = parcel_at(3, east, north, 60.F);
  EXPECT_FLOAT_EQ(near.width_m, 90.F);
  EXPECT_GE(far.width_m, 8.F * 60.F);
  EXPECT_LT(far.width_m, 16.F * 60.F);
}

TEST(Parcels, GreenDominatesAndTheMeanIsThatOfWhatIsSown) {
  std::map<Crop, int> count;
  glm::dvec3 sum(0.0);
  constexpr int side = 120;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y) {
      const Parcel parcel = parcel_at(3, 170.0 * x, 170.0 * y, 0.F);
      ++count[parcel.crop];
      sum += glm::dvec3(crop_colour(parcel.crop));
    }
  constexpr double all = side * side;
  const double yellow = (count[Crop::ripe] + count[Crop::stubble]) / all;
  EXPECT_GT((count[Crop::hay] + count[Crop::grass] + count[Crop::clover]) / all, 0.6);
  EXPECT_GT(yellow, 0.03);
  EXPECT_LT(yellow, 0.2);
  EXPECT_GT(count[Crop::ploughed] / all, 0.01);
  EXPECT_LT(count[Crop::ploughed] / all, 0.1);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / all, mean_crop_colour()[c], 0.015);
}

// How often two positions `step` apart are separated by a border, counted over a square.
double changes(glm::dvec2 step, glm::vec2 grain) {
  int changed = 0;
  for (int x = 0; x < 90; ++x)
    for (int y = 0; y < 90; ++y) {
      const glm::dvec2 position{east + 97.0 * x, north + 97.0 * y};
      const Parcel a = parcel_at(5, position.x, position.y, 0.F, grain);
      const Parcel b = parcel_at(5, position.x + step.x, position.y + step.y, 0.F, grain);
      changed += a.shade != b.shade ? 1 : 0;
    }
  return changed / 8100.0;
}

TEST(Parcels, RunAlongTheGrain) {
  // Long strips: the next one is closer across them. Some blocks are perpendicular, so the ratio is
  // moderate.
  EXPECT_GT(changes({0.0, 50.0}, eastward), 1.15 * changes({50.0, 0.0}, eastward));
  EXPECT_GT(changes({50.0, 0.0}, -eastward), 1.15 * changes({0.0, 50.0}, -eastward));  // a = 90°
  EXPECT_NEAR(changes({0.0, 50.0}, glm::vec2(0.F)) / changes({50.0, 0.0}, glm::vec2(0.F)), 1.0,
              0.15);
}

TEST(Parcels, BlocksDifferInTheirFields) {
  // Mean distance to a border, block by block: undivided meadows have distant borders, strips near
  // ones.
  std::map<float, float> widest;  // by shade: one number per parcel
  for (int x = 0; x < 300; ++x)
    for (int y = 0; y < 300; ++y) {
      const Parcel parcel = parcel_at(3, east + 20.0 * x, north + 20.0 * y, 0.F, eastward);
      float& w = widest[parcel.shade];
      w = std::max(w, parcel.border_m);
    }
  int narrow = 0;
  int wide = 0;
  for (const auto& [shade, w] : widest) {
    narrow += w > 10.F && w < 45.F ? 1 : 0;
    wide += w > 150.F ? 1 : 0;
  }
  EXPECT_GT(narrow, 100);
  EXPECT_GT(wide, 10);
}

}  // namespace
}  // namespace belvedere
