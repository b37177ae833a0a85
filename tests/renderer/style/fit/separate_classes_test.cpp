#include "renderer/style/fit/separate_classes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

ClassRamps summer() { return palette_ramps(read_palette("summer")); }

double hue_deg(const glm::dvec3& lab) {
  return std::atan2(lab.z, lab.y) * 180.0 / std::numbers::pi;
}

// Rock exactly as light and as coloured as grass.
ClassRamps with_rock_like_grass() {
  ClassRamps ramps = summer();
  ramps[index_of(rock)] = ramps[index_of(alpine_grass)];
  for (glm::dvec3& colour : ramps[index_of(rock)]) colour.y += 0.005;
  return ramps;
}

TEST(SeparateClasses, MovesAPairApartTheWayTheReferenceSays) {
  const ClassRamps reference = summer();
  const ClassRamps before = with_rock_like_grass();
  ClassFlags seen{};
  seen.fill(true);
  const ClassRamps after = separate_classes(before, seen, reference);
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
    const auto between = [&](const ClassRamps& ramps) {
      return ramps[index_of(rock)][k] - ramps[index_of(alpine_grass)][k];
    };
    EXPECT_GT(glm::length(between(after)), glm::length(between(before)) + 0.02);
    const double usual = between(reference).x;
    if (std::abs(usual) > 0.03) {
      EXPECT_GT(between(after).x * usual, 0.0);
    }
  }
  EXPECT_LT(lacking_distance(after, reference), lacking_distance(before, reference));
}

TEST(SeparateClasses, HuesStayThePaintersWithinTheirBounds) {
  const ClassRamps reference = summer();
  ClassRamps before = with_rock_like_grass();
  before[index_of(pasture)] = before[index_of(forest)];
  ClassFlags seen{};
  seen.fill(true);
  seen[index_of(pasture)] = false;
  const ClassRamps after = separate_classes(before, seen, reference);
  for (std::size_t c = 1; c < after.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k) {
      const double had = chroma(before[c][k]);
      if (had <= 0.012) continue;
      const double turn = std::remainder(hue_deg(after[c][k]) - hue_deg(before[c][k]), 360.0);
      EXPECT_LE(std::abs(turn), (seen[c] ? 8.0 : 22.0) + 1e-6) << land_cover_table[c].name;
      EXPECT_GE(chroma(after[c][k]), 0.9 * had - 1e-9);
      EXPECT_LE(chroma(after[c][k]), std::max(1.2 * had, had + 0.01) + 1e-9);
    }
}

// A reference whose rock and grass differ only in hue rotates hues up to the limits.
TEST(SeparateClasses, HuesThatArePushedStopAtTheirBounds) {
  ClassRamps reference = summer();
  ClassRamps before = reference;
  for (std::size_t k = 0; k < 4; ++k) {
    const double light = 0.3 + 0.15 * static_cast<double>(k);
    reference[index_of(rock)][k] = {light, 0.15, 0.0};
    reference[index_of(alpine_grass)][k] = {light, -0.15, 0.0};
    before[index_of(rock)][k] = before[index_of(alpine_grass)][k] = {light, 0.0, 0.06};
  }
  ClassFlags seen{};
  seen.fill(true);
  seen[index_of(alpine_grass)] = false;
  const ClassRamps after = separate_classes(before, seen, reference);
  EXPECT_NEAR(hue_deg(after[index_of(rock)][1]), 90.0 - 8.0, 0.01);
  EXPECT_NEAR(hue_deg(after[index_of(alpine_grass)][1]), 90.0 + 22.0, 0.01);
}

TEST(SeparateClasses, ADerivedClassGivesWayMore) {
  const ClassRamps reference = summer();
  const ClassRamps before = with_rock_like_grass();
  ClassFlags seen{};
  seen.fill(true);
  seen[index_of(rock)] = false;
  SeparateParameters once;
  once.passes = 1;
  const ClassRamps after = separate_classes(before, seen, reference, once);
  EXPECT_GT(glm::length(after[index_of(rock)][1] - before[index_of(rock)][1]),
            glm::length(after[index_of(alpine_grass)][1] - before[index_of(alpine_grass)][1]));
}

TEST(SeparateClasses, LeavesWhatIsFarEnough) {
  const ClassRamps reference = summer();
  ClassFlags seen{};
  seen.fill(true);
  EXPECT_NEAR(lacking_distance(reference, reference), 0.0, 0.01);
  const ClassRamps after = separate_classes(reference, seen, reference);
  for (std::size_t c = 1; c < after.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LT(glm::length(after[c][k] - reference[c][k]), 0.02) << land_cover_table[c].name;
}

TEST(StrengthenChroma, OnlyWhereDistanceLacksAndNoStrongerThanThePainter) {
  const test::Landscape landscape = test::make_landscape();
  const StylePainting painting = prepare_painting(landscape.picture, landscape.mask);
  const ClassRamps reference = summer();
  ClassRamps pale = reference;
  for (LabRamp& ramp : pale)
    for (glm::dvec3& colour : ramp) colour = {0.3 * colour.x + 0.4, 0.3 * colour.y, 0.3 * colour.z};
  const ClassRamps strong = strengthen_chroma(pale, reference, painting);
  EXPECT_GT(chroma(strong[index_of(pasture)][2]), 1.2 * chroma(pale[index_of(pasture)][2]));
  EXPECT_LE(chroma(strong[index_of(pasture)][2]), 1.31 * chroma(pale[index_of(pasture)][2]));
  ClassRamps gaudy = reference;
  for (LabRamp& ramp : gaudy)
    for (glm::dvec3& colour : ramp) colour = {colour.x, 4.0 * colour.y, 4.0 * colour.z};
  const ClassRamps held = strengthen_chroma(gaudy, reference, painting);
  EXPECT_LT(chroma(held[index_of(pasture)][2]), 0.6 * chroma(gaudy[index_of(pasture)][2]));
}

}  // namespace
}  // namespace belvedere
