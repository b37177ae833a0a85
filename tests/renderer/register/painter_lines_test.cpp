#include "renderer/register/painter_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

// Slopes from 800 to 3200 m: forest, grass, rock on steep ground, snow; lines are ragged.
struct Slopes {
  std::vector<PaintSample> samples;
  std::vector<double> altitude_m, steep, ragged_m;

  // Glaciers lie on flat ground.
  LandCoverClass at(std::size_t i, double treeline_m, double snowline_m, double ice_line_m) const {
    using enum LandCoverClass;
    const double altitude = altitude_m[i] + ragged_m[i];
    if (altitude > ice_line_m && steep[i] < 0.4) return glacier;
    if (altitude > snowline_m && steep[i] < 0.9) return snow;
    if (steep[i] > 0.7) return rock;
    return altitude > treeline_m ? alpine_grass : forest;
  }
  // As class rules that know the climate: lines of 0 are 2000 and 2800 m, and there is no ice.
  std::vector<LandCoverClass> classes(const PainterLines& lines) const {
    using enum LandCoverClass;
    std::vector<LandCoverClass> out;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const LandCoverClass id = at(i, lines.treeline_m > 0.0 ? lines.treeline_m : 2000.0,
                                   lines.snowline_m > 0.0 ? lines.snowline_m : 2800.0,
                                   lines.ice_line_m > 0.0 ? lines.ice_line_m : 9000.0);
      out.push_back(lines.winter && id == alpine_grass ? snow : id);
    }
    return out;
  }
};

struct Paint {
  glm::dvec3 forest{0.42, -0.03, 0.01}, grass{0.62, -0.03, 0.06}, rock{0.55, 0.01, 0.0},
      snow{0.85, 0.0, -0.02};
};

// In light from a side, in air that grows with distance, with strokes; no paint of places that
// are wrong by 40 m.
Slopes painted(double treeline_m, double snowline_m, const Paint& paint = {},
               double ice_line_m = 9000.0) {
  using enum LandCoverClass;
  Slopes out;
  const auto draw = [](std::uint64_t stream, int i) { return random_uniform(stream, i, 0); };
  for (int i = 0; i < 3000; ++i) {
    out.altitude_m.push_back(800.0 + 2400.0 * draw(1, i));
    out.steep.push_back(draw(2, i));
    out.ragged_m.push_back(160.0 * (draw(3, i) - 0.5));
    const glm::dvec3 normal = glm::normalize(glm::dvec3(draw(4, i) - 0.5, draw(5, i) - 0.5, 0.7));
    const double distance_m = 4000.0 + 26000.0 * draw(6, i);
    out.samples.push_back({{}, normal, distance_m});
  }
  for (std::size_t i = 0; i < out.samples.size(); ++i) {
    const auto n = static_cast<int>(i);
    out.altitude_m[i] += 40.0 * (draw(7, n) - 0.5);
    const LandCoverClass id = out.at(i, treeline_m, snowline_m, ice_line_m);
    const glm::dvec3 own = id == forest                  ? paint.forest
                           : id == rock                  ? paint.rock
                           : id == snow || id == glacier ? paint.snow
                                                         : paint.grass;
    PaintSample& sample = out.samples[i];
    const double light = 0.12 * glm::dot(sample.normal, glm::normalize(glm::dvec3(-1, 1, 1)));
    const double air = 1.0 - std::exp(-sample.distance_m / 60000.0);
    sample.oklab =
        glm::mix(own + glm::dvec3(light, 0.0, 0.0), glm::dvec3(0.75, -0.01, -0.05), air) +
        0.06 * glm::dvec3(draw(8, n) - 0.5, 0.3 * draw(9, n), 0.4 * draw(10, n));
  }
  return out;
}

PainterLines lines_of(const Slopes& slopes) {
  return find_painter_lines(slopes.samples, 900.0, 3200.0,
                            [&](const PainterLines& lines) { return slopes.classes(lines); });
}

TEST(PainterLines, AreThoseOfThePainting) {
  for (const auto& [treeline_m, snowline_m] : {std::pair{1650.0, 2550.0}, {2150.0, 3000.0}}) {
    const PainterLines lines = lines_of(painted(treeline_m, snowline_m));
    EXPECT_NEAR(lines.treeline_m, treeline_m, 40.0);
    EXPECT_NEAR(lines.snowline_m, snowline_m, 40.0);
    EXPECT_FALSE(lines.winter);
  }
}

// Ice that flows down flat ground to 500 m below the snow line: neither line passes for the other.
TEST(PainterLines, TheIceLineIsThePaintersToo) {
  const PainterLines lines = lines_of(painted(1650.0, 2900.0, {}, 2400.0));
  EXPECT_NEAR(lines.ice_line_m, 2400.0, 60.0);
  EXPECT_NEAR(lines.snowline_m, 2900.0, 60.0);
  EXPECT_NEAR(lines.treeline_m, 1650.0, 60.0);
  EXPECT_EQ(lines_of(painted(1650.0, 2550.0)).ice_line_m, 0.0) << "where no ice is painted";
}

// Pale below and dark above is not a treeline, and dark above pale is no snow.
TEST(PainterLines, SwappedColoursDoNotInvertThem) {
  const Paint usual;
  Paint swapped = usual;
  std::swap(swapped.forest, swapped.grass);
  EXPECT_EQ(lines_of(painted(1650.0, 9000.0, swapped)).treeline_m, 0.0);
  swapped = usual;
  swapped.snow = {0.35, 0.0, -0.02};
  const PainterLines lines = lines_of(painted(1650.0, 2550.0, swapped));
  EXPECT_EQ(lines.snowline_m, 0.0);
  EXPECT_NEAR(lines.treeline_m, 1650.0, 80.0);
}

TEST(PainterLines, PaintThatDoesNotTellLeavesThemToTheRules) {
  Paint uniform;
  uniform.forest = uniform.grass = uniform.snow = uniform.rock;
  const PainterLines lines = lines_of(painted(1650.0, 2550.0, uniform));
  EXPECT_EQ(lines.treeline_m, 0.0);
  EXPECT_EQ(lines.snowline_m, 0.0);
  EXPECT_EQ(find_painter_lines({}, 900.0, 3200.0,
                               [](const PainterLines&) { return std::vector<LandCoverClass>(); })
                .treeline_m,
            0.0)
      << "nothing is known of any pixel";
}

TEST(PainterLines, PaleMeadowsAreWinter) {
  Paint winter;
  winter.grass = winter.snow;
  const PainterLines lines = lines_of(painted(1650.0, 9000.0, winter));
  EXPECT_TRUE(lines.winter);
  EXPECT_NEAR(lines.treeline_m, 1650.0, 60.0);
  EXPECT_EQ(lines.snowline_m, 0.0);
  Paint pale;
  pale.grass = {0.64, -0.01, 0.02};
  EXPECT_FALSE(lines_of(painted(1650.0, 2800.0, pale)).winter) << "grass, though hardly green";
}

}  // namespace
}  // namespace belvedere
