#include "renderer/world/resolve_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/filter.h"
#include "base/progress.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/proposed_scene.h"
#include "renderer/compose/view_measures.h"
#include "renderer/pipeline/scene_check.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/view.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using testing::Contains;
using testing::Not;

class ViewSettling : public testing::Test {
 protected:
  static Scene scene(const std::string& text, const std::vector<std::string>& settings = {}) {
    return parse_scene("version = 1\n" + text, "s.toml", ".",
                       {.data_folders = {}, .settings = settings})
        .scene;
  }
  View view(const std::string& text, const std::vector<std::string>& settings = {}) const {
    return make_view(scene(text, settings), dem_, silent_progress());
  }
  static std::vector<std::string> keys(const View& view) {
    std::vector<std::string> out;
    for (const DerivedValue& value : view.derived) out.push_back(value.key);
    return out;
  }
  static void expect_equal(const View& a, const View& b) {
    EXPECT_EQ(a.camera.eye, b.camera.eye);
    EXPECT_EQ(a.camera.azimuth_deg, b.camera.azimuth_deg);
    EXPECT_EQ(a.camera.pitch_deg, b.camera.pitch_deg);
    EXPECT_EQ(a.deform.exaggeration, b.deform.exaggeration);
    EXPECT_EQ(a.deform.exaggeration_base_m, b.deform.exaggeration_base_m);
    EXPECT_EQ(a.deform.bend.radius_m, b.deform.bend.radius_m);
    EXPECT_EQ(a.deform.bend.crest_m, b.deform.bend.crest_m);
    EXPECT_EQ(a.sun.azimuth_deg, b.sun.azimuth_deg);
    EXPECT_EQ(a.sun.altitude_deg, b.sun.altitude_deg);
    EXPECT_EQ(a.air.from_m, b.air.from_m);
    EXPECT_EQ(a.air.scale_m, b.air.scale_m);
    EXPECT_EQ(a.air.rim_fade_m, b.air.rim_fade_m);
    EXPECT_EQ(a.generalize.foreground_to_m, b.generalize.foreground_to_m);
    EXPECT_EQ(a.generalize.background_from_m, b.generalize.background_from_m);
  }

  // Position of a ground point in the picture, as shares of it.
  glm::dvec2 find_point(const View& view, glm::dvec2 position) const {
    const glm::dvec2 cell = dem_.transform.to_cell(position.x, position.y);
    const double altitude_m = sample_bilinear(dem_.altitude_m, cell.x, cell.y);
    const auto at =
        make_camera(view.camera)
            ->project(Deformation(view.deform, view.viewer_xy).point({position, altitude_m}));
    return at.value_or(glm::dvec2(-1.0)) / glm::dvec2(view.camera.width, view.camera.height);
  }

  Dem dem_ = make_dem(test::synthetic_raster(60.0, test::chain));
  const std::string position_ = "[camera]\nposition = [630000, 5204000]\n";
  const std::string target_ = position_ + "height_m = 9000\nlook_at = [630000, 5230000]\n";
};

// Derived values, written into the scene, are no longer derived and change nothing.
TEST_F(ViewSettling, WhatItFindsCanBeWritten) {
  for (const std::string& text :
       {position_, target_,
        position_ + "height_m = 500\nheight_above_ground = true\nazimuth_deg = 10\n"}) {
    const View found = view(text);
    std::vector<std::string> settings;
    for (const DerivedValue& value : found.derived)
      settings.push_back(value.key + "=" + value.value);
    EXPECT_GE(settings.size(), 10U);
    const View written = view(text, settings);
    EXPECT_TRUE(written.derived.empty()) << text;
    expect_equal(found, written);
  }
}

TEST_F(ViewSettling, WhatIsWrittenWins) {
  const View all = view(target_);
  EXPECT_EQ(all.camera.eye.z, 9000.0);
  EXPECT_THAT(keys(all), Not(Contains("camera.height_m")));
  const std::vector<std::string> written = {
      "deform.exaggeration=1.1", "deform.bend.radius_m=0",
      "camera.tilt_deg=0",       "sun.azimuth_deg=200",
      "air.from_m=5000",         "air.rim_fade_m=0",
      "air.scale_m=7000",        "generalize.foreground_to_m=90000"};
  const View some = view(target_, written);
  EXPECT_EQ(some.deform.exaggeration, 1.1);
  EXPECT_EQ(some.deform.exaggeration_base_m, 0.0) << "beside a written exaggeration";
  EXPECT_EQ(some.deform.bend.radius_m, 0.0);
  EXPECT_EQ(some.sun.azimuth_deg, 200.0);
  EXPECT_EQ(some.air.from_m, 5000.0);
  EXPECT_EQ(some.air.rim_fade_m, 0.0);
  EXPECT_EQ(some.generalize.foreground_to_m, 90000.0);
  EXPECT_GT(some.generalize.background_from_m, 90000.0) << "stays beyond it";
  EXPECT_THAT(keys(some), testing::ElementsAre("sun.altitude_deg", "generalize.background_from_m"));
  // The look_at point is at the centre if the tilt is set to none.
  const auto target = find_point(some, {630000.0, 5230000.0});
  EXPECT_NEAR(target.x, 0.5, 0.001);
  EXPECT_NEAR(target.y, 0.5, 0.001);
}

TEST_F(ViewSettling, AutoIsAsNotWritten) {
  const View found = view(target_);
  expect_equal(found, view(target_, {"deform.exaggeration=auto", "deform.bend.radius_m=auto",
                                     "air.from_m=auto", "sun.azimuth_deg=auto"}));
}

TEST_F(ViewSettling, TheSkyHasItsShareAndTheGroundItsHorizon) {
  const CoarseGround ground = *region_of(coarse_altitudes_of(dem_));
  for (const std::string& text :
       {position_, target_, position_ + "height_m = 14000\nazimuth_deg = -12\n"}) {
    const View v = view(text);
    ViewShape shape{.viewer = v.viewer_xy,
                    .azimuth_deg = v.camera.azimuth_deg,
                    .field_of_view_deg = v.camera.field_of_view_deg,
                    .aspect = static_cast<double>(v.camera.width) / v.camera.height,
                    .far_m = v.air.from_m / 0.45,
                    .crest_m = v.deform.bend.crest_m,
                    .exaggeration = v.deform.exaggeration,
                    .base_m = v.deform.exaggeration_base_m,
                    .radius_m = v.deform.bend.radius_m,
                    .eye_m = v.camera.eye.z,
                    .pitch_deg = v.camera.pitch_deg};
    shape.near_m = 0.42 * shape.far_m;
    const double sky = measure_view(ground, shape, {}).skyline.median;
    EXPECT_GT(sky, 0.10) << text;
    EXPECT_LT(sky, 0.22) << text;
    EXPECT_NEAR(shape.crest_m / shape.far_m, 0.80, 0.05) << "the bend is that of the same horizon";
  }
}

// Without its air, distances and sun a proposed scene gets back what the proposal wrote: both use
// the same shares.
TEST_F(ViewSettling, AProposalGetsBackWhatIsTakenFromIt) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{ground, massifs, {}};
  const Candidate best = propose_views(search, {.max = 1}).front();
  ProposedScene about;
  about.sources.push_back({"chain.tif", "", {}});
  about.crs = "EPSG:32632";
  const std::string text = proposed_scene_text(search, best, about);
  const auto of = [&](const std::vector<std::string>& settings) {
    return make_view(
        parse_scene(text, "chain.toml", ".", {.data_folders = {}, .settings = settings}).scene,
        dem_, silent_progress());
  };
  const View whole = of({});
  EXPECT_TRUE(whole.derived.empty()) << "a proposal says all";
  const View bare = of({"air.from_m=auto", "air.scale_m=auto", "air.rim_fade_m=auto",
                        "generalize.foreground_to_m=auto", "generalize.background_from_m=auto",
                        "sun.azimuth_deg=auto", "sun.altitude_deg=auto"});
  EXPECT_EQ(bare.derived.size(), 7U);
  EXPECT_EQ(bare.sun.azimuth_deg, whole.sun.azimuth_deg);
  EXPECT_EQ(bare.sun.altitude_deg, whole.sun.altitude_deg);
  EXPECT_NEAR(bare.air.from_m / whole.air.from_m, 1.0, 0.03);
  EXPECT_NEAR(bare.air.rim_fade_m / whole.air.rim_fade_m, 1.0, 0.03);
  EXPECT_NEAR(bare.generalize.background_from_m / whole.generalize.background_from_m, 1.0, 0.03);
}

TEST_F(ViewSettling, ParallelViewsAreNeitherRaisedNorBent) {
  const View flat = view(position_ + "projection = \"oblique\"\n");
  EXPECT_EQ(flat.deform.exaggeration, 1.0);
  EXPECT_EQ(flat.deform.bend.radius_m, 0.0);
  EXPECT_EQ(flat.camera.pitch_deg, CameraParameters{}.pitch_deg);
  EXPECT_EQ(flat.sun.azimuth_deg, 248.0);
  EXPECT_THAT(keys(flat), Contains("air.from_m"));
}

TEST_F(ViewSettling, AGivenEyeStaysAboveTheGround) {
  const double top_m = 600.0 + 1400.0 + 500.0 + 150.0 + 500.0;  // nothing of the chain is higher
  const View low =
      view("[camera]\nposition = [631400, 5230000]\nheight_m = " + std::to_string(top_m + 60.0) +
           "\nazimuth_deg = 0\n");
  EXPECT_GE(low.deform.exaggeration, 1.0);
  EXPECT_LE(low.deform.exaggeration, 2.0);
}

// A terrain in a file, held whole and in windows: with a hole in the data, and the sea in the
// south.
class DerivedFromFiles : public testing::Test {
 protected:
  DerivedFromFiles() {
    Raster<float> raster = test::synthetic_raster(60.0, test::chain, 1100);
    for (const auto [x, y] : test::cells(1100, 1100)) {
      if (y > 1020) raster.cells(x, y) = 0.F;
      if ((x - 300) * (x - 300) + (y - 500) * (y - 500) < 900) raster.cells(x, y) = NAN;
    }
    write_raster(folder_ / "dem.tif", raster);
  }
  LoadedScene scene(const std::string& max_mcells) const {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[camera]\nposition = [630000, "
        "5201000]\n",
        "s.toml", folder_.path(),
        {.data_folders = {}, .settings = {"terrain.max_mcells=" + max_mcells}});
  }
  test::Folder folder_;
};

TEST_F(DerivedFromFiles, ViewsDoNotHangOnTheMemoryThatTerrainMayTake) {
  std::vector<std::string> found[2];
  ViewEvaluation evaluated[2];
  for (const int windows : {0, 1}) {
    const LoadedScene loaded = scene(windows == 0 ? "4" : "0.4");
    const SceneDem opened = open_scene_dem(loaded, silent_progress());
    EXPECT_EQ(opened.levels != nullptr, windows == 1);
    const View view = make_view(loaded.scene, opened.dem, silent_progress(),
                                ground_altitude_of(opened), &opened.region);
    for (const DerivedValue& value : view.derived)
      found[windows].push_back(value.key + " = " + value.value);
    evaluated[windows] = evaluate_view(opened.region, view);
    EXPECT_NEAR(opened.region.source_cell_m, 60000.0 / 1100, 1e-9);
  }
  EXPECT_GE(found[0].size(), 12U);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_GT(evaluated[0].merit, 0.0);
  EXPECT_EQ(evaluated[0].merit, evaluated[1].merit);
}

// The same for any picture of the sheet's shape: drafts have the view of the full picture.
TEST_F(ViewSettling, HangsOnTheSheetsShapeAlone) {
  expect_equal(view(target_, {"output.width=2400", "output.height=1200"}),
               view(target_, {"output.width=800", "output.height=400"}));
}

using test::depression;

GivenView from_the_south() {
  return {.viewer = test::position_km(30.0, 4.0), .azimuth_deg = 0.0, .resolved = {}};
}

void expect_horizon_at_far(const ViewShape& view) {
  EXPECT_GT(depression(view, 0.98 * view.far_m), depression(view, view.far_m));
  EXPECT_GT(depression(view, 1.02 * view.far_m), depression(view, view.far_m));
}

TEST(CompleteView, WithNothingSettledIsTheLayoutOfTheLargestThatFits) {
  const CoarseGround ground = test::chain_region();
  const auto view = complete_view(ground, from_the_south());
  ASSERT_TRUE(view);
  EXPECT_TRUE(fits_data(ground, *view));
  EXPECT_GT(view->far_m, 0.7 * ground.side_m);
  const ViewShape shape{.viewer = view->viewer,
                        .near_m = view->near_m,
                        .far_m = view->far_m,
                        .crest_m = view->crest_m};
  const auto laid = lay_out(ground, shape, find_massifs(ground).lone);
  ASSERT_TRUE(laid);
  EXPECT_EQ(view->radius_m, laid->radius_m);
  EXPECT_EQ(view->eye_m, laid->eye_m);
  EXPECT_EQ(view->pitch_deg, laid->pitch_deg);
  ViewShape larger = *view;
  larger.far_m *= 1.12, larger.near_m *= 1.12;
  EXPECT_FALSE(fits_data(ground, larger));
}

// A given eye has the horizon at the same distance: R = (F² - c²) / 2 (eye - level), and the sky
// its share.
TEST(CompleteView, AGivenEyeSettlesTheBend) {
  const CoarseGround ground = test::chain_region();
  const ViewMeasures found = measure_view(ground, *complete_view(ground, from_the_south()), {});
  for (const double eye_m : {6000.0, 9000.0, 14000.0}) {
    GivenView given = from_the_south();
    given.resolved.eye_m = [=](const ViewShape&) { return eye_m; };
    const auto view = complete_view(ground, given);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->eye_m, eye_m);
    const double over = eye_m - view->base_m - view->level_m;
    EXPECT_NEAR(view->radius_m /
                    ((view->far_m * view->far_m - view->crest_m * view->crest_m) / (2.0 * over)),
                1.0, 1e-12);
    expect_horizon_at_far(*view);
    EXPECT_NEAR(measure_view(ground, *view, {}).skyline.mean, found.skyline.mean, 0.02) << eye_m;
  }
}

TEST(CompleteView, KeepsWhatIsSettled) {
  const CoarseGround ground = test::chain_region();
  GivenView given = from_the_south();
  given.resolved.exaggeration = 1.0;
  given.resolved.base_m = 0.0;
  given.resolved.pitch_deg = [](const ViewShape& view) { return view.eye_m > 0.0 ? -9.0 : 0.0; };
  given.resolved.drop_m = [](double) { return 0.0; };
  const auto view = complete_view(ground, given);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->exaggeration, 1.0);
  EXPECT_EQ(view->base_m, 0.0);
  EXPECT_EQ(view->pitch_deg, -9.0);
  // Level ground, not bent, at the near distance still lies on the lower edge.
  EXPECT_NEAR(
      ComposedPicture(*view).position({0.0, 1.0}, (view->eye_m - view->level_m) / view->near_m).y,
      1.0, 1e-6);
}

TEST(CompleteView, WithoutADirectionLooksWhereSomethingIs) {
  const CoarseGround ground = test::chain_region();
  GivenView given = from_the_south();
  given.azimuth_deg.reset();
  const auto view = complete_view(ground, given);
  ASSERT_TRUE(view);
  EXPECT_LE(std::abs(std::remainder(view->azimuth_deg, 360.0)), 45.0)
      << "the chain lies to the north";
  given.viewer = test::position_km(30.0, 56.0);
  const auto back = complete_view(ground, given);
  ASSERT_TRUE(back);
  EXPECT_LE(std::abs(std::remainder(back->azimuth_deg - 180.0, 360.0)), 45.0);
}

TEST(CompleteView, HasNoneWhereNoDataLie) {
  GivenView given = from_the_south();
  given.azimuth_deg = 180.0;
  given.viewer = test::position_km(30.0, -20.0);
  EXPECT_FALSE(complete_view(test::chain_region(), given));
}

}  // namespace
}  // namespace belvedere
