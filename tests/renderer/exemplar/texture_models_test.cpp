#include "renderer/exemplar/texture_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/files.h"
#include "tests/scenes.h"
#include "tests/texture/statistical/texture_crops.h"
#include "texture/composite/make_composite.h"
#include "texture/statistical/clique_model.h"
#include "texture/statistical/learn_texture.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using testing::HasSubstr;

const CliqueModel& meadow() {
  static const CliqueModel model = [] {
    LearnParameters few;
    few.types = 20;
    return learn_texture(test::meadow_crop(72, 64), {}, few).model;
  }();
  return model;
}

SceneTextureModel model_of(std::vector<LandCoverClass> serves, bool always = false) {
  return {.name = "m.model", .model = meadow(), .serves = std::move(serves), .always = always};
}

Grid<std::uint8_t> labels(LandCoverClass id, int count, LandCoverClass rest = rock) {
  Grid<std::uint8_t> out(40, 25, static_cast<std::uint8_t>(rest));
  for (int i = 0; i < count; ++i) out[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(id);
  return out;
}

std::vector<Exemplar> with_texels(LandCoverClass id, int count) {
  Exemplar exemplar;
  exemplar.guides.label = labels(id, count);
  return {exemplar};
}

TEST(TextureModels, TakeOverWhereTexelsAreMissingOrTooFew) {
  const auto chosen = [](const SceneTextureModel& model, int texels, int pixels,
                         const SynthesisParameters& parameters = {}) {
    return choose_modelled({model}, with_texels(pasture, texels), labels(pasture, pixels),
                           parameters);
  };
  ASSERT_EQ(chosen(model_of({pasture}), 0, 100).size(), 1U);
  EXPECT_EQ(chosen(model_of({pasture}), 0, 100)[0].id, pasture);
  EXPECT_THAT(chosen(model_of({pasture}), 0, 100)[0].why,
              HasSubstr("pasture is painted from the texture model m.model: no exemplar"));
  // A texel serves four pixels.
  EXPECT_TRUE(chosen(model_of({pasture}), 25, 100).empty());
  ASSERT_EQ(chosen(model_of({pasture}), 24, 100).size(), 1U);
  EXPECT_THAT(chosen(model_of({pasture}), 24, 100)[0].why,
              HasSubstr("too few texels, 24 for 100 pixels"));
  EXPECT_TRUE(chosen(model_of({forest}), 24, 100).size() == 1U &&
              chosen(model_of({forest}), 24, 100)[0].id == forest)
      << "no texels of forest: its model covers what a small plan does not show";
  EXPECT_EQ(chosen(model_of({forest}), 24, 100)[0].why, "");
  EXPECT_EQ(chosen(model_of({pasture}, true), 900, 100).size(), 1U) << "the scene prefers it";
}

TEST(TextureModels, WhatFallsBackToAClassCountsWithIt) {
  Grid<std::uint8_t> target = labels(pasture, 60);
  for (std::size_t i = 900; i < 1000; ++i) target[i] = static_cast<std::uint8_t>(shrub);
  SynthesisParameters parameters;
  EXPECT_TRUE(
      choose_modelled({model_of({pasture})}, with_texels(pasture, 20), target, parameters).empty());
  parameters.fallback[static_cast<std::uint8_t>(shrub)] = static_cast<std::uint8_t>(pasture);
  EXPECT_EQ(
      choose_modelled({model_of({pasture})}, with_texels(pasture, 20), target, parameters).size(),
      1U);
}

TEST(TextureModels, TheFirstThatServesAClassHasIt) {
  const std::vector<ModelledClass> chosen =
      choose_modelled({model_of({water}), model_of({pasture, water})}, with_texels(rock, 10),
                      labels(pasture, 9, water), {});
  ASSERT_EQ(chosen.size(), 2U);
  EXPECT_EQ(chosen[0].id, water);
  EXPECT_EQ(chosen[0].lit, 0U);
  EXPECT_EQ(chosen[1].lit, 1U);
  EXPECT_EQ(chosen[1].shaded, 1U);
}

TEST(TextureModels, LightAndShadeMayHaveAModelEach) {
  const auto chosen = [](ModelLight first, ModelLight second) {
    std::vector<SceneTextureModel> models = {model_of({rock, snow}), model_of({rock})};
    models[0].light = first;
    models[1].light = second;
    models[1].name = "second.model";
    return choose_modelled(models, with_texels(pasture, 1000), labels(rock, 9), {});
  };
  const std::vector<ModelledClass> each = chosen(ModelLight::lit, ModelLight::shaded);
  ASSERT_EQ(each.size(), 1U) << "snow in the shade has none";
  EXPECT_EQ(each[0].lit, 0U);
  EXPECT_EQ(each[0].shaded, 1U);
  EXPECT_THAT(each[0].why, HasSubstr("m.model, in the shade second.model: no exemplar"));
  const std::vector<ModelledClass> rest = chosen(ModelLight::shaded, ModelLight::any);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].lit, 1U);
  EXPECT_EQ(rest[0].shaded, 0U);
}

TEST(TextureModels, RampsRiseFromDarkToLightAroundTheMean) {
  const LabelRamps ramps = model_ramps(meadow());
  ASSERT_EQ(ramps.ramps.size(), 1U);
  const ToneRamp& ramp = ramps.ramps[0];
  for (std::size_t t = 1; t < ramp.size(); ++t) EXPECT_GT(ramp[t].y, ramp[t - 1].y);
  EXPECT_LT(ramp.front().y * 255.F, meadow().bands.mean[1]);
  EXPECT_GT(ramp.back().y * 255.F, meadow().bands.mean[1]);
  EXPECT_EQ(ramps.texels, 72U * 64U);
}

TEST(TextureModels, RampsOfTwoModelsGoFromShadeToLight) {
  std::vector<SceneTextureModel> models = {model_of({rock}), model_of({rock, snow})};
  models[1].model.bands.mean[1] -= 30.F;
  models[0].light = ModelLight::lit;
  models[1].light = ModelLight::shaded;
  const ToneRamp of_lit = model_ramps(models[0].model).ramps[0];
  const ToneRamp of_shaded = model_ramps(models[1].model).ramps[0];
  for (const SceneTextureModel& model : models) {
    const ToneRamp ramp = model_ramps(models, model, rock).ramps[0];
    for (std::size_t t = 0; t < ramp.size(); ++t)
      EXPECT_EQ(ramp[t], (t < 2 ? of_shaded : of_lit)[t]) << t;
  }
  EXPECT_EQ(model_ramps(models, models[1], snow).ramps[0], of_shaded)
      << "nothing paints snow in the light";
}

TEST(TextureModels, AreReadFromTheScenesFolder) {
  const test::Folder folder;
  test::write_bytes(folder / "m.model", model_text(meadow()));
  const auto read = [&](const std::string& block) {
    return read_texture_models(test::small_scene({"exemplar.0=" + block}, folder.path()));
  };
  const std::vector<SceneTextureModel> models = read(
      "{ model = \"m.model\", serves = [\"pasture\"], prefer = \"model\", stroke_px = 4, light = "
      "\"any\" }");
  ASSERT_EQ(models.size(), 1U);
  EXPECT_TRUE(models[0].always);
  EXPECT_EQ(models[0].light, ModelLight::any);
  const auto by_light = [](const char* light) {
    return std::string("{ model = \"m.model\", serves = [\"pasture\"], light = \"") + light +
           "\" }";
  };
  const std::vector<SceneTextureModel> both = read_texture_models(test::small_scene(
      {"exemplar.0=" + by_light("shaded"), "exemplar.1=" + by_light("lit")}, folder.path()));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].light, ModelLight::shaded);
  EXPECT_EQ(both[1].light, ModelLight::lit);
  EXPECT_EQ(models[0].light_px, 4.0);
  EXPECT_EQ(models[0].serves, std::vector{pasture});
  EXPECT_TRUE(read("{ model = \"gone.model\", serves = [\"pasture\"], optional = true }").empty());
  test::write_bytes(folder / "bad.model", "belvedere_texture = 7\n");
  EXPECT_THAT(test::message_of(ErrorKind::usage,
                               [&] { read("{ model = \"bad.model\", serves = [\"pasture\"] }"); }),
              HasSubstr("version 7"));
}

// Labels of a composite are class numbers; the sky belongs to the scene.
TEST(TextureModels, ACompositePaintsTheClassesOfItsLabels) {
  const test::Folder folder;
  LabelMapModel map = learn_label_map(Grid<std::uint8_t>(32, 32, 0), 3);
  CompositeModel composite{.map = map,
                           .labels = {{"0", meadow()}, {"7", meadow()}, {"10", meadow()}},
                           .transition = {},
                           .crop_hash = "a"};
  test::write_bytes(folder / "m.composite", composite_text(composite));
  composite.labels[1].name = "#00ff00";
  test::write_bytes(folder / "drawn.composite", composite_text(composite));
  const auto read = [&](const std::string& block) {
    return read_texture_models(test::small_scene({"exemplar.0=" + block}, folder.path()));
  };
  const std::vector<SceneTextureModel> all = read("{ model = \"m.composite\" }");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].serves, std::vector{rock});
  EXPECT_EQ(all[1].serves, std::vector{pasture});
  EXPECT_EQ(all[1].name, "m.composite (pasture)");
  EXPECT_EQ(all[1].model.crop_hash, meadow().crop_hash);
  const std::vector<SceneTextureModel> one =
      read("{ model = \"m.composite\", serves = [\"pasture\"] }");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].serves, std::vector{pasture});
  EXPECT_THAT(test::message_of(ErrorKind::usage, [&] { read("{ model = \"drawn.composite\" }"); }),
              HasSubstr("#00ff00"));
}

}  // namespace
}  // namespace belvedere
