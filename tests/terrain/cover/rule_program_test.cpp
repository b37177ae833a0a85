#include "terrain/cover/rule_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "base/grid.h"
#include "base/random.h"
#include "terrain/cover/ground_variables.h"

namespace belvedere {
namespace {

const GeoTransform transform{4000.0, 9000.0, 30.0, 30.0};

RuleProgram program_of(const std::string& term, const std::string& condition) {
  return compile_expressions(expression_names(KnownTo::rules), {{"k", 2.0}}, {{"t", term}},
                             {{condition, "condition"}}, "test", {});
}

std::size_t slot_of(const std::string& name) {
  const std::vector<std::string> names = expression_names(KnownTo::rules);
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// The values of the condition in a rectangle of the raster; altitudes are a grid, eastings are made
// row by row.
Grid<float> values_of(const RuleProgram& program, const Grid<float>& altitude_m,
                      const PixelRect& cells) {
  const Grid<float> part = part_of(altitude_m, cells);
  const auto fill = [&](std::size_t slot, int y, float* out) {
    EXPECT_EQ(slot, slot_of("easting"));
    for (int x = 0; x < cells.width(); ++x)
      out[x] = static_cast<float>(transform.to_crs(cells.x0 + x, cells.y0 + y).x);
  };
  const RuleGrids grids(program, program.all_needs(), transform, cells, 5, {&part}, fill);
  RuleRows rows(grids);
  std::array<float, rule_block> values{};
  Grid<float> out(cells.width(), cells.height());
  for (int y = 0; y < out.height(); ++y) {
    rows.start(y);
    for (int begin = 0; begin < out.width(); begin += rule_block) {
      rows.go_to(begin);
      rows.evaluate(*program.conditions[0], values.data());
      std::copy_n(values.begin(), std::min(rule_block, out.width() - begin), out.row(y) + begin);
    }
  }
  return out;
}

Grid<float> altitudes() {
  Grid<float> altitude_m(600, 9);
  for (std::size_t i = 0; i < altitude_m.size(); ++i) altitude_m[i] = static_cast<float>(i % 601);
  return altitude_m;
}

TEST(RuleRows, GridsNoiseRowsAndTermsMeetInTheirCells) {
  const Grid<float> altitude_m = altitudes();
  const Grid<float> values =
      values_of(program_of("altitude + k * n210", "t - easting"), altitude_m, {0, 0, 600, 9});
  for (int y = 0; y < 9; y += 4)
    for (const int x : {0, 255, 256, 511, 512, 599}) {
      const glm::dvec2 position = transform.to_crs(x, y);
      const double noise =
          gaussian_noise(stream_seed(5, Stream::class_noise, 1), position.x, position.y, 210.0);
      EXPECT_NEAR(values(x, y), altitude_m(x, y) + 2.0 * noise - position.x, 1e-3) << x << ' ' << y;
    }
}

TEST(RuleRows, AnyRectangleHasTheBitsOfTheWhole) {
  const Grid<float> altitude_m = altitudes();
  const RuleProgram program = program_of("altitude * n60", "t + n1800 * easting");
  const Grid<float> whole = values_of(program, altitude_m, {0, 0, 600, 9});
  for (const PixelRect& cells :
       {PixelRect{17, 2, 590, 8}, PixelRect{300, 0, 301, 9}, PixelRect{0, 3, 256, 4}})
    EXPECT_TRUE(values_of(program, altitude_m, cells) == part_of(whole, cells)) << cells.x0;
}

TEST(RuleProgram, NeedsWhatItsTermsNeedAndNoMore) {
  const std::vector<bool> needs = program_of("slope + n60", "t > 0").all_needs();
  for (std::size_t v = 0; v < needs.size(); ++v)
    EXPECT_EQ(needs[v], v == slot_of("slope") || v == slot_of("n60") || v + 1 == needs.size()) << v;
  EXPECT_FALSE(program_of("slope", "").conditions[0].has_value());
}

}  // namespace
}  // namespace belvedere
