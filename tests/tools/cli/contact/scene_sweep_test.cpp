#include "tools/cli/contact/scene_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/pixel_rect.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(SceneSweep, CommasSeparateValuesOutsideOfBracketsAndQuotes) {
  const SceneSweep sweep = split_sweep({"output.width=600", "generalize.foreground=[1,1],[1.5,0.5]",
                                        "title='a, b'", "palette=\"summer\",'winter'"});
  EXPECT_THAT(sweep.settings, ElementsAre("output.width=600", "title='a, b'"));
  ASSERT_EQ(sweep.axes.size(), 2U);
  EXPECT_EQ(sweep.axes[0].key, "generalize.foreground");
  EXPECT_THAT(sweep.axes[0].values, ElementsAre("[1,1]", "[1.5,0.5]"));
  EXPECT_THAT(sweep.axes[1].values, ElementsAre("\"summer\"", "'winter'"));
  EXPECT_THAT(split_sweep({"a={ x = 1, y = 2 },{ x = 2 }"}).axes[0].values,
              ElementsAre("{ x = 1, y = 2 }", "{ x = 2 }"));
}

TEST(SceneSweep, WhatIsNoSweepIsRefused) {
  const auto refusal = [](const std::vector<std::string>& settings) {
    return test::usage_error([&] { split_sweep(settings); });
  };
  EXPECT_THAT(refusal({}), HasSubstr("several values"));
  EXPECT_THAT(refusal({"a=1", "b=[1,2]"}), HasSubstr("several values"));
  EXPECT_THAT(refusal({"a=1,2", "b=1,2", "c=1,2"}), HasSubstr("one or two"));
  EXPECT_THAT(refusal({"a=1,2,1"}), HasSubstr("1 twice"));
  EXPECT_THAT(refusal({"a=1,"}), HasSubstr("empty"));
}

TEST(PictureTable, HoldsEveryPictureInItsColumnAndRow) {
  const auto plain = [](int width, int height, float v) {
    return Grid<glm::vec3>(width, height, glm::vec3(v, 0.F, 1.F));
  };
  PictureTable table;
  table.columns = {"a", "b"};
  table.rows = {"one", "two"};
  table.cells = {{{plain(120, 40, 0.1F), ""}, {plain(100, 60, 0.2F), "words"}},
                 {{plain(100, 50, 0.3F), ""}, {{}, ""}}};
  const Grid<glm::vec3> sheet = draw_table(table);
  // Where each picture lies: its pixels form a rectangle of its size.
  const auto found = [&](float v) {
    PixelRect box{sheet.width(), sheet.height(), 0, 0};
    int count = 0;
    for (const auto [x, y] : test::cells(sheet))
      if (sheet(x, y) == glm::vec3(v, 0.F, 1.F)) {
        box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1),
               std::max(box.y1, y + 1)};
        ++count;
      }
    EXPECT_EQ(count, box.width() * box.height()) << v;
    return box;
  };
  const PixelRect a = found(0.1F);
  const PixelRect b = found(0.2F);
  const PixelRect c = found(0.3F);
  EXPECT_EQ(a.width(), 120);
  EXPECT_EQ(b.height(), 60);
  EXPECT_EQ(c.height(), 50);
  EXPECT_EQ(a.y0, b.y0);
  EXPECT_EQ(a.x0, c.x0);
  EXPECT_GE(b.x0, a.x1);
  EXPECT_GE(c.y0, b.y1 + 16);  // words stand between
  EXPECT_GE(a.x0, 30);         // names of rows at the left
}

// Columns are as wide as their pictures, where the words of a caption let them.
TEST(PictureTable, CaptionsBreakAtThePicturesWidth) {
  const auto sheet_of = [](const std::string& caption) {
    PictureTable table;
    table.columns = {"", ""};
    table.cells = {{{Grid<glm::vec3>(100, 20, glm::vec3(0.5F)), caption},
                    {Grid<glm::vec3>(100, 20, glm::vec3(0.5F)), caption}}};
    return draw_table(table);
  };
  const Grid<glm::vec3> words = sheet_of("one two three four five");
  EXPECT_EQ(words.width(), sheet_of("").width());
  EXPECT_EQ(words.width(), sheet_of("one").width());
  // Nothing is lost: the total ink equals that of the captions alone.
  const auto ink = [](const Grid<glm::vec3>& sheet) {
    return std::count(sheet.begin(), sheet.end(), glm::vec3(0.1F));
  };
  std::ptrdiff_t each = 0;
  for (const char* word : {"one", "two", "three", "four", "five"}) each += ink(sheet_of(word));
  EXPECT_EQ(ink(words), each);
  EXPECT_GT(words.height(), sheet_of("one").height());
  EXPECT_GT(sheet_of("unbreakable-word").width(), words.width())
      << "a long word has the room it needs";
}

}  // namespace
}  // namespace belvedere::tools
