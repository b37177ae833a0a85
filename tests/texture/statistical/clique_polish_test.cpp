#include "texture/statistical/clique_polish.h"

#include <gtest/gtest.h>

#include <cmath>
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

BandPicture noise_picture(int width, int height) {
  BandPicture picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int b = 0; b < 3; ++b)
        picture.band(b)(x, y) = static_cast<float>(
            20.0 * random_uniform(11, x, y, static_cast<std::uint64_t>(b)) - 10.0);
  return picture;
}

// One type, whose wanted differences are those of the picture shifted by `shift`.
CliqueModel moved_model(const BandPicture& picture, const CliqueType& type, float shift) {
  CliqueModel model;
  model.levels = 0;
  model.bands.low = {-64.F, -64.F, -64.F};
  model.bands.high = {64.F, 64.F, 64.F};
  CliqueKnots knots = find_knots(count_differences(picture, model.bands, type),
                                 difference_range(model.bands, type));
  for (float& knot : knots) knot += shift;
  model.cliques.push_back({type, encode_knots(model.bands, type, knots)});
  return model;
}

float mean_of(const Grid<float>& values) {
  double sum = 0.0;
  for (const float v : values) sum += v;
  return static_cast<float>(sum / static_cast<double>(values.size()));
}

// A band whose own histogram should be 12 lighter moves there by the rate: 12 (1 - .2^n) after n
// rounds without momentum.
TEST(CliqueFlow, APlainHistogramMovesByTheRate) {
  BandPicture picture = noise_picture(64, 64);
  const float before = mean_of(picture.band(1));
  const CliqueModel model = moved_model(picture, {0, 0, 0, 1, 1}, 12.F);
  FlowState state{{picture}, {}};
  for (int n = 1; n <= 3; ++n) {
    flow(state, model, 0, find_tables(state.pyramid, model, 0), {.rate = .8F, .momentum = 0.F});
    EXPECT_NEAR(mean_of(state.pyramid[0].band(1)) - before, 12.0 * (1.0 - std::pow(.2, n)), .25)
        << n;
  }
  EXPECT_EQ(state.pyramid[0].band(0), picture.band(0));  // without requests
}

TEST(CliqueFlow, PairsComeToTheirDifferences) {
  const Grid<Rgb8> crop = test::meadow_crop(96, 64);
  CliqueModel model;
  model.levels = 0;
  model.bands = find_bands(crop, {});
  const BandPicture example = to_bands(crop, model.bands, {});
  std::vector<HistogramGroups> wanted;
  for (const CliqueType& type : {CliqueType{0, 0, 0, 0, 0}, CliqueType{0, 4, 0, 0, 0},
                                 CliqueType{0, 1, 0, 0, 0}, CliqueType{0, 0, 1, 0, 0}}) {
    const DifferenceHistogram histogram = count_differences(example, model.bands, type);
    model.cliques.push_back(
        {type, encode_knots(model.bands, type,
                            find_knots(histogram, difference_range(model.bands, type)))});
    wanted.emplace_back(histogram);
  }
  FlowState state{{noise_picture(96, 96)}, {}};
  const auto off = [&] {
    double sum = 0.0;
    for (std::size_t k = 0; k < wanted.size(); ++k)
      sum += wanted[k]
                 .distance(count_differences(state.pyramid[0], model.bands, model.cliques[k].type))
                 .l1 /
             static_cast<double>(wanted.size());
    return sum;
  };
  const double before = off();
  for (int i = 0; i < 40; ++i)
    flow(state, model, 0, find_tables(state.pyramid, model, 0), {.momentum = i < 36 ? .6F : 0.F});
  EXPECT_GT(before, .6);
  EXPECT_LT(off(), .3 * before);
}

TEST(CliqueFlow, WhatMayNotChangeStays) {
  BandPicture picture = noise_picture(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 16; ++x) picture.states(x, y) = pixel_counts;
  const CliqueModel model = moved_model(picture, {0, 1, 0, 0, 0}, 5.F);
  FlowState state{{picture}, {}};
  for (int i = 0; i < 5; ++i) flow(state, model, 0, find_tables(state.pyramid, model, 0), {});
  bool moved = false;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const bool same = state.pyramid[0].band(0)(x, y) == picture.band(0)(x, y);
      if (x < 16) {
        EXPECT_TRUE(same);
      }
      moved = moved || !same;
    }
  EXPECT_TRUE(moved);
}

// The sum at a pixel is taken type by type, whatever strip of rows contains it: a strip's border in
// the centre has no effect.
TEST(CliqueFlow, MovesAreTheSumOfAllCliquesOfAPixel) {
  const BandPicture picture = noise_picture(40, 130);  // three strips
  CliqueModel model = moved_model(picture, {0, 3, 7, 0, 0}, 4.F);
  model.cliques.push_back(moved_model(picture, {0, -2, 5, 0, 1}, -3.F).cliques.front());
  const FlowRound tables = find_tables({picture}, model, 0);
  FlowState state{{picture}, {}};
  flow(state, model, 0, tables, {.rate = 1.F, .momentum = 0.F});
  // By the definition, pixel by pixel: band 0 is head and tail of the first type and head of the
  // second.
  const auto move_at = [&](std::size_t k, float difference) {
    const DifferenceRange range = difference_range(model.bands, model.cliques[k].type);
    const float at = (difference - range.low) * difference_bins / (range.high - range.low);
    const auto bin = static_cast<std::size_t>(at);
    return .5F * (tables[k][bin] +
                  (at - static_cast<float>(bin)) * (tables[k][bin + 1] - tables[k][bin]));
  };
  for (int y = 50; y < 80; ++y)
    for (int x = 5; x < 35; ++x) {
      const auto v = [&](int b, int dx, int dy) { return picture.band(b)(x + dx, y + dy); };
      const float sum = move_at(0, v(0, 0, 0) - v(0, -3, -7)) -
                        move_at(0, v(0, 3, 7) - v(0, 0, 0)) + move_at(1, v(0, 0, 0) - v(1, 2, -5));
      EXPECT_NEAR(state.pyramid[0].band(0)(x, y), v(0, 0, 0) + sum / 3.F, 1e-3F) << x << " " << y;
    }
}

// Requests for a fixed coarse pixel are not propagated: tables of thin holes come from a few pixels
// only.
TEST(CliqueFlow, WhatStandsAtACoarseLevelAsksNothingOfTheFine) {
  CliqueModel model;
  model.levels = 1;
  model.bands.low = {-100.F, -100.F, -100.F};
  model.bands.high = {100.F, 100.F, 100.F};
  model.cliques.push_back({{1, 0, 0, 0, 0}, {}});
  FlowState state{make_pyramid(BandPicture(32, 32), 1), {}};
  for (BandPicture& picture : state.pyramid)
    for (std::uint8_t& s : picture.states) s = pixel_counts;
  for (int y = 0; y < 32; ++y) state.pyramid[0].states(16, y) = pixel_free;
  state.pyramid[1].states(8, 8) = pixel_free;
  flow(state, model, 0, {FlowTable(difference_bins + 1, 10.F)}, {.rate = 1.F, .momentum = 0.F});
  const Grid<float>& moved = state.pyramid[0].band(0);
  EXPECT_GT(moved(16, 16), 5.F);
  EXPECT_EQ(moved(16, 4), 0.F);
  EXPECT_EQ(moved(16, 28), 0.F);
  EXPECT_EQ(moved(17, 16), 0.F);
}

}  // namespace

}  // namespace belvedere
