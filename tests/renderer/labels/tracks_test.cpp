#include "renderer/labels/tracks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "renderer/labels/drawing_svg.h"
#include "renderer/world/world.h"
#include "tests/grids.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class Tracks : public testing::Test {
 protected:
  Track track_of(std::vector<glm::dvec2> positions, const Grid<float>* dem = nullptr) const {
    const LocatedGround ground{dem != nullptr ? *dem : bare_.dem->altitude_m, *bare_.generalized_m,
                               bare_.dem->transform, bare_.dem->cell_m(), map_};
    return find_tracks(ground, {{"tour", "tour.gpx, feature 0", std::move(positions)}})[0];
  }
  const BareView bare_ = make_bare_view(
      test::small_scene({"output.width=960", "output.height=800", "deform.exaggeration=1.5"}),
      silent_progress());
  const GeoMap map_ = bare_.geo_map();
};

// Up and down a roof of 1:10 on 4 km: the ascent is known.
TEST_F(Tracks, LengthAndAscentOfARoof) {
  Grid<float> roof(bare_.dem->width(), bare_.dem->height());
  for (const auto [x, y] : test::cells(roof))
    roof(x, y) = 1000.F - 10.F * static_cast<float>(std::abs(x - 60));  // 100 m a cell
  const double centre = bare_.dem->transform.to_crs(60.0, 0.0).x;
  const Track track = track_of(
      {{centre - 2000.0, 6000.0}, {centre + 2000.0, 6000.0}, {centre - 1000.0, 6000.0}}, &roof);
  EXPECT_NEAR(track.length_m, 7000.0, 1e-6);
  EXPECT_NEAR(track.climb_m, 200.0 + 200.0, 1.0);
  EXPECT_NEAR(track.profile.front().y, 800.0, 1.0);
  EXPECT_NEAR(track.profile.back().x, 7000.0, 1e-6);
}

// The states of single points match those of the runs of the track.
TEST_F(Tracks, AreSeenWhereTheirPlacesAre) {
  double seen_m = 0.0;
  double length_m = 0.0;
  int seen_runs = 0;
  int hidden_runs = 0;
  for (double x = 1500.0; x < 11000.0; x += 1500.0) {
    const Track track = track_of({{x, 1000.0}, {x, 11000.0}});
    seen_m += track.seen_m;
    length_m += track.length_m;
    for (const TrackRun& run : track.runs) {
      ++(run.seen ? seen_runs : hidden_runs);
      ASSERT_GE(run.pixels.size(), 2U);
      for (std::size_t i = 0; i + 1 < run.pixels.size(); ++i)
        EXPECT_LT(glm::length(run.pixels[i + 1] - run.pixels[i]), 60.0) << "no leap";
    }
    for (std::size_t i = 0; i + 1 < track.runs.size(); ++i)
      EXPECT_TRUE(track.runs[i].seen != track.runs[i + 1].seen ||
                  track.runs[i].pixels.back() != track.runs[i + 1].pixels.front())
          << "runs that go on are one";
  }
  std::size_t visible = 0;
  std::size_t all = 0;
  for (double x = 1500.0; x < 11000.0; x += 1500.0)
    for (double y = 1000.0; y <= 11000.0; y += 50.0) {
      const auto at = map_.to_image(glm::dvec2(x, y));
      visible += at && at->visible ? 1 : 0;
      ++all;
    }
  EXPECT_NEAR(seen_m / length_m, static_cast<double>(visible) / static_cast<double>(all), .02);
  EXPECT_GE(seen_runs, 5);
  EXPECT_GE(hidden_runs, 5);
  EXPECT_GT(seen_m, 0.0);
  EXPECT_LT(seen_m, length_m);
}

TEST_F(Tracks, EndAtTheTerrainsEdge) {
  const Track track = track_of({{6000.0, 6000.0}, {6000.0, 20000.0}});
  EXPECT_NEAR(track.length_m, 14000.0, 1e-6);
  EXPECT_LT(track.profile.back().x, 6100.0);
  const Track outside = track_of({{90000.0, 0.0}, {91000.0, 0.0}});
  EXPECT_TRUE(outside.runs.empty());
  EXPECT_TRUE(profile_drawing(outside, "#b00000", 10.0).shapes.empty());
}

TEST_F(Tracks, AProfileHasRoundNumbersAndItsName) {
  Track track = track_of({{2000.0, 6000.0}, {9000.0, 6000.0}});
  track.name = "A & B";
  const Drawing drawing = profile_drawing(track, "#b00000", 10.0);
  EXPECT_EQ(drawing.size_px, glm::dvec2(1800.0, 500.0));
  const std::string svg = drawing_svg(drawing, 180.0);
  EXPECT_THAT(svg, HasSubstr("A &amp; B: 7.0 km"));
  EXPECT_THAT(svg, HasSubstr("stroke=\"#b00000\""));
  EXPECT_THAT(svg, HasSubstr(">5</text>"));
}

}  // namespace
}  // namespace belvedere
