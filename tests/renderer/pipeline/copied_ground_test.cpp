#include "renderer/pipeline/copied_ground.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "tests/renderer/exemplar/painted_hills.h"
#include "tests/renderer/world/small_world.h"

namespace belvedere {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr int side = 24;
const glm::vec3 base_colour(0.5F, 0.5F, 0.5F);
const glm::vec3 red(0.75F, 0.125F, 0.125F);

// Rock all over, in one colour.
LitPicture rock() {
  LitPicture lit;
  lit.guidance = test::make_slope(side, side, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  lit.base.colour = Grid<glm::vec3>(side, side, base_colour);
  return lit;
}

// Every stroke on its own pixel: no class reaches over another.
PaintDraft own_paint(const LitPicture& lit) {
  PaintDraft draft;
  draft.painting.picture = lit.base.colour;
  draft.painting.sources = draft.painting.strokes = Grid<std::uint32_t>(side, side);
  std::iota(draft.painting.sources.begin(), draft.painting.sources.end(), 0U);
  draft.painting.under = draft.painting.sources;
  draft.painting.under_share = Grid<std::uint8_t>(side, side, 0);
  draft.classes = {lit.guidance.land_cover, lit.base.colour};
  return draft;
}

// A painting in red of `id` alone.
PaintedExemplar painted(LandCoverClass id, int width = 40) {
  PaintedExemplar painted;
  painted.exemplar.name = "red";
  painted.exemplar.picture = Grid<Rgb8>(width, width, Rgb8{191, 32, 32});
  painted.exemplar.guides.label = Grid<std::uint8_t>(width, width, static_cast<std::uint8_t>(id));
  painted.picture = Grid<glm::vec3>(width, width, red);
  return painted;
}

struct Notes : Progress {
  void note(std::string_view text) override { all += text; }
  std::string all;
};

TEST(CopiedGround, EveryPixelTakesATexelOfItsClass) {
  const LitPicture lit = rock();
  const PaintDraft draft = own_paint(lit);
  const Scene scene = test::small_scene().scene;
  const std::vector<PaintedExemplar> exemplars = {painted(LandCoverClass::forest), painted(LandCoverClass::rock)};
  const MatchField matches = match_exemplars(exemplars, scene, lit, draft, silent_progress());
  for (const Match& match : matches) ASSERT_EQ(match.exemplar, 1);
  // An exemplar without a base picture gives its texels as they are.
  const Grid<glm::vec3> ground = copy_ground(matches, exemplars, scene, lit, draft);
  for (const glm::vec3& pixel : ground) ASSERT_EQ(pixel, red);
}

TEST(CopiedGround, AFallbackOfTheSceneStandsInForAClass) {
  const LitPicture lit = rock();
  const PaintDraft draft = own_paint(lit);
  const std::vector<PaintedExemplar> exemplars = {painted(LandCoverClass::water)};
  const auto exemplar_of = [&](const std::vector<std::string>& settings) {
    return match_exemplars(exemplars, test::small_scene(settings).scene, lit, draft, silent_progress())(5, 5).exemplar;
  };
  EXPECT_EQ(exemplar_of({}), Match::none);
  EXPECT_EQ(exemplar_of({"synthesis.fallback={ rock = \"water\" }"}), 0);
}

TEST(CopiedGround, PixelsWithoutATexelKeepTheirBase) {
  const LitPicture lit = rock();
  const Grid<glm::vec3> ground = copy_ground(MatchField(side, side), {}, test::small_scene().scene, lit, own_paint(lit));
  for (const glm::vec3& pixel : ground) ASSERT_EQ(pixel, base_colour);
}

// texel + residual · (base of the target - base of the exemplar), as far as the scene says.
TEST(CopiedGround, TheScenesShareOfTheBasePicturesDifferenceIsLaidOver) {
  const LitPicture lit = rock();
  const PaintDraft draft = own_paint(lit);
  std::vector<PaintedExemplar> exemplars = {painted(LandCoverClass::rock)};
  exemplars[0].base = Grid<glm::vec3>(40, 40, glm::vec3(0.25F));
  const auto pixel = [&](const char* residual) {
    const Scene scene = test::small_scene({std::string("synthesis.residual=") + residual}).scene;
    return copy_ground(match_exemplars(exemplars, scene, lit, draft, silent_progress()), exemplars, scene, lit, draft)(7, 7);
  };
  EXPECT_EQ(pixel("0"), red);
  EXPECT_EQ(pixel("1"), red + glm::vec3(0.25F));
  EXPECT_EQ(pixel("0.5"), red + glm::vec3(0.125F));
}

TEST(CopiedGround, AClassOfFewTexelsIsNoted) {
  const LitPicture lit = rock();
  const PaintDraft draft = own_paint(lit);
  Notes few;
  match_exemplars({painted(LandCoverClass::rock, 6)}, test::small_scene().scene, lit, draft, few);
  EXPECT_THAT(few.all, HasSubstr("rock"));
  Notes many;
  match_exemplars({painted(LandCoverClass::rock, 200)}, test::small_scene().scene, lit, draft, many);
  EXPECT_THAT(many.all, Not(HasSubstr("rock")));
}

TEST(PaintDraft, SaysWhosePaintLiesOnEveryPixel) {
  const LoadedScene loaded = test::small_scene();
  const World world(loaded, silent_progress());
  const Palette palette = read_palette("summer");
  const LitPicture lit = make_lit_picture(world, palette, {0, 0, 96, 80}, {});
  const PaintDraft draft = draft_paint(world, palette, lit, silent_progress());
  int reached_over = 0;
  for (std::size_t i = 0; i < draft.painting.sources.size(); ++i) {
    const std::uint32_t from = draft.painting.sources[i];
    ASSERT_EQ(draft.classes.land_cover[i], lit.guidance.land_cover[from]);
    reached_over += draft.classes.land_cover[i] != lit.guidance.land_cover[i] ? 1 : 0;
    if (lit.guidance.is_sky(i)) {
      ASSERT_EQ(draft.painting.picture[i], lit.base.colour[i]) << "the sky is not copied, so not drafted";
    }
  }
  EXPECT_GT(reached_over, 0);
}

}  // namespace
}  // namespace belvedere
