#include "texture/statistical/clique_polish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/random.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/difference_histogram.h"
#include "texture/statistical/learn_texture.h"
#include "texture/statistical/make_texture.h"

namespace belvedere {
namespace {

CliqueModel model_of(const Grid<Rgb8>& crop) {
  LearnParameters parameters;
  parameters.levels = 0;
  parameters.types = 18;
  return learn_texture(crop, {}, parameters).model;
}

double off(const BandPicture& picture, const BandPicture& example, const CliqueModel& model) {
  double sum = 0.0;
  for (const Clique& clique : model.cliques)
    sum += HistogramGroups(count_differences(example, model.bands, clique.type))
               .distance(count_differences(picture, model.bands, clique.type))
               .l1;
  return sum / static_cast<double>(model.cliques.size());
}

BandPicture grey(const CliqueModel& model, int side) {
  BandPicture picture(side, side);
  for (int b = 0; b < 3; ++b) {
    const auto at = static_cast<std::size_t>(b);
    for (float& v : picture.bands[at]) v = .5F * (model.bands.low[at] + model.bands.high[at]);
  }
  return picture;
}

// From one flat colour, sampling alone reaches the crop's statistics.
TEST(CliquePolish, ComesNearTheModelByItself) {
  const Grid<Rgb8> crop = test::meadow_crop(96, 96);
  const CliqueModel model = model_of(crop);
  const BandPicture example = to_bands(crop, model.bands, {});
  FlowState state{{grey(model, 96)}, {}};
  const double before = off(state.pyramid[0], example, model);
  polish(state, model, 0, {.sweeps = 40}, {});
  EXPECT_LT(off(state.pyramid[0], example, model), .5 * before);
}

// Dark paint with a bright dot here and there, as flowers in the shade.
Grid<Rgb8> dotted_crop(int side) {
  Grid<Rgb8> crop = test::meadow_crop(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      for (std::uint8_t& c : crop(x, y)) c = static_cast<std::uint8_t>(c / 3);
      if (random_uniform(4, x / 2, y / 2) < .004) crop(x, y) = {235, 230, 200};
    }
  return crop;
}

// The dots are few differences of many types: with almost no floor they are requested until
// everything else is wrong.
TEST(CliquePolish, WhatHardlyEverOccursDoesNotTakeOver) {
  const Grid<Rgb8> crop = dotted_crop(128);
  CliqueModel model = model_of(crop);
  model.polish = false;
  const BandPicture example = to_bands(crop, model.bands, {});
  const BandPicture flowed = to_bands(make_texture(model, 192, 192, {}), model.bands, {});
  const auto off_with = [&](double share_floor) {
    FlowState state{{flowed}, {}};
    polish(state, model, 0, {.share_floor = share_floor}, {});
    return off(state.pyramid[0], example, model);
  };
  EXPECT_LT(off_with(PolishParameters{}.share_floor), .85 * off_with(sampler_share_floor));
}

TEST(CliquePolish, WhatMayNotChangeStays) {
  const CliqueModel model = model_of(test::meadow_crop(64, 64));
  BandPicture picture = grey(model, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 20; ++x) picture.states(x, y) = pixel_counts;
  FlowState state{{picture}, {}};
  polish(state, model, 0, {.sweeps = 5}, {});
  std::set<float> values;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 48; ++x) {
      if (x >= 20) values.insert(state.pyramid[0].band(0)(x, y));
      if (x < 20) {
        EXPECT_EQ(state.pyramid[0].band(0)(x, y), picture.band(0)(x, y));
      }
    }
  EXPECT_GT(values.size(), 100U);
}

// With given tables a pixel far from borders depends on its position on the unbounded texture, not
// on the window.
TEST(CliquePolish, RecordedTablesGiveTheSameInAnyWindow) {
  const CliqueModel model = model_of(test::meadow_crop(64, 64));
  PolishRecord record;
  FlowState first{{grey(model, 64)}, {}};
  const PolishParameters parameters{.sweeps = 2};
  polish(first, model, 0, parameters, {}, nullptr, &record);
  EXPECT_EQ(record.sweeps.size(), 2U);
  FlowState again{{grey(model, 64)}, {}};
  polish(again, model, 0, parameters, {}, &record);
  EXPECT_EQ(again.pyramid[0].bands, first.pyramid[0].bands);
  FlowState moved{{grey(model, 200)}, {}};
  polish(moved, model, 0, parameters, {-61, -70}, &record);
  FlowState other{{grey(model, 200)}, {}};
  polish(other, model, 0, parameters, {-50, -47}, &record);
  for (int y = 90; y < 120; ++y)
    for (int x = 90; x < 120; ++x)
      EXPECT_EQ(moved.pyramid[0].band(0)(x + 11, y + 23), other.pyramid[0].band(0)(x, y));
}

}  // namespace
}  // namespace belvedere
