#include "texture/statistical/learn_by_sampling.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/statistical/make_texture.h"
#include "texture/statistical/model_file.h"
#include "texture/statistical/texture_figures.h"

namespace belvedere {
namespace {

const LearnParameters few{.types = 18};

const CliqueModel& sampled() {
  static const CliqueModel model = learn_by_sampling(test::meadow_crop(64, 64), {}, few).model;
  return model;
}

TEST(LearnBySampling, PreselectsNeighboursAndAddsUpToItsBudget) {
  const CliqueModel& model = sampled();
  EXPECT_EQ(model.levels, 0);
  EXPECT_TRUE(model.sampled);
  EXPECT_EQ(model.cliques.size(), 18U);
  for (int band = 0; band < 3; ++band)
    for (const CliqueType& type : {CliqueType{0, 0, 0, band, band}, CliqueType{0, 1, 0, band, band},
                                   CliqueType{0, 0, 1, band, band}})
      EXPECT_TRUE(std::any_of(model.cliques.begin(), model.cliques.end(),
                              [&](const Clique& c) { return c.type == type; }));
  EXPECT_EQ(model_text(parse_model(model_text(model), "x.model")), model_text(model));
}

// The reference: from noise, the sampler reaches the crop's statistics, and flow with polish comes
// as close, also in types that neither uses.
TEST(LearnBySampling, FlowAndPolishComeAsNearAsTheSampler) {
  const Grid<Rgb8> crop = test::meadow_crop(64, 64);
  const LearnParameters level{.types = 18, .levels = 0};
  const Grid<Rgb8> by_sampler = make_texture(sampled(), 96, 96, {});
  const TextureFigures sampler = texture_figures(crop, {}, by_sampler, sampled(), level);
  const TextureFigures ours = texture_figures(
      crop, {}, make_texture(learn_texture(crop, {}, {.types = 28}).model, 96, 96, {}), sampled(),
      level);
  RecordProperty("sampler", std::to_string(sampler.held_out));
  RecordProperty("flow", std::to_string(ours.held_out));
  EXPECT_LT(sampler.selected, .35);
  EXPECT_LT(ours.held_out, 1.1 * sampler.held_out) << sampler.held_out;
  EXPECT_EQ(make_texture(sampled(), 20, 20, {.sweeps = 2}),
            make_texture(sampled(), 20, 20, {.sweeps = 2}));
}

TEST(LearnBySampling, LargeCropsAndWindowsAreRefused) {
  EXPECT_THROW(learn_by_sampling(test::meadow_crop(257, 64), {}, few), Error);
  EXPECT_THROW(learn_by_sampling(test::meadow_crop(47, 64), {}, few), Error);
  EXPECT_THROW(make_window(sampled(), {}, {0, 0, 10, 10}, {}), Error);
}

}  // namespace
}  // namespace belvedere
