// synthesize --sweep, as users meet it.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/vec2.hpp>

#include "base/random.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class SynthesisSweep : public Program {
 protected:
  void SetUp() override {
    style_ = write_picture("style.png", 90, 70, [](int x, int y) {
      const auto grey = static_cast<float>(random_index(120, 4, x / 3, y)) / 255.F;
      return x < 45 ? glm::vec3(0.4F + grey, grey, grey) : glm::vec3(grey, 0.4F + grey, grey);
    });
    label_ = write_labels("style_class.tif", 90, 70, [](int x, int) { return x < 45 ? 1 : 2; });
    target_ = write_labels("target_class.tif", 64, 48, [](int x, int) { return x < 40 ? 2 : 1; });
    style_altitude_ = write_labels("style_altitude.tif", 90, 70, [](int, int y) { return 3 * y; });
    target_altitude_ =
        write_labels("target_altitude.tif", 64, 48, [](int x, int y) { return 2 * x + y; });
  }
  Outcome sweep(const std::string& out, const std::vector<std::string>& more,
                const std::string& weight = "1") const {
    std::vector<std::string> arguments = {
        "synthesize", "--picture",     style_,           "--label", label_,  target_,   "--guide",
        "altitude",   style_altitude_, target_altitude_, weight,    "--out", path(out), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  // Position of one picture in another, or none (-1).
  static glm::ivec2 find(const Grid<glm::vec3>& sheet, const Grid<glm::vec3>& picture) {
    for (int y0 = 0; y0 + picture.height() <= sheet.height(); ++y0)
      for (int x0 = 0; x0 + picture.width() <= sheet.width(); ++x0) {
        bool same = true;
        for (int y = 0; same && y < picture.height(); ++y)
          same =
              std::equal(picture.row(y), picture.row(y) + picture.width(), sheet.row(y0 + y) + x0);
        if (same) return {x0, y0};
      }
    return {-1, -1};
  }
  std::string style_, label_, target_, style_altitude_, target_altitude_;
};

TEST_F(SynthesisSweep, EachResultIsWhatItsValuesGiveAlone) {
  ASSERT_THAT(sweep("sweep", {"--sweep", "altitude=0,4", "--sweep", "seed=3,5,8", "--json"}),
              Prints(HasSubstr("\"syntheses\": 6")));
  ASSERT_EQ(sweep("alone.png", {"--seed", "8"}, "4").status, 0);
  const Grid<glm::vec3> alone = read_picture(path("alone.png"));
  EXPECT_EQ(read_picture(path("sweep/2_3.png")), alone);
  const Grid<glm::vec3> sheet = read_picture(path("sweep/sheet.png"));
  glm::ivec2 before(0);
  for (const char* file : {"1_1", "2_1", "1_2", "2_2", "1_3", "2_3"}) {
    const Grid<glm::vec3> cell = read_picture(path(fmt::format("sweep/{}.png", file)));
    EXPECT_EQ(cell == alone, file == std::string("2_3"));
    const glm::ivec2 at = find(sheet, cell);
    ASSERT_GE(at.x, 0) << file;
    EXPECT_TRUE(at.y > before.y || (at.y == before.y && at.x > before.x))
        << "columns are the first, rows the second";
    before = at;
    // Its figures stand below.
    int ink = 0;
    for (int y = at.y + 48; y < std::min(at.y + 70, sheet.height()); ++y)
      for (int x = at.x; x < at.x + 64; ++x) ink += sheet(x, y).x < 0.5F ? 1 : 0;
    EXPECT_GT(ink, 50);
  }
  const std::string page = read_bytes(path("sweep/index.html"));
  EXPECT_THAT(page,
              AllOf(HasSubstr("sheet.png"), HasSubstr("--sweep altitude=0,4 --sweep seed=3,5,8"),
                    HasSubstr("\"href\": \"2_3.png\""), HasSubstr("Sweep of altitude and seed"),
                    Not(HasSubstr(path("")))));
  const std::string json = read_bytes(path("sweep/report.json"));
  EXPECT_THAT(json, AllOf(HasSubstr("\"seed\": \"8\""), HasSubstr("\"guide_error_mean\""),
                          HasSubstr("\"clique_floor\"")));
}

TEST_F(SynthesisSweep, ValuesAreWrittenIntoTheSheet) {
  ASSERT_EQ(sweep("a", {"--sweep", "reuse=1"}).status, 0);
  ASSERT_EQ(sweep("b", {"--sweep", "reuse=1.0"}).status, 0);
  const Grid<glm::vec3> a = read_picture(path("a/sheet.png"));
  const Grid<glm::vec3> b = read_picture(path("b/sheet.png"));
  const glm::ivec2 at = find(a, read_picture(path("a/1_1.png")));
  // The same result; only the words above differ, from where ".0" begins.
  bool differ = false;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < std::min(a.width(), b.width()); ++x) {
      if (a(x, y) == b(x, y)) continue;
      differ = true;
      EXPECT_LT(y, at.y);
      EXPECT_GE(x, at.x + 50);  // both begin with "reuse 1"
    }
  EXPECT_TRUE(differ);
}

TEST_F(SynthesisSweep, LargePicturesAreShownAtFullSizeWhereMostBordersLie) {
  target_ = write_labels("target_class.tif", 700, 20,
                         [](int x, int) { return x >= 500 && x % 2 == 0 ? 2 : 1; });
  target_altitude_ =
      write_labels("target_altitude.tif", 700, 20, [](int x, int) { return x % 200; });
  ASSERT_EQ(sweep("sweep", {"--sweep", "surroundings=0"}).status, 0);
  const Grid<glm::vec3> whole = read_picture(path("sweep/1_1.png"));
  EXPECT_EQ(whole.width(), 700);
  Grid<glm::vec3> view(512, 20);
  for (int y = 0; y < 20; ++y) std::copy_n(whole.row(y) + 188, 512, view.row(y));
  EXPECT_GE(find(read_picture(path("sweep/sheet.png")), view).x, 0);
  EXPECT_THAT(read_bytes(path("sweep/index.html")),
              HasSubstr("The same 512 × 20 pixels of each, from 188, 0"));
}

TEST_F(SynthesisSweep, HasTheSameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2"})
    ASSERT_EQ(sweep(threads, {"--sweep", "levels=1,3", "--threads", threads}).status, 0);
  for (const auto& entry : fs::directory_iterator(path("1"))) {
    const std::string name = entry.path().filename().string();
    if (name == "index.html" || name == "report.json" || name == ".belvedere_results")
      continue;  // they say what the folder is called
    EXPECT_EQ(read_bytes(entry.path().string()), read_bytes(path("2/" + name))) << name;
  }
}

TEST_F(SynthesisSweep, TriesSizesOfTheNeighbourhood) {
  ASSERT_THAT(sweep("sizes", {"--sweep", "neighbourhood=3,7,11"}), Ends(0));
  ASSERT_EQ(sweep("small.png", {"--neighbourhood", "3"}).status, 0);
  ASSERT_EQ(sweep("usual.png", {}).status, 0);
  EXPECT_EQ(read_picture(path("sizes/1_1.png")), read_picture(path("small.png")));
  EXPECT_EQ(read_picture(path("sizes/2_1.png")), read_picture(path("usual.png")));
  EXPECT_FALSE(read_picture(path("sizes/1_1.png")) == read_picture(path("sizes/3_1.png")));
  EXPECT_EQ(sweep("even.png", {"--neighbourhood", "4"}).status, 2);
}

TEST_F(SynthesisSweep, RefusesWhatCannotBeMeant) {
  const auto refused = [&](const std::vector<std::string>& sweeps, const std::string& words,
                           const std::string& out = "sweep") {
    std::vector<std::string> arguments;
    for (const std::string& s : sweeps) arguments.insert(arguments.end(), {"--sweep", s});
    EXPECT_THAT(sweep(out, arguments), Ends(2, HasSubstr(words)));
    EXPECT_FALSE(fs::exists(path("sweep/sheet.png")));
  };
  refused({"tone=1,2"},
          "\"tone\" cannot be swept\n  allowed: seed, levels, reuse, copy-cap, neighbourhood, "
          "surroundings, altitude (weight)");
  refused({"neighbourhood=3,4"}, "odd numbers 3 … 11");
  refused({"neighbourhood=13"}, "odd numbers 3 … 11");
  refused({"reuse"}, "NAME=VALUE");
  refused({"reuse="}, "a value \"\"");
  refused({"reuse=1,,2"}, "a value \"\"");
  refused({"reuse=much"}, "a value \"much\"");
  refused({"reuse=nan"}, "a value \"nan\"");
  refused({"reuse=11"}, "0 … 10");
  refused({"altitude=-1"}, "0 … 100");
  refused({"levels=1.5"}, "whole numbers 1 … 8");
  refused({"seed=1,2,1"}, "the value 1 twice");
  refused({"seed=1", "seed=2"}, "seed twice");
  refused({"seed=1", "reuse=1", "levels=1"}, "once or twice");
  refused({"seed=1,2,3,4,5,6,7,8,9,10,11", "copy-cap=20,21,22,23,24,25,26,27,28,29"},
          "110 syntheses");
  refused({"reuse=1"}, "a folder", "sweep.png");
  EXPECT_EQ(sweep("sweep", {"--sweep", "reuse=1", "--match", path("match.exr")}).status, 2);
}

}  // namespace
}  // namespace belvedere
