#include "base/land_cover_class.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using testing::HasSubstr;

TEST(LandCoverClass, NamesNumbersAndMapColoursTellClassesApart) {
  std::set<std::string_view> names;
  std::set<std::uint32_t> colours;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_TRUE(colours.insert(info.rgb).second) << info.name;
    EXPECT_EQ(find_class(info.name), info.id);
    EXPECT_EQ(class_name(info.id), info.name);
    EXPECT_EQ(&class_info(info.id), &info);
  }
  // Written to files: these never change.
  EXPECT_EQ(class_name(static_cast<LandCoverClass>(7)), "rock");
  EXPECT_EQ(class_name(static_cast<LandCoverClass>(11)), "shrub");
  EXPECT_EQ(class_name(static_cast<LandCoverClass>(land_cover_class_count)), "unknown");
  EXPECT_EQ(find_class("Rock"), std::nullopt);
}

// A class with a forgotten number in its row would be painted in one grey, or not at all.
TEST(LandCoverClass, TraitsOfEveryClassOfGroundAreInRange) {
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    if (info.id == sky) continue;
    EXPECT_FALSE(info.meaning.empty()) << info.name;
    EXPECT_GE(info.tone.contrast, 0.5F) << info.name;
    EXPECT_LE(info.tone.contrast, 1.5F) << info.name;
    EXPECT_GT(info.tone.detail, 0.0F) << info.name;
    EXPECT_LT(info.tone.detail, 1.0F) << info.name;
    EXPECT_GT(info.tone.edges, 0.0F) << info.name;
    EXPECT_GT(info.hue.warmth, 0.0F) << info.name;
    EXPECT_LE(info.hue.warmth, 1.0F) << info.name;
    EXPECT_GT(info.hue.relief_accent, 0.0F) << info.name;
  }
}

TEST(LandCoverClass, TraitsAreReadOneByOne) {
  EXPECT_TRUE(has_trait(rock, ClassTrait::tight));
  EXPECT_TRUE(has_trait(rock, ClassTrait::own_relief));
  EXPECT_FALSE(has_trait(rock, ClassTrait::icy));
  EXPECT_FALSE(has_trait(sky, ClassTrait::accents));
  EXPECT_TRUE(has_trait(glacier, ClassTrait::icy));
}

TEST(LandCoverClass, WhatASceneSaysGoesBeforeStandIns) {
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    EXPECT_EQ(class_info(info.stand_in).stand_in, info.stand_in)
        << info.name << ": a stand-in has none of its own";
    EXPECT_TRUE(info.id == sky || info.stand_in != sky)
        << info.name << ": sky is painted, not copied";
    const LandCoverClass other = info.id == water ? rock : water;
    const ClassPairs said = with_stand_ins({{info.id, other}});
    EXPECT_EQ(said.front(), std::pair(info.id, other));
    for (std::size_t k = 1; k < said.size(); ++k) EXPECT_NE(said[k].first, info.id) << "said once";
  }
}

// Paintings older than sand have none.
TEST(LandCoverClass, SandIsCopiedFromScreeWhereNothingIsSaid) {
  EXPECT_EQ(with_stand_ins({}), (ClassPairs{{sand, scree}}));
  EXPECT_EQ(with_stand_ins({{sand, rock}}), (ClassPairs{{sand, rock}}));
}

// docs/legends.md has a row for each class with this text.
TEST(LandCoverClass, TheLegendsPageNamesEveryClass) {
  const std::string page = test::read_bytes(test::source_folder() + "/docs/legends.md");
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    if (info.id == sky) continue;
    EXPECT_THAT(page, HasSubstr("| `" + std::string(info.name) + "` | " +
                                std::string(info.meaning) + " |\n"));
  }
}

}  // namespace
}  // namespace belvedere
