// `belvedere composite learn` and `make` as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>

#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/composite/composite_crops.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Composite : public Program {
 protected:
  std::string write_crop(const test::Composite& two) const {
    return write_picture("crop.png", two.picture.width(), two.picture.height(), [&](int x, int y) {
      const Rgb8& c = two.picture(x, y);
      return glm::vec3(c[0], c[1], c[2]) / 255.F;
    });
  }
  // Blue above, yellow below.
  std::string write_drawing(const std::string& name, const Grid<std::uint8_t>& labels,
                            glm::vec3 second = {1.F, 1.F, 0.F}) const {
    return write_picture(name, labels.width(), labels.height(), [&](int x, int y) {
      return labels(x, y) == 0 ? glm::vec3(0.F, 0.F, 1.F) : second;
    });
  }
};

TEST_F(Composite, IsLearntMadeAndDrawn) {
  const test::Composite two = test::two_textures(120, 120);
  const std::string crop = write_crop(two);
  const std::string labels = write_drawing("labels.png", two.labels);
  ASSERT_THAT(
      run({"composite", "learn", crop, "--labels", labels, "--types", "16", "--begin", "white",
           "--out", path("c.composite"), "--report", path("page"), "-q", "--json"}),
      Prints(AllOf(HasSubstr("\"#0000ff\""), HasSubstr("\"#ffff00\""), HasSubstr("\"profile\""))));
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("made.png"), HasSubstr("#ffff00")));

  const auto make = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"composite", "make", path("c.composite"), "--out", path(name), "-q"});
    EXPECT_THAT(run(options), Ends(0));
    return read_picture(path(name));
  };
  const Grid<glm::vec3> one = make("one.png", {"--size", "90x70", "--threads", "1", "--map",
                                               path("map.png"), "--report", path("made")});
  EXPECT_EQ(one.width(), 90);
  EXPECT_EQ(one, make("two.png", {"--size", "90", "70", "--threads", "2"}));
  EXPECT_NE(one, make("other.png", {"--size", "90", "70", "--seed", "4"}));
  // The map that was written is a drawing that gives the same picture.
  EXPECT_EQ(one, make("drawn.png", {"--labels", path("map.png")}));
  // Windows are parts of the window of the whole.
  const Grid<glm::vec3> all =
      make("all.png", {"--labels", path("map.png"), "--window", "0", "0", "90", "70"});
  EXPECT_EQ(all, make("strips.png", {"--labels", path("map.png"), "--strips"}))
      << "a large picture is the same window, strip by strip";
  const Grid<glm::vec3> part =
      make("part.png", {"--labels", path("map.png"), "--window", "20,30,40,25", "--threads", "2",
                        "--report", path("window")});
  ASSERT_EQ(part.width(), 40);
  EXPECT_EQ(read_picture(path("made/made.png")), one);
  EXPECT_EQ(read_picture(path("made/labels.png")), read_picture(path("map.png")));
  EXPECT_THAT(read_bytes(path("made/index.html")),
              AllOf(HasSubstr("#0000ff"), HasSubstr("--size 90x70")));
  EXPECT_EQ(read_picture(path("window/labels.png")).width(), 40) << "the window's part of the map";
  for (const auto [x, y] : test::cells(40, 25)) ASSERT_EQ(part(x, y), all(20 + x, 30 + y));
  const Grid<glm::vec3> map = read_picture(path("map.png"));
  EXPECT_EQ(map(45, 2), glm::vec3(0.F, 0.F, 1.F));
  EXPECT_EQ(map(45, 67), glm::vec3(1.F, 1.F, 0.F));

  const auto refused = [&](std::vector<std::string> arguments, int status,
                           const std::string& word) {
    arguments.insert(arguments.begin(), {"composite", "make"});
    EXPECT_THAT(run(arguments), Ends(status, HasSubstr(word)));
  };
  const std::string red = write_drawing("red.png", two.labels, {1.F, 0.F, 0.F});
  refused({path("c.composite"), "--labels", red, "--out", path("x.png")}, 3, "#ff0000");
  refused({path("c.composite"), "--out", path("x.png")}, 2, "neither --size nor --labels");
  refused({path("c.composite"), "--size", "9", "9", "--labels", red, "--out", path("x.png")}, 2,
          "both");
  refused({path("c.composite"), "--size", "9", "9", "--map", path("m.tif"), "--out", path("x.png")},
          2, ".png");
  refused({path("c.composite"), "--size", "90", "70", "--window", "80", "0", "20", "9", "--out",
           path("x.png")},
          2, "90 × 70");
  refused({path("gone.composite"), "--size", "9", "9", "--out", path("x.png")}, 3,
          "gone.composite");
  refused(
      {write("m.composite", "belvedere_texture = 1\n"), "--size", "9", "9", "--out", path("x.png")},
      2, "not a composite");
}

// Without labels: the segments of the crop, without the small ones. Blue above, a meadow below with
// a red square in it that is too small to learn.
TEST_F(Composite, FindsItsOwnLabels) {
  const Grid<Rgb8> meadow = test::meadow_crop(150, 140);
  const auto border = [](int x) { return 70.0 + 5.0 * gaussian_noise(4, x, 0, 6.0, 1.0); };
  const auto is_red = [](int x, int y) { return x >= 60 && x < 80 && y >= 100 && y < 120; };
  const std::string crop = write_picture("crop.png", 150, 140, [&](int x, int y) {
    const Rgb8& c = meadow(x, y);
    const glm::vec3 green = glm::vec3(c[0], c[1], c[2]) / 255.F;
    if (is_red(x, y)) return glm::vec3(.9F, .1F * green.y, 0.F);
    return y < border(x) ? glm::vec3(.3F * green.x, .5F * green.y, .6F + .3F * green.x) : green;
  });
  ASSERT_THAT(run({"composite", "learn", crop, "--types", "16", "--begin", "white", "--found",
                   path("found.png"), "--out", path("c.composite"), "-q", "--json"}),
              Prints(HasSubstr("\"#008000\"")));
  const Grid<glm::vec3> found = read_picture(path("found.png"));
  // Each label is of one half, and the square belongs to what surrounds it.
  std::map<std::array<float, 3>, std::array<int, 2>> pixels;
  for (const auto [x, y] : test::cells(150, 140)) {
    const glm::vec3& c = found(x, y);
    ++pixels[{c.x, c.y, c.z}][y < border(x) ? 0 : 1];
  }
  EXPECT_GE(pixels.size(), 2U);
  EXPECT_LE(pixels.size(), 6U);
  int strangers = 0;
  for (const auto& [colour, halves] : pixels) {
    EXPECT_GT(halves[0] + halves[1], 48 * 48);
    strangers += std::min(halves[0], halves[1]);
  }
  EXPECT_LT(strangers, 150 * 140 / 25);
  // The labels found are a drawing like any other.
  ASSERT_EQ(run({"composite", "make", path("c.composite"), "--labels", path("found.png"), "--out",
                 path("drawn.png"), "-q"})
                .status,
            0);
  ASSERT_EQ(run({"composite", "make", path("c.composite"), "--size", "100", "90", "--out",
                 path("made.png"), "-q"})
                .status,
            0);
  const Grid<glm::vec3> made = read_picture(path("made.png"));
  glm::vec3 above(0.F), below(0.F);
  for (const auto [x, y] : test::cells(100, 20)) {
    above += made(x, y) / 2000.F;
    below += made(x, 70 + y) / 2000.F;
  }
  EXPECT_GT(above.z, above.y + .2F) << "blue";
  EXPECT_GT(below.y, below.z + .1F) << "green";
  EXPECT_EQ(run({"composite", "learn", crop, "--labels", path("found.png"), "--found",
                 path("x.png"), "--out", path("x.composite")})
                .status,
            2);
}

TEST_F(Composite, NumbersAreLabelsToo) {
  const test::Composite two = test::two_textures(120, 120);
  const std::string crop = write_crop(two);
  const std::string labels = write_labels("labels.tif", 120, 120, [&](int x, int y) {
    return x < 4 ? 255 : two.labels(x, y) == 0 ? 3 : 40;
  });
  ASSERT_EQ(run({"composite", "learn", crop, "--labels", labels, "--types", "16", "--begin",
                 "discs", "--out", path("c.composite"), "-q"})
                .status,
            0);
  EXPECT_THAT(read_bytes(path("c.composite")),
              AllOf(HasSubstr("name = \"3\""), HasSubstr("name = \"40\""),
                    HasSubstr("seed = \"discs\""), HasSubstr("seed_px = 8")));
  ASSERT_EQ(run({"composite", "make", path("c.composite"), "--size", "60", "60", "--map",
                 path("map.png"), "--out", path("one.png"), "-q"})
                .status,
            0);
  ASSERT_EQ(run({"composite", "make", path("c.composite"), "--labels", path("map.png"), "--out",
                 path("two.png"), "-q"})
                .status,
            0);
  EXPECT_EQ(read_picture(path("one.png")), read_picture(path("two.png")));
}

TEST_F(Composite, BadLabelsAreNamed) {
  const std::string crop = write_crop(test::two_textures(120, 120));
  const auto refused = [&](const std::string& labels, const std::string& word) {
    EXPECT_THAT(run({"composite", "learn", crop, "--labels", labels, "--out", path("c.composite")}),
                Ends(3, HasSubstr(word)));
    EXPECT_FALSE(std::filesystem::exists(path("c.composite")));
  };
  refused(write_labels("size.tif", 119, 120, [](int x, int) { return x / 60; }), "119 × 120");
  refused(write_labels("one.tif", 120, 120, [](int, int) { return 3; }), "1 label");
  refused(write_labels("many.tif", 120, 120, [](int x, int y) { return x / 30 + 4 * (y / 20); }),
          "24 labels");
  refused(write_labels("narrow.tif", 120, 120, [](int x, int) { return x < 40 ? 5 : 6; }),
          "the label 5");
  EXPECT_EQ(run({"composite", "learn", crop, "--labels", crop, "--out", crop}).status, 2);
}

}  // namespace
}  // namespace belvedere
