// The plain algorithm, held against one that is plainer still.
#include "texture/basic/basic_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/files.h"
#include "tests/texture/synthesis/made_up_land.h"

namespace belvedere {
namespace {

using namespace test;

MatchField run_basic(const std::vector<Exemplar>& exemplars, const GuideStack& target, const BasicParameters& parameters) {
  return synthesize_basic(exemplars, target, parameters, silent_progress());
}

// Squares of the differences of class shares, in 255ths, of the squares around two places.
double class_difference(const Grid<std::uint8_t>& a, int ax, int ay, const Grid<std::uint8_t>& b, int bx, int by, int radius) {
  const auto shares = [radius](const Grid<std::uint8_t>& labels, int x, int y) {
    std::vector<int> counts(256, 0);
    int total = 0;
    for (int j = y - radius; j <= y + radius; ++j) {
      for (int i = x - radius; i <= x + radius; ++i) {
        if (!labels.contains(i, j) || labels(i, j) == unused_label) continue;
        ++counts[labels(i, j)];
        ++total;
      }
    }
    for (int& count : counts) count = static_cast<int>(std::floor(255.0 * count / total + 0.5));
    return counts;
  };
  const std::vector<int> of_a = shares(a, ax, ay);
  const std::vector<int> of_b = shares(b, bx, by);
  double sum = 0.0;
  for (std::size_t k = 0; k < 256; ++k) sum += (of_a[k] - of_b[k]) * (of_a[k] - of_b[k]);
  return sum;
}

// C as basic_synthesis.h states it: first what classes cost, then the rest.
std::pair<double, double> cost_of(const std::vector<Exemplar>& exemplars, const GuideStack& target, const BasicParameters& p,
                                  const MatchField& field, int x, int y, const Match& m) {
  const Exemplar& from = exemplars[m.exemplar];
  const int radius = p.neighbourhood / 2;
  double colour = 0.0;
  int made = 0;
  for (int dy = -radius; dy <= 0; ++dy) {
    for (int dx = -radius; dx <= radius && (dy < 0 || dx < 0); ++dx) {
      if (!field.contains(x + dx, y + dy) || field(x + dx, y + dy).exemplar == Match::none) continue;
      const Match& q = field(x + dx, y + dy);
      ++made;
      colour += from.picture.contains(m.x + dx, m.y + dy)
                    ? p.distance.between(exemplars[q.exemplar].picture(q.x, q.y), from.picture(m.x + dx, m.y + dy))
                    : p.distance.largest;
    }
  }
  double rest = made > 0 ? colour / made : 0.0;
  for (std::size_t g = 0; g < target.guides.size(); ++g) {
    const double off = target.guides[g].values(x, y) - from.guides.guides[g].values(m.x, m.y);
    rest += 6.2 * p.weights[g].second * off * off;
  }
  const double classes = class_difference(target.label, x, y, from.guides.label, m.x, m.y, radius);
  return std::isinf(p.land_cover) ? std::pair{classes, rest} : std::pair{0.0, rest + p.land_cover * classes};
}

TEST(BasicSynthesis, NoTexelCostsLessThanTheOneTaken) {
  std::vector<Exemplar> exemplars{painting(13, 11, 1), painting(9, 10, 2)};
  exemplars[0].guides.label(4, 4) = unused_label;
  GuideStack target = land(11, 9, 40);
  target.label(7, 5) = unused_label;
  for (const ColourDistance& distance : colour_distances()) {
    for (const double land_cover : {0.0, 0.5, std::numeric_limits<double>::infinity()}) {
      const BasicParameters p{
          .neighbourhood = 5, .distance = distance, .weights = {{"altitude", 0.3}, {"tone", 0.0}}, .land_cover = land_cover};
      const MatchField field = run_basic(exemplars, target, p);
      MatchField made(11, 9);
      for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 11; ++x) {
          if (target.label(x, y) == unused_label) {
            ASSERT_EQ(field(x, y), Match{});
            continue;
          }
          const std::pair<double, double> taken = cost_of(exemplars, target, p, made, x, y, field(x, y));
          for (std::uint16_t e = 0; e < 2; ++e) {
            const Grid<std::uint8_t>& labels = exemplars[e].guides.label;
            for (std::uint16_t v = 0; v < labels.height(); ++v) {
              for (std::uint16_t u = 0; u < labels.width(); ++u) {
                if (labels(u, v) == unused_label) continue;
                const auto cost = cost_of(exemplars, target, p, made, x, y, {e, u, v});
                ASSERT_GE(cost.first, taken.first);
                if (cost.first == taken.first) {
                  ASSERT_GE(cost.second, taken.second - 1e-6) << distance.name << ' ' << land_cover << ": " << x << ", " << y;
                }
              }
            }
          }
          made(x, y) = field(x, y);
        }
      }
    }
  }
}

TEST(BasicSynthesis, TheSameColourIsNoDistanceAway) {
  for (const ColourDistance& distance : colour_distances()) {
    EXPECT_EQ(find_colour_distance(distance.name)->between, distance.between);
    EXPECT_EQ(distance.between({0, 0, 0}, {255, 255, 255}), distance.largest);
    for (int i = 0; i < 200; ++i) {
      const auto colour = [i](std::uint64_t seed) {
        const std::uint64_t bits = random_bits(seed, i, 0);
        return Rgb8{static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8), static_cast<std::uint8_t>(bits >> 16)};
      };
      const Rgb8 a = colour(1);
      const Rgb8 b = colour(2);
      EXPECT_EQ(distance.between(a, a), 0);
      EXPECT_EQ(distance.between(a, b), distance.between(b, a));
      EXPECT_GE(distance.between(a, b), 0);
      EXPECT_LE(distance.between(a, b), distance.largest);
    }
  }
  EXPECT_EQ(find_colour_distance("squares")->between({10, 20, 30}, {13, 16, 35}), 9 + 16 + 25);
  EXPECT_EQ(find_colour_distance("absolute")->between({10, 20, 30}, {13, 16, 35}), 255 * (3 + 4 + 5));
  EXPECT_EQ(find_colour_distance("grey")->between({0, 0, 0}, {8, 8, 8}), 3 * 64);
  EXPECT_EQ(find_colour_distance("hue"), nullptr);
}

// A painting's own guides, which tell every texel apart, give it back.
TEST(BasicSynthesis, OwnGuidesGiveTheExemplarBack) {
  Exemplar exemplar = painting(24, 20, 1);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 24; ++x) {
      exemplar.guides.guides[0].values(x, y) = static_cast<std::uint8_t>(10 * x);
      exemplar.guides.guides[1].values(x, y) = static_cast<std::uint8_t>(12 * y);
    }
  }
  const MatchField field = run_basic({exemplar}, exemplar.guides, {});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x) ASSERT_EQ(field(x, y), (Match{0, static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)}));
}

// Without labels as a filter, the price of classes is what keeps them apart.
TEST(BasicSynthesis, LabelsAgreeMoreTheDearerOtherClassesAre) {
  const std::vector<Exemplar> exemplars{painting(40, 36, 1)};
  const GuideStack target = land(30, 30, 40);
  double agreed = -1.0;
  for (const double land_cover : {0.0, 0.02, 0.3, std::numeric_limits<double>::infinity()}) {
    const MatchField field = run_basic(exemplars, target, {.weights = {{"altitude", 0}, {"tone", 0}}, .land_cover = land_cover});
    int same = 0;
    for (std::size_t i = 0; i < field.size(); ++i) same += exemplars[0].guides.label(field[i].x, field[i].y) == target.label[i] ? 1 : 0;
    EXPECT_GE(same, agreed) << land_cover;
    agreed = same;
  }
  EXPECT_GT(agreed, 0.9 * 900);
}

TEST(BasicSynthesis, CoherentPixelsContinueTheirNeighbours) {
  const std::vector<Exemplar> exemplars{painting(40, 36, 1)};
  const GuideStack target = land(30, 24, 40);
  const MatchField field = run_basic(exemplars, target, {.neighbourhood = 5, .coherent = true});
  int continued = 0;
  int free = 0;  // nothing that its neighbours copy goes on in its class
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 30; ++x) {
      std::set<std::pair<int, int>> candidates;
      for (int dy = -2; dy <= 0; ++dy) {
        for (int dx = -2; dx <= 2 && (dy < 0 || dx < 0); ++dx) {
          if (!field.contains(x + dx, y + dy)) continue;
          const std::pair<int, int> texel{field(x + dx, y + dy).x - dx, field(x + dx, y + dy).y - dy};
          if (exemplars[0].picture.contains(texel.first, texel.second) &&
              exemplars[0].guides.label(texel.first, texel.second) == target.label(x, y))
            candidates.insert(texel);
        }
      }
      if (candidates.empty()) {
        ++free;
        continue;
      }
      ASSERT_EQ(candidates.count({field(x, y).x, field(x, y).y}), 1U) << x << ", " << y;
      ++continued;
    }
  }
  EXPECT_GT(continued, 600);
  EXPECT_GT(free, 0);
}

TEST(BasicSynthesis, SameBitsForAnyThreads) {
  const std::vector<Exemplar> exemplars{painting(40, 36, 1), painting(20, 50, 2)};
  const GuideStack target = land(20, 20, 40);
  MatchField reference;
  {
    const ThreadLimit one(1);
    reference = run_basic(exemplars, target, {});
  }
  const ThreadLimit two(2);
  EXPECT_EQ(run_basic(exemplars, target, {}), reference);
}

TEST(BasicSynthesis, RefusesWhatItCannotUse) {
  const std::vector<Exemplar> exemplars{painting(40, 36, 1)};
  const GuideStack target = land(20, 20, 40);
  EXPECT_THROW(run_basic({}, target, {}), Error);
  EXPECT_THROW(run_basic(exemplars, target, {.neighbourhood = 4}), Error);
  EXPECT_THROW(run_basic(exemplars, target, {.land_cover = -1.0}), Error);
  GuideStack large = target;
  large.guides.clear();
  large.label = Grid<std::uint8_t>(1100, 1000, 3);
  Exemplar wide;
  wide.name = "wide";
  wide.guides.label = Grid<std::uint8_t>(1000, 1000, 3);
  wide.picture = Grid<Rgb8>(1000, 1000);
  EXPECT_EQ(test::error_of([&] { run_basic({wide}, large, {}); }).kind(), ErrorKind::limit) << "days of work";
}

}  // namespace
}  // namespace belvedere
