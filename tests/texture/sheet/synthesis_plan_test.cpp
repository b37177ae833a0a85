#include "texture/sheet/synthesis_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "tests/files.h"
#include "tests/notes.h"
#include "tests/texture/sheet/sheet_samples.h"

namespace belvedere {
namespace {

using namespace sheet_samples;

TEST(SynthesisPlan, OfLevel0IsTheWholeSynthesis) {
  const std::vector<Exemplar> exemplars{painting(100, 90, 1, 2), painting(60, 80, 5, 2)};
  GuideStack target = land(131, 97, 40, 2);
  target.depth_m = Grid<float>(131, 97, 5000.0F);
  for (int y = 30; y < 60; ++y)
    for (int x = 20; x < 90; ++x) target.depth_m(x, y) = 2000.0F;
  SynthesisPlan plan = plan_of(exemplars, target, {131, 97, 0, 64});
  EXPECT_EQ(all_tiles(plan, target), synthesize(exemplars, target, {}, silent_progress()));
}

TEST(SynthesisPlan, RefusesViewsAndSheetsThatDoNotFit) {
  const std::vector<Exemplar> exemplars{painting(60, 60, 1)};
  const GuideStack view = land(50, 40, 3);
  EXPECT_NO_THROW(plan_synthesis(exemplars, view, {99, 80, 1, 64}, {}, silent_progress()));
  for (const SynthesisSheet& sheet : {SynthesisSheet{101, 80, 1, 64}, SynthesisSheet{99, 78, 1, 64},
                                      SynthesisSheet{99, 80, 1, 24}, SynthesisSheet{50, 40, -1, 64},
                                      SynthesisSheet{6400, 5120, 7, 1024}}) {
    EXPECT_THROW(plan_synthesis(exemplars, view, sheet, {}, silent_progress()), Error)
        << sheet.width << " " << sheet.level;
  }
}

TEST(SynthesisPlan, TellsWhatIsMissingInPixelsOfTheSheet) {
  const std::vector<Exemplar> exemplars{painting(60, 60, 1)};
  GuideStack view = land(50, 40, 3);
  std::fill(view.label.begin(), view.label.begin() + 10, std::uint8_t{200});
  test::Notes notes;
  plan_synthesis(exemplars, view, {100, 80, 1, 64}, {}, notes);
  ASSERT_EQ(notes.all.size(), 1U);
  EXPECT_NE(notes.all[0].find("40 pixels"), std::string::npos) << notes.all[0];
}

TEST(PackedPlan, GivesTheSameTiles) {
  const std::vector<Exemplar> exemplars{painting(150, 120, 1, 4), painting(60, 90, 9, 4)};
  const GuideStack target = land(300, 200, 40, 4);
  SynthesisParameters parameters;
  parameters.seed = 7;
  parameters.reuse = 0.5;
  parameters.copy_cap = 100;
  parameters.neighbourhood = 9;
  parameters.distance = "normalized";
  parameters.surroundings_of = "all";
  parameters.surroundings = 2;
  parameters.class_dissimilarity = {{{3, 7}, 0.25}};
  parameters.fallback = {{200, 9}};
  parameters.weights = {{"guide 1", 2.0}, {"guide 2", 0.5}};
  SynthesisPlan plan = plan_of(exemplars, target, {300, 200, 2, 128}, parameters);
  const std::vector<std::uint8_t> bytes = pack_plan(plan);
  SynthesisPlan read = unpack_plan(bytes, exemplars);
  EXPECT_EQ(pack_plan(read), bytes);
  // A label that is in this window, but not in the small view.
  GuideStack finer = target;
  finer.label(131, 131) = 200;
  EXPECT_EQ(all_tiles(read, finer), all_tiles(plan, finer));
  EXPECT_NE(tile_of(read, finer, plan.sheet().tile(1, 1))(131 - 128, 131 - 128).exemplar,
            Match::none);
}

TEST(PackedPlan, RefusesDamagedBytesAndOtherExemplars) {
  const std::vector<Exemplar> exemplars{painting(60, 60, 1)};
  const GuideStack target = land(130, 128, 40);
  const SynthesisPlan plan = plan_of(exemplars, target, {130, 128, 1, 64});
  const std::vector<std::uint8_t> bytes = pack_plan(plan);
  EXPECT_NO_THROW(unpack_plan(bytes, exemplars));
  for (std::size_t at = 0; at < bytes.size(); at += 1 + bytes.size() / 97) {
    std::vector<std::uint8_t> damaged = bytes;
    damaged[at] ^= 16;
    EXPECT_THROW(unpack_plan(damaged, exemplars), Error) << at;
    damaged.resize(at);
    EXPECT_THROW(unpack_plan(damaged, exemplars), Error) << at;
  }
  std::vector<Exemplar> others = exemplars;
  others[0].picture(3, 3)[1] ^= 1;
  EXPECT_THROW(unpack_plan(bytes, others), Error);
  others = exemplars;
  others[0].guides.guides[0].values(3, 3) ^= 1;
  EXPECT_THROW(unpack_plan(bytes, others), Error);
  EXPECT_THROW(unpack_plan(bytes, {}), Error);
}

// Sums of weights would overflow.
TEST(PackedPlan, RefusesWeightsThatNoSceneCanAskFor) {
  const std::vector<Exemplar> exemplars{painting(60, 60, 1)};
  std::vector<std::uint8_t> bytes =
      pack_plan(plan_of(exemplars, land(130, 128, 40), {130, 128, 1, 64}));
  // After the guide's name: 16 times the price of a squared difference.
  const std::string name = exemplars[0].guides.guides[0].name;
  const auto weight = std::search(bytes.begin(), bytes.end(), name.begin(), name.end()) +
                      static_cast<std::ptrdiff_t>(name.size());
  ASSERT_EQ(weight[0] | weight[1] << 8, 16 * 270);
  weight[7] = 0x70;
  const std::size_t content = bytes.size() - 8;
  std::uint64_t sum = content;
  for (std::size_t i = 0; i < content; ++i) sum = mix_bits(sum ^ bytes[i]);
  for (std::size_t i = 0; i < 8; ++i)
    bytes[content + i] = static_cast<std::uint8_t>(sum >> (8 * i));
  EXPECT_THAT(test::error_of([&] { unpack_plan(bytes, exemplars); }).found(),
              testing::HasSubstr("a weight out of range"));
}

}  // namespace
}  // namespace belvedere
