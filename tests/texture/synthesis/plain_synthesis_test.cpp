// Fast synthesis compared with the plain algorithm.
#include "tests/texture/synthesis/plain_synthesis.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/texture/synthesis/synthetic_land.h"
#include "texture/synthesis/match_cost.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

using namespace test;

struct Judged {
  double seams = 0.0;
  double altitude = 0.0;
  int max_used = 0;
};
Judged judge(const MatchField& field, const std::vector<Exemplar>& exemplars,
             const GuideStack& target) {
  const Grid<float> seams = seam_cost(field, exemplars, target.label, {});
  return {std::accumulate(seams.begin(), seams.end(), 0.0) / static_cast<double>(seams.size()),
          mean_guide_error(field, exemplars, target, 0), max_used(field)};
}

// It can serve as a reference only if it finds an exact match.
TEST(PlainSynthesis, OwnGuidesGiveTheExemplarBack) {
  Exemplar exemplar = painting(24, 20, 1);
  exemplar.guides.label = Grid<std::uint8_t>(24, 20, 3);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x)
      exemplar.guides.guides[0].values(x, y) = static_cast<std::uint8_t>((24 * y + x) / 2);
  for (const bool coherent : {false, true}) {
    const MatchField field = PlainSynthesis(exemplar, exemplar.guides, 100.0, coherent).run();
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 24; ++x) ASSERT_EQ(field(x, y).y, y) << x << ' ' << coherent;
  }
}

// Measured: seams .57 of the plain algorithm's, the guide's error 1.03, a texel used 7 times for
// 22; .61, .44 and 7 for 14 of the coherent one.
TEST(PlainSynthesis, IsNoBetterThanTheFastMethod) {
  const std::vector<Exemplar> exemplars{painting(64, 56, 1)};
  const GuideStack target = land(40, 40, 40);
  constexpr double weight = 0.3;
  SynthesisParameters parameters;
  parameters.weights = {{"altitude", weight}, {"tone", 0.0}};
  const Judged fast = judge(run(exemplars, target, parameters), exemplars, target);
  for (const bool coherent : {false, true}) {
    const Judged plain =
        judge(PlainSynthesis(exemplars[0], target, weight, coherent).run(), exemplars, target);
    EXPECT_LT(fast.seams, 0.75 * plain.seams) << coherent;
    EXPECT_LT(fast.altitude, 1.1 * plain.altitude) << coherent;
    EXPECT_LT(fast.max_used, plain.max_used) << coherent;
  }
}

// Colours are compared by squared differences in any given layer: another layer gives another
// distance. In grey, two hues of the same lightness are the same paint.
TEST(Synthesize, AnotherLayerIsAnotherDistance) {
  Exemplar colours = painting(64, 56, 1);
  for (std::size_t i = 0; i < colours.picture.size(); ++i) {
    Rgb8& c = colours.picture[i];
    const auto grey = static_cast<std::uint8_t>(c[1] / 2 + 60);
    c = random_index(2, 9, static_cast<int>(i), 0) == 0
            ? Rgb8{static_cast<std::uint8_t>(grey + 60), grey, static_cast<std::uint8_t>(grey - 60)}
            : Rgb8{static_cast<std::uint8_t>(grey - 60), grey,
                   static_cast<std::uint8_t>(grey + 60)};
  }
  Exemplar greys = colours;
  for (Rgb8& c : greys.picture) c = {c[1], c[1], c[1]};
  const GuideStack target = land(40, 40, 40);
  const MatchField by_grey = run({greys}, target);
  const double by_colour_seams = judge(run({colours}, target), {greys}, target).seams;
  EXPECT_LT(judge(by_grey, {greys}, target).seams, 0.93 * by_colour_seams);
}

}  // namespace
}  // namespace belvedere
