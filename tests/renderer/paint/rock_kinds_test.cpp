#include "renderer/paint/rock_kinds.h"

#include <gtest/gtest.h>

#include <set>
#include <string_view>

#include "base/error.h"
#include "base/random.h"
#include "renderer/scene/scene_table.h"

namespace belvedere {
namespace {

TEST(RockKinds, HaveNamesOfTheirOwnAndHuesThatFillTheWhole) {
  std::set<std::string_view> names;
  for (const RockKind& kind : rock_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_EQ(&find_rock_kind(kind.name), &kind);
    float before = 0.0F;
    for (const RockHue& hue : kind.hues) {
      EXPECT_GT(hue.up_to, before) << kind.name;
      before = hue.up_to;
    }
    EXPECT_EQ(before, 1.0F) << kind.name;
  }
  EXPECT_THROW(find_rock_kind("cheese"), Error);
}

// A scene can request all of them, and no other.
TEST(RockKinds, AreTheChoicesOfAScene) {
  std::set<std::string_view> names;
  for (const RockKind& kind : rock_kinds()) names.insert(kind.name);
  for (const SceneSection& section : scene_sections())
    if (section.name == "land_cover")
      for (const SceneKey& key : section.keys)
        if (key.name == "rock") {
          for (const auto& choice : key.choices) EXPECT_EQ(names.erase(choice), 1U) << choice;
        }
  EXPECT_TRUE(names.empty());
}

TEST(RockKinds, PlanesOfOneSpurHangTogetherInColour) {
  const RockKind& kind = find_rock_kind("limestone");
  double within = 0.0;
  double between = 0.0;
  constexpr std::uint32_t spurs = 400;
  for (std::uint32_t spur = 1; spur <= spurs; ++spur) {
    const std::uint32_t plane = 2U * spur;
    const glm::vec3 a = rock_hue(kind, spur << 16U | plane, 0.0F);
    const glm::vec3 same = rock_hue(kind, spur << 16U | (plane + 1U), 0.0F);
    const glm::vec3 other = rock_hue(kind, (spur + spurs) << 16U | (plane + 1U), 0.0F);
    within += (a - same).b * (a - same).b;
    between += (a - other).b * (a - other).b;
  }
  EXPECT_LT(within, 0.9 * between);
  EXPECT_GT(between, 0.0);
}

TEST(RockKinds, ShadeIsBlueAgainstViolet) {
  const RockKind& kind = find_rock_kind("granite");
  double lit = 0.0;
  double shaded = 0.0;
  for (std::uint32_t facet = 1; facet < 400; ++facet) {
    const auto id = static_cast<std::uint32_t>(mix_bits(facet));
    const glm::vec3 a = rock_hue(kind, id, 0.0F);
    const glm::vec3 b = rock_hue(kind, id, 1.0F);
    lit += std::abs(a.r / a.b - 1.0F);
    shaded += std::abs(b.r / b.b - a.r / a.b);
  }
  EXPECT_GT(shaded, 0.3 * lit);
}

}  // namespace
}  // namespace belvedere
