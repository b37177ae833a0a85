#include "renderer/register/match_paint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "base/statistics.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr int width = 160, height = 90;

// Rolling hills without a repeat within a patch, all at the same distance.
glm::vec3 normal_of_hills(double x, double y) {
  const double east = std::sin(0.31 * x + 0.11 * y) + 0.7 * std::sin(0.17 * x - 0.23 * y + 1.0);
  const double north = std::cos(0.13 * x + 0.27 * y) + 0.7 * std::sin(0.37 * y - 0.05 * x);
  return glm::normalize(glm::vec3(static_cast<float>(east), static_cast<float>(north), 1.F));
}

RegisteredGround hill_ground() {
  RegisteredGround out{Grid<float>(width, height, 1000.F), Grid<float>(width, height, 20000.F),
                       Grid<float>(width, height, 2.F)};
  out.position = Grid<glm::dvec2>(width, height);
  out.normal = Grid<glm::vec3>(width, height);
  for (const auto [x, y] : test::cells(width, height)) out.normal(x, y) = normal_of_hills(x, y);
  return out;
}

// The hills as a painter lights them, moved by a shift, with strokes that nobody can predict.
Grid<glm::vec3> painted_hills(glm::dvec2 shift, float noise) {
  const glm::vec3 sun = glm::normalize(glm::vec3(-1.F, 0.6F, 0.8F));
  Grid<glm::vec3> out(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const float lit = glm::dot(normal_of_hills(x - shift.x, y - shift.y), sun);
    const auto stroke = static_cast<float>(random_normal(3, x, y));
    out(x, y) = glm::vec3(0.5F + 0.2F * lit, 0.05F, 0.02F - 0.1F * lit) + noise * stroke;
  }
  return out;
}

constexpr MatchPaintParameters example = {
    .half_px = 14, .reach_px = {9, 7}, .spacing_px = 20, .prior_px = 4.0};

TEST(MatchPaint, FindsAShiftUnderAnUnknownLight) {
  const RegisteredGround ground = hill_ground();
  for (const glm::dvec2 shift : {glm::dvec2(0.0, 0.0), glm::dvec2(5.0, -3.0)}) {
    const std::vector<PaintMatch> found = match_paint(painted_hills(shift, 0.03F), ground, example);
    ASSERT_GE(found.size(), 20U);
    std::vector<double> off;
    for (const PaintMatch& match : found) off.push_back(glm::length(match.shift_px - shift));
    EXPECT_LT(median(off), 0.3);
    EXPECT_LT(percentile(off, 0.9), 1.5);
  }
}

// Noise of ten times the light leaves nothing to find, and even paint says nothing.
TEST(MatchPaint, PaintThatSaysNothingGivesNoMatch) {
  const RegisteredGround ground = hill_ground();
  EXPECT_LE(match_paint(painted_hills({0.0, 0.0}, 3.F), ground, example).size(), 2U);
  EXPECT_TRUE(
      match_paint(Grid<glm::vec3>(width, height, glm::vec3(0.5F)), ground, example).empty());
}

TEST(MatchPaint, LooksForNoPlacesInTheSky) {
  RegisteredGround ground = hill_ground();
  for (const auto [x, y] : test::cells(width, height / 2)) ground.altitude_m(x, y) = std::nanf("");
  for (const PaintMatch& match : match_paint(painted_hills({1.0, 1.0}, 0.03F), ground, example))
    EXPECT_GE(match.pixel.y, height / 2);
}

double evidence_at(const Grid<glm::vec3>& paint, const RegisteredGround& ground) {
  double sum = 0.0;
  const Grid<double> evidence = paint_evidence(
      paint, ground, {.half_px = 10, .reach_px = {3, 3}, .spacing_px = 10, .prior_px = 2.0});
  for (const double each : evidence) sum += std::isnan(each) ? 0.0 : each;
  return sum;
}

TEST(MatchPaint, TheEvidenceIsLargestWhereTheGroundIsPainted) {
  const RegisteredGround ground = hill_ground();
  const double right = evidence_at(painted_hills({0.0, 0.0}, 0.03F), ground);
  EXPECT_GT(right, evidence_at(painted_hills({5.0, 0.0}, 0.03F), ground) + 100.0);
  EXPECT_GT(right, evidence_at(painted_hills({0.0, 0.0}, 0.3F), ground) + 100.0);
}

TEST(MatchPaint, TheSkyHasNoEvidence) {
  RegisteredGround ground = hill_ground();
  for (const auto [x, y] : test::cells(width, height / 2)) ground.altitude_m(x, y) = std::nanf("");
  const Grid<double> evidence = paint_evidence(painted_hills({0.0, 0.0}, 0.03F), ground, example);
  EXPECT_TRUE(std::isnan(evidence(3, 1)));
  EXPECT_FALSE(std::isnan(evidence(3, 3)));
}

}  // namespace
}  // namespace belvedere
