#include "renderer/stages/seam_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/statistical/texture_crops.h"

namespace belvedere {
namespace {

constexpr int square_px = 120;

// The meadow in other colours.
Grid<Rgb8> heath(int width, int height) {
  Grid<Rgb8> out = test::meadow_crop(width, height, 41);
  for (Rgb8& c : out)
    c = {static_cast<std::uint8_t>(std::min(255, c[0] + 50)), static_cast<std::uint8_t>(c[1] / 2),
         c[2]};
  return out;
}

SeamSample sample_of(const Grid<Rgb8>& picture) {
  return {picture, Grid<std::uint8_t>(picture.width(), picture.height(), 1)};
}

const CliqueModel& border_model() {
  static const CliqueModel model =
      *learn_seam(sample_of(test::meadow_crop(96, 96, 9)), sample_of(heath(96, 96)));
  return model;
}

// Meadow next to heath along a bent line, with a piece of sky that belongs to neither.
struct Bent {
  Grid<Rgb8> picture = test::meadow_crop(square_px, square_px);
  SeamZone zone{Grid<std::uint8_t>(square_px, square_px, 1),
                Grid<std::uint8_t>(square_px, square_px)};
  Bent() {
    const Grid<Rgb8> other = heath(square_px, square_px);
    for (const auto [x, y] : test::cells(square_px, square_px)) {
      const int from = 60 + static_cast<int>(6.0 * gaussian_noise(3, 0.0, y, 8.0));
      if (x >= from) {
        picture(x, y) = other(x, y);
        zone.side(x, y) = 2;
      }
      if (x >= from - seam_half_px && x < from + seam_half_px) zone.hole(x, y) = 1;
      if (y < 20 && x > 50) {
        picture(x, y) = {255, 255, 255};
        zone.side(x, y) = 0;
        zone.hole(x, y) = 0;
      }
    }
  }
};

// Mean step of colour between neighbours of two sides, relative to that inside one.
double step_ratio(const Grid<Rgb8>& picture, const SeamZone& zone) {
  double across = 0.0;
  double inside = 0.0;
  int n_across = 0;
  int n_inside = 0;
  for (const auto [x, y] : test::cells({1, 20, square_px, square_px})) {
    double step = 0.0;
    for (std::size_t c = 0; c < 3; ++c) step += std::abs(picture(x, y)[c] - picture(x - 1, y)[c]);
    if (zone.side(x, y) != zone.side(x - 1, y)) {
      across += step;
      ++n_across;
    } else if (zone.hole(x, y) == 0 && zone.hole(x - 1, y) == 0) {
      inside += step;
      ++n_inside;
    }
  }
  return across / n_across / (inside / n_inside);
}

TEST(KnitSeam, OnlyTheHoleChangesAndLittleOfTheSeamIsLeft) {
  const Bent bent;
  const Grid<Rgb8> with_seam = synthesize_seam(bent.picture, bent.zone, {}, border_model(), 3);
  for (std::size_t i = 0; i < with_seam.size(); ++i)
    ASSERT_TRUE(bent.zone.hole[i] != 0 || with_seam[i] == bent.picture[i]) << i;
  const double hard = step_ratio(bent.picture, bent.zone);
  const double soft = step_ratio(with_seam, bent.zone);
  EXPECT_GT(hard, 5.0);
  EXPECT_LT(soft - 1.0, .5 * (hard - 1.0)) << "of " << hard;
  // Sky belongs to neither square_px: no pixel turns white.
  for (std::size_t i = 0; i < with_seam.size(); ++i)
    ASSERT_TRUE(bent.zone.hole[i] == 0 || with_seam[i][2] < 140) << i;
}

TEST(KnitSeam, TheSameBitsForAnyThreads) {
  const Bent bent;
  std::vector<Grid<Rgb8>> made;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    made.push_back(synthesize_seam(bent.picture, bent.zone, {}, border_model(), 3));
  }
  EXPECT_EQ(made[0], made[1]);
}

TEST(KnitSeam, TooLittleIsNotLearnt) {
  SeamSample few = sample_of(heath(96, 96));
  std::fill(few.counts.begin() + 1000, few.counts.end(), std::uint8_t{0});
  EXPECT_FALSE(learn_seam(few, few));
  EXPECT_FALSE(learn_seam(sample_of(Grid<Rgb8>(96, 96, Rgb8{9, 9, 9})),
                          sample_of(Grid<Rgb8>(96, 96, Rgb8{9, 9, 9}))));
  EXPECT_TRUE(learn_seam(few, sample_of(heath(64, 64))));
}

}  // namespace
}  // namespace belvedere
