#include "texture/synthesis/match_cost.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

Exemplar noise(int width, int height, std::uint64_t seed) {
  Exemplar exemplar;
  exemplar.name = "noise";
  exemplar.picture = Grid<Rgb8>(width, height);
  exemplar.guides.label = Grid<std::uint8_t>(width, height);
  Grid<std::uint8_t> altitude(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    for (std::size_t c = 0; c < 3; ++c)
      exemplar.picture(x, y)[c] = static_cast<std::uint8_t>(random_index(256, seed, x, y, c));
    exemplar.guides.label(x, y) = x < width / 2 ? 3 : 200;
    altitude(x, y) = static_cast<std::uint8_t>(random_index(256, seed, x, y, 4));
  }
  exemplar.guides.guides = {{"altitude", altitude}};
  return exemplar;
}

// Copied with one offset.
MatchField shifted(int width, int height, int dx, int dy) {
  MatchField matches(width, height);
  for (const auto [x, y] : test::cells(width, height))
    matches(x, y) = {0, static_cast<std::uint16_t>(x + dx), static_cast<std::uint16_t>(y + dy)};
  return matches;
}

TEST(MatchCost, APieceOfTheExemplarCostsNothing) {
  const std::vector<Exemplar> exemplars{noise(40, 30, 1)};
  const MatchField matches = shifted(20, 12, 9, 8);
  Grid<std::uint8_t> labels(20, 12);
  GuideStack target;
  target.guides = {{"altitude", Grid<std::uint8_t>(20, 12)}};
  for (const auto [x, y] : test::cells(20, 12)) {
    labels(x, y) = exemplars[0].guides.label(x + 9, y + 8);
    target.guides[0].values(x, y) = exemplars[0].guides.guides[0].values(x + 9, y + 8);
  }
  target.label = labels;
  EXPECT_EQ(seam_cost(matches, exemplars, labels, {}), Grid<float>(20, 12, 0.F));
  EXPECT_EQ(guide_error(matches, exemplars, target, "altitude"), Grid<std::uint8_t>(20, 12, 0));
}

// Compared with the sum written out: weights round(16 exp(-r²/8)), colour differences squared, an
// eighth of it, and 3000 per pixel of another class.
TEST(MatchCost, SeamsAreTheSumOverThePatch) {
  const std::vector<Exemplar> exemplars{noise(31, 29, 2), noise(40, 33, 3)};
  MatchField matches(24, 21);
  Grid<std::uint8_t> labels(24, 21);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const std::size_t e = random_index(2, 5, static_cast<int>(i), 0);
    // Away from the exemplar's edge, where the padding's colours would enter.
    matches[i] = {static_cast<std::uint16_t>(e),
                  static_cast<std::uint16_t>(3 + random_index(25, 5, static_cast<int>(i), 1)),
                  static_cast<std::uint16_t>(3 + random_index(23, 5, static_cast<int>(i), 2))};
    labels[i] = exemplars[e].guides.label(matches[i].x, matches[i].y);
  }
  matches(5, 5) = {};
  labels(7, 7) = unused_label;
  const Grid<float> found = seam_cost(matches, exemplars, labels, {});
  const auto colour = [&](int x, int y) {
    const Match& m = matches(x, y);
    return m.exemplar == Match::none ? Rgb8{} : exemplars[m.exemplar].picture(m.x, m.y);
  };
  for (const auto& [x, y] : {std::pair{10, 10}, {3, 3}, {12, 17}, {0, 0}, {23, 20}, {6, 8}}) {
    const Match& m = matches(x, y);
    double sum = 0.0;
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i) {
        if (!matches.contains(x + i, y + j) || labels(x + i, y + j) == unused_label) continue;
        const Rgb8 here = colour(x + i, y + j);
        const Rgb8 there = exemplars[m.exemplar].picture(m.x + i, m.y + j);
        const double weight = std::round(16.0 * std::exp(-(i * i + j * j) / 8.0));
        for (std::size_t c = 0; c < 3; ++c)
          sum += weight * (here[c] - there[c]) * (here[c] - there[c]);
        if (labels(x + i, y + j) != exemplars[m.exemplar].guides.label(m.x + i, m.y + j))
          sum += 8.0 * 3000.0;
      }
    EXPECT_EQ(found(x, y), static_cast<float>(std::floor(sum / 8.0))) << x << ", " << y;
  }
  EXPECT_EQ(found(5, 5), 0.F);
  EXPECT_EQ(found(7, 7), 0.F);
  const ThreadLimit one(1);
  EXPECT_EQ(seam_cost(matches, exemplars, labels, {}), found);
}

TEST(MatchCost, BeyondASilhouetteNothingCounts) {
  const std::vector<Exemplar> exemplars{noise(60, 30, 4)};
  MatchField matches = shifted(20, 12, 2, 8);
  for (int y = 0; y < 12; ++y)
    for (int x = 10; x < 20; ++x)
      matches(x, y).x = static_cast<std::uint16_t>(x + 35);  // a seam at x = 10 …
  Grid<std::uint8_t> labels(20, 12);
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i] = exemplars[0].guides.label(matches[i].x, matches[i].y);
  Grid<float> depth(20, 12, 1000.F);
  for (const auto [x, y] : test::cells({10, 0, 20, 12}))
    depth(x, y) = 5000.F;  // … where the ground behind begins
  EXPECT_GT(seam_cost(matches, exemplars, labels, {})(9, 6), 0.F);
  EXPECT_EQ(seam_cost(matches, exemplars, labels, depth), Grid<float>(20, 12, 0.F));
}

TEST(MatchCost, GuidesAndUses) {
  std::vector<Exemplar> exemplars{noise(8, 8, 5)};
  exemplars[0].guides.guides[0].values(3, 4) = 250;
  MatchField matches(2, 2, {0, 3, 4});
  matches(1, 1) = {};
  GuideStack target;
  target.label = Grid<std::uint8_t>(2, 2, 3);
  target.guides = {{"altitude", Grid<std::uint8_t>(2, 2, 240)},
                   {"tone", Grid<std::uint8_t>(2, 2, 0)}};
  const Grid<std::uint8_t> off = guide_error(matches, exemplars, target, "altitude");
  EXPECT_EQ(off(0, 0), 10);
  EXPECT_EQ(off(1, 1), 0);
  EXPECT_EQ(guide_cost(10, 0.5), 270.F * 0.5F * 100.F);
  const auto uses = texel_uses(matches, exemplars);
  EXPECT_EQ(uses[0](3, 4), 3U);
  EXPECT_EQ(uses[0](0, 0), 0U);

  EXPECT_THAT(test::usage_error([&] { guide_error(matches, exemplars, target, "tone"); }),
              HasSubstr("tone"));
  matches(0, 0).x = 8;
  EXPECT_THAT(test::usage_error([&] { texel_uses(matches, exemplars); }), HasSubstr("outside"));
}

}  // namespace
}  // namespace belvedere
