#include "renderer/scene/former_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/scene/scene_file.h"

namespace belvedere {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(FormerKeys, AreReadAsThePresentOnesWithANote) {
  const LoadedScene scene = parse_scene(
      "version = 1\n[terrain]\nmost_mcells = 3\n[labels]\nleast_prominence_m = 200\n"
      "[[air.mist]]\nkind = \"valley\"\nsight_m = 300\n[[air.mist]]\nkind = \"valley\"\nsight_m = "
      "400\n",
      "scene.toml", ".", {});
  EXPECT_EQ(scene.scene.terrain.max_mcells, 3.0);
  EXPECT_EQ(scene.scene.labels.min_prominence_m, 200.0);
  EXPECT_EQ(scene.scene.air.mist.at(1).visibility_m, 400.0);
  EXPECT_THAT(
      scene.notes,
      ElementsAre(HasSubstr("terrain.most_mcells is now called terrain.max_mcells"),
                  HasSubstr("air.mist.visibility_m"), HasSubstr("labels.min_prominence_m")));
}

TEST(FormerKeys, AreReadInSettings) {
  const LoadedScene scene = parse_scene(
      "version = 1\n[[air.mist]]\nkind = \"valley\"\n", "scene.toml", ".",
      {.data_folders = {}, .settings = {"air.mist.0.sight_m=350", "synthesis.knit=true"}});
  EXPECT_EQ(scene.scene.air.mist.at(0).visibility_m, 350.0);
  EXPECT_TRUE(scene.scene.synthesis.synthesize_seams);
  EXPECT_THAT(scene.notes, ElementsAre(HasSubstr("air.mist.visibility_m"),
                                       HasSubstr("synthesis.synthesize_seams")));
}

TEST(FormerKeys, PresentNamesGiveNoNoteAndBothNamesAreRefused) {
  EXPECT_THAT(parse_scene("version = 1\n[terrain]\nmax_mcells = 3\n", "scene.toml", ".", {}).notes,
              IsEmpty());
  EXPECT_THROW(parse_scene("version = 1\n[terrain]\nmax_mcells = 3\nmost_mcells = 3\n",
                           "scene.toml", ".", {}),
               Error);
}

}  // namespace
}  // namespace belvedere
