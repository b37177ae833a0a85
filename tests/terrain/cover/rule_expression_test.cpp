#include "terrain/cover/rule_expression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/math.h"
#include "base/random.h"

namespace belvedere {
namespace {

const RuleNames names = {{"altitude", "slope", "south"}, {{"treeline_m", 1820.0}, {"winter", 0.0}}};

// The value for altitude 1000 and south -0.5; slope is the number of the cell.
std::vector<float> values(const std::string& text) {
  const RuleExpression expression(text, names, "rules.toml", {1, 1});
  const std::vector<float> altitude(rule_block, 1000.F);
  const std::vector<float> south(rule_block, -0.5F);
  std::vector<float> slope(rule_block);
  for (int i = 0; i < rule_block; ++i) slope[static_cast<std::size_t>(i)] = static_cast<float>(i);
  std::vector<float> out(rule_block, -1.F);
  RuleExpression::Scratch scratch;
  expression.evaluate({altitude.data(), slope.data(), south.data()}, out.data(), scratch);
  return out;
}

float value(const std::string& text) { return values(text)[0]; }

std::string fault(const std::string& text, ConfigPosition position = {4, 8}) {
  try {
    const RuleExpression expression(text, names, "rules.toml", position);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    return e.where() + " " + e.found();
  }
  return "no fault";
}

TEST(RuleExpression, Precedence) {
  EXPECT_EQ(value("1 + 2 * 3"), 7.F);
  EXPECT_EQ(value("(1 + 2) * 3"), 9.F);
  EXPECT_EQ(value("10 - 4 - 3"), 3.F);
  EXPECT_EQ(value("16 / 4 / 2"), 2.F);
  EXPECT_EQ(value("-2 * -3 + -1"), 5.F);
  EXPECT_EQ(value("2 - -3"), 5.F);
  EXPECT_EQ(value("1 + 1 < 3"), 1.F);
  EXPECT_EQ(value("1 or 0 and 0"), 1.F);
  EXPECT_EQ(value("(1 or 0) and 0"), 0.F);
  EXPECT_EQ(value("not 1 > 2"), 1.F);
  EXPECT_EQ(value("not 0 and 0"), 0.F);
  EXPECT_EQ(value("altitude - 500 > 400 and not south > 0"), 1.F);
  EXPECT_EQ(value(".5e1"), 5.F);
}

TEST(RuleExpression, Comparisons) {
  EXPECT_EQ(value("1 < 1"), 0.F);
  EXPECT_EQ(value("1 <= 1"), 1.F);
  EXPECT_EQ(value("1 > 1"), 0.F);
  EXPECT_EQ(value("1 >= 1"), 1.F);
  EXPECT_EQ(value("south > -1"), 1.F);
  EXPECT_EQ(values("slope >= 100")[99], 0.F);
  EXPECT_EQ(values("slope >= 100")[100], 1.F);
  // Both sides are computed in separate memory.
  EXPECT_EQ(values("slope * 2 > slope + 10")[10], 0.F);
  EXPECT_EQ(values("slope * 2 > slope + 10")[11], 1.F);
}

TEST(RuleExpression, Functions) {
  EXPECT_EQ(value("min(3, 1, 2)"), 1.F);
  EXPECT_EQ(value("max(3, 1, altitude, 2)"), 1000.F);
  EXPECT_EQ(values("max(slope, 7)")[200], 200.F);
  EXPECT_EQ(value("clip(1.5)"), 1.F);
  EXPECT_EQ(value("clip(-3, -2, 2)"), -2.F);
  EXPECT_EQ(value("clamp(altitude / 2000)"), 0.5F);
  EXPECT_EQ(value("abs(south)"), 0.5F);
  EXPECT_FLOAT_EQ(value("sin(1) * sin(1) + cos(1) * cos(1)"), 1.F);
  EXPECT_FLOAT_EQ(value("exp(south)"), std::exp(-0.5F));
  EXPECT_EQ(value("sqrt(altitude - 100)"), 30.F);
  EXPECT_EQ(value("sqrt(-4)"), 0.F);
  EXPECT_EQ(value("smoothstep(altitude, 500, 1500)"), 0.5F);
  EXPECT_EQ(value("smoothstep(altitude, 1000, 1000)"), 1.F);
  EXPECT_FLOAT_EQ(values("smoothstep(slope, 0, 4)")[1], 0.15625F);
  EXPECT_EQ(value("treeline_m - altitude"), 820.F);
}

TEST(RuleExpression, HatIsAClampedMinimumOfTwoRamps) {
  const std::vector<float> h = values("hat(slope, 20, 60, 10)");
  EXPECT_EQ(h[14], 0.F);
  EXPECT_EQ(h[20], 0.5F);
  EXPECT_FLOAT_EQ(h[22], 0.7F);
  EXPECT_EQ(h[26], 1.F);
  EXPECT_EQ(h[54], 1.F);
  EXPECT_EQ(h[60], 0.5F);
  EXPECT_EQ(h[66], 0.F);
  EXPECT_EQ(values("hat(slope, 20, 60, 0)")[20], 1.F);
  EXPECT_EQ(values("hat(slope, 20, 60, 0)")[61], 0.F);
}

// Every step of a block, cell by cell, over numbers of all kinds; the last line's results take the
// place of operands.
TEST(RuleExpression, StepsAreThoseOfOneCellAfterTheOther) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> special = {0.F, -0.F, 1.F,  -1.F,   0.5F, 2.F,
                                      nan, inf,  -inf, 1e-40F, 3e38F};
  const auto make = [&](std::int64_t column) {
    std::vector<float> cells(rule_block);
    for (int i = 0; i < rule_block; ++i)
      cells[static_cast<std::size_t>(i)] =
          random_uniform(7, column, i, 0) < 0.7
              ? special[random_bits(7, column, i, 1) % special.size()]
              : static_cast<float>(4.0 * random_uniform(7, column, i, 2) - 2.0);
    return cells;
  };
  const std::vector<float> a = make(0), b = make(1), c = make(2);
  using Plain = float (*)(float, float, float);
  const std::vector<std::pair<std::string, Plain>> steps = {
      {"altitude + slope", [](float x, float y, float) { return x + y; }},
      {"altitude - slope", [](float x, float y, float) { return x - y; }},
      {"altitude * slope", [](float x, float y, float) { return x * y; }},
      {"altitude / slope", [](float x, float y, float) { return x / y; }},
      {"altitude < slope", [](float x, float y, float) { return x < y ? 1.F : 0.F; }},
      {"altitude <= slope", [](float x, float y, float) { return x <= y ? 1.F : 0.F; }},
      {"altitude and slope",
       [](float x, float y, float) { return x > 0.F && y > 0.F ? 1.F : 0.F; }},
      {"altitude or slope", [](float x, float y, float) { return x > 0.F || y > 0.F ? 1.F : 0.F; }},
      {"-altitude", [](float x, float, float) { return -x; }},
      {"not altitude", [](float x, float, float) { return x > 0.F ? 0.F : 1.F; }},
      {"min(altitude, slope)", [](float x, float y, float) { return x < y ? x : y; }},
      {"max(altitude, slope)", [](float x, float y, float) { return x > y ? x : y; }},
      {"abs(altitude)", [](float x, float, float) { return std::abs(x); }},
      {"sqrt(altitude)", [](float x, float, float) { return x > 0.F ? std::sqrt(x) : 0.F; }},
      {"clip(altitude, slope, south)",
       [](float x, float y, float z) {
         const float raised = x > y ? x : y;
         return raised < z ? raised : z;
       }},
      {"smoothstep(altitude, slope, south)",
       [](float x, float y, float z) {
         if (!(y < z)) return x < y ? 0.F : 1.F;
         return smoothstep(y, z, x);
       }},
      {"hat(altitude, slope, 1, south)",
       [](float x, float y, float z) {
         const float inside = std::min(x - y, 1.F - x);
         return z > 0.F ? unit(inside / z + 0.5F) : (inside >= 0.F ? 1.F : 0.F);
       }},
      {"((altitude - slope) * (slope + south) - (altitude * south)) / (south - slope)",
       [](float x, float y, float z) { return ((x - y) * (y + z) - x * z) / (z - y); }}};
  for (const auto& [text, plain] : steps) {
    std::vector<float> out(rule_block);
    RuleExpression::Scratch scratch;
    RuleExpression(text, names, "rules.toml", {1, 1})
        .evaluate({a.data(), b.data(), c.data()}, out.data(), scratch);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float expected = plain(a[i], b[i], c[i]);
      if (std::isnan(expected))
        EXPECT_TRUE(std::isnan(out[i])) << text << ' ' << a[i] << ' ' << b[i] << ' ' << c[i];
      else
        EXPECT_EQ(std::bit_cast<std::uint32_t>(out[i]), std::bit_cast<std::uint32_t>(expected))
            << text << ' ' << a[i] << ' ' << b[i] << ' ' << c[i];
    }
  }
}

TEST(RuleExpression, DeepButHonestNestingWorks) {
  EXPECT_EQ(
      value("((((((((((altitude + ((slope + (south + (1 + 2) * south) * 2) * 2) * 2))))))))))"),
      1000.F + 4.F * (-0.5F - 1.5F) * 2.F);
  EXPECT_EQ(value("south * (south + south * (south + south * (altitude - 1000)))"),
            -0.5F * (-0.5F + -0.5F * -0.5F));
}

TEST(RuleExpression, KnowsItsVariables) {
  EXPECT_THAT(RuleExpression("south + altitude * south", names, "", {}).variables(),
              testing::ElementsAre(0, 2));
  EXPECT_TRUE(RuleExpression("treeline_m + winter", names, "", {}).variables().empty());
}

TEST(RuleExpression, FaultsNameFileLineAndColumn) {
  // The text stands behind its quote: `when = "…"` with the quote in column 8.
  EXPECT_EQ(fault("altitude > treline_m"),
            "rules.toml:4:20 unknown name \"treline_m\"; did you mean \"treeline_m\"?");
  EXPECT_EQ(fault("clap(altitude)"),
            "rules.toml:4:9 unknown function \"clap\"; did you mean \"clip\"?");
  EXPECT_EQ(fault("1 < slope < 3"), "rules.toml:4:19 chained comparison");
  EXPECT_EQ(fault("(1 + 2"), "rules.toml:4:15 unexpected end of the expression");
  EXPECT_EQ(fault("1 + "), "rules.toml:4:13 unexpected end of the expression");
  EXPECT_EQ(fault(""), "rules.toml:4:9 unexpected end of the expression");
  EXPECT_EQ(fault("1 2"), "rules.toml:4:11 unexpected \"2\"");
  EXPECT_EQ(fault("2slope"), "rules.toml:4:10 letter directly after a number");
  EXPECT_EQ(fault("slope = 3"), "rules.toml:4:15 unexpected character \"=\"");
  EXPECT_EQ(fault("clip(1, 2)"), "rules.toml:4:9 clip with 2 values");
  EXPECT_EQ(fault("max(1)"), "rules.toml:4:9 max with 1 value");
  EXPECT_EQ(fault("hat(1, 2, 3)"), "rules.toml:4:9 hat with 3 values");
  EXPECT_EQ(fault("1e999"), "rules.toml:4:9 number too large");
  EXPECT_EQ(fault("slope and"), "rules.toml:4:18 unexpected end of the expression");
  // A text of several lines starts below its quotes.
  EXPECT_EQ(fault("altitude > 3\n  and slop > 2\n"),
            "rules.toml:6:7 unknown name \"slop\"; did you mean \"slope\"?");
  EXPECT_THAT(fault("slop", {}), testing::StartsWith("rules.toml unknown name"));
  const std::string deep(100000, '(');
  EXPECT_THAT(fault(deep), testing::HasSubstr("nested too deeply"));
  EXPECT_THAT(fault(std::string(100000, '-') + "1"), testing::HasSubstr("nested too deeply"));
}

}  // namespace
}  // namespace belvedere
