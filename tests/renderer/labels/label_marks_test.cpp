#include "renderer/labels/label_marks.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "renderer/world/world.h"
#include "terrain/shape/valley_floor.h"
#include "tests/scenes.h"

namespace belvedere {
namespace {

// The small scene, exaggerated and bent, at a size where a pixel is small.
class LabelMarks : public testing::Test {
 protected:
  std::vector<LabelMark> marks_of(const std::vector<LabelPoint>& points) const {
    return find_marks({bare_.dem->altitude_m, *bare_.generalized_m, bare_.dem->transform,
                       bare_.dem->cell_m(), map_},
                      points, style_);
  }
  LabelPoint point(glm::dvec2 position, const char* kind = "summit") const {
    LabelPoint p;
    p.name = "A";
    p.kind = style_.find(kind);
    p.position = position;
    return p;
  }
  std::vector<Summit> summits() const {
    return find_summits(*bare_.generalized_m, {.min_prominence_m = 60.0});
  }
  glm::dvec2 position_of(const Summit& s) const { return bare_.dem->transform.to_crs(s.x, s.y); }

  const BareView bare_ =
      make_bare_view(test::small_scene({"output.width=960", "output.height=800",
                                        "deform.exaggeration=1.5", "deform.bend.radius_m=40000"}),
                     silent_progress());
  const GeoMap map_ = bare_.geo_map();
  const LabelStyle style_ = load_label_style("classic");
};

// An oracle without knowledge of summits: the drawn top is the highest position of the picture that
// shows ground around it.
TEST_F(LabelMarks, StandOnTheSummitAsItIsDrawn) {
  std::size_t skyline = 0;
  for (const Summit& summit : summits()) {
    // The file's position is a cell and a half off.
    const LabelMark mark = marks_of({point(position_of(summit) + glm::dvec2(-110.0, 100.0))})[0];
    if (mark.state != MarkState::seen || !mark.on_skyline) continue;
    ++skyline;
    double top = mark.pixel.y + 20.0;
    for (double x = mark.pixel.x - 3.0; x <= mark.pixel.x + 3.0; x += .5) {
      double y = mark.pixel.y + 20.0;
      while (y > 0.0 && map_.to_geo({x, y})) y -= .25;
      top = std::min(top, y);
    }
    EXPECT_NEAR(mark.pixel.y, top, 2.0);
  }
  EXPECT_GE(skyline, 1U);
}

// Seen from high above, the edge behind which a summit falls out of sight is not its top. The
// oracle uses the picture alone: above the mark it shows ground far behind what it shows below the
// mark.
TEST_F(LabelMarks, StandOnTheEdgeThatIsSeenFromAbove) {
  std::size_t moved = 0;
  for (const auto& [height_m, pitch_deg] :
       {std::pair(4500.0, -18.0), {6000.0, -22.0}, {8000.0, -32.0}}) {
    const BareView high = make_bare_view(
        test::small_scene({"output.width=2400", "output.height=2000", "deform.exaggeration=1.5",
                           fmt::format("camera.height_m={}", height_m),
                           fmt::format("camera.pitch_deg={}", pitch_deg)}),
        silent_progress());
    const GeoMap map = high.geo_map();
    const LocatedGround ground{high.dem->altitude_m, *high.generalized_m, high.dem->transform,
                             high.dem->cell_m(), map};
    for (const Summit& summit : find_summits(*high.generalized_m, {.min_prominence_m = 60.0})) {
      const LabelPoint file_point = point(high.dem->transform.to_crs(summit.x, summit.y));
      const LabelMark mark = find_marks(ground, {file_point}, style_)[0];
      if (mark.state != MarkState::seen) continue;
      const auto top = map.to_image(mark.drawn_position);
      ASSERT_TRUE(top && top->visible);
      EXPECT_LE(mark.pixel.y, top->pixel.y);
      if (mark.pixel.y > top->pixel.y - 2.0) continue;
      ++moved;
      const auto over = map.to_geo(mark.pixel - glm::dvec2(0.0, 2.0));
      const auto under = map.to_geo(mark.pixel + glm::dvec2(0.0, 1.0));
      ASSERT_TRUE(under);
      EXPECT_LT(glm::length(under->position - mark.drawn_position), 600.0) << "still this summit";
      EXPECT_TRUE(!over || over->distance_m > under->distance_m + 200.0)
          << height_m << ": the same slope goes on over the mark";
    }
  }
  EXPECT_GE(moved, 1U);
}

// As profiles of tracks have it: bilinear, exactly the cell's own value at its centre.
TEST_F(LabelMarks, AltitudesBetweenCellsAreInterpolated) {
  const Grid<float>& z = bare_.dem->altitude_m;
  for (int y = z.height() / 4; y < 3 * z.height() / 4; y += 13)
    for (int x = z.width() / 4; x < 3 * z.width() / 4; x += 11) {
      const auto altitude = [&](double column, double row) {
        return marks_of({point(bare_.dem->transform.to_crs(column, row), "town")})[0]
            .dem_altitude_m;
      };
      EXPECT_NEAR(altitude(x, y), z(x, y), 1e-3);
      EXPECT_NEAR(altitude(x + .5, y), .5 * (z(x, y) + z(x + 1, y)), 1e-2);
      EXPECT_NEAR(altitude(x + .25, y + .5),
                  .5 * (.75 * (z(x, y) + z(x, y + 1)) + .25 * (z(x + 1, y) + z(x + 1, y + 1))),
                  1e-2);
    }
}

TEST_F(LabelMarks, ClimbFromNearbyAndNotFromAfar) {
  const std::vector<Summit> found = summits();
  ASSERT_FALSE(found.empty());
  const LocatedGround ground{bare_.dem->altitude_m, *bare_.generalized_m, bare_.dem->transform,
                           bare_.dem->cell_m(), map_};
  const glm::dvec2 top = position_of(found[0]);
  const glm::dvec2 near = top + glm::dvec2(180.0, -90.0);
  EXPECT_EQ(climb(ground, near, 400.0), top);
  EXPECT_EQ(climb(ground, near, 100.0), near) << "farther than it may go: it stays";
  EXPECT_FALSE(climb(ground, {-5000.0, 0.0}, 400.0));
}

// Whatever state a point has, the map from the picture back to the ground agrees with it.
TEST_F(LabelMarks, SeenAndHiddenAgreeWithThePicture) {
  std::size_t seen = 0;
  std::size_t hidden = 0;
  for (double y = 500.0; y < 12000.0; y += 700.0)
    for (double x = 500.0; x < 12000.0; x += 700.0) {
      const LabelMark mark = marks_of({point({x, y}, "town")})[0];
      EXPECT_EQ(mark.drawn_position, glm::dvec2(x, y)) << "towns do not climb";
      if (mark.state == MarkState::seen) {
        ++seen;
        const auto back = map_.to_geo(mark.pixel);
        const auto again = back ? map_.to_image(back->position) : std::nullopt;
        EXPECT_TRUE(!again || glm::length(again->pixel - mark.pixel) < 1.0);
        EXPECT_FALSE(mark.in_front);
      } else if (mark.state == MarkState::hidden) {
        ++hidden;
        ASSERT_TRUE(mark.in_front);
        EXPECT_LT(mark.in_front->distance_m, mark.distance_m);
      }
    }
  EXPECT_GT(seen, 50U);
  EXPECT_GT(hidden, 5U);
}

TEST_F(LabelMarks, OutsideIsSaid) {
  EXPECT_EQ(marks_of({point({0.0, 90000.0}, "town")})[0].state, MarkState::outside_terrain);
  const BareView aside =
      make_bare_view(test::small_scene({"camera.azimuth_deg=90"}), silent_progress());
  const GeoMap map = aside.geo_map();
  const std::vector<LabelMark> marks = find_marks(
      {aside.dem->altitude_m, *aside.generalized_m, aside.dem->transform, aside.dem->cell_m(), map},
      {point({500.0, 500.0}, "town"), point({6500.0, 11000.0}, "town")}, style_);
  EXPECT_EQ(marks[0].state, MarkState::behind_eye);
  EXPECT_EQ(marks[1].state, MarkState::outside_picture);
}

}  // namespace
}  // namespace belvedere
