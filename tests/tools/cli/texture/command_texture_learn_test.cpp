// `belvedere texture learn` and `make` as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/random.h"
#include "tests/grids.h"
#include "tests/texture/statistical/texture_crops.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Texture : public Program {
 protected:
  std::string write_crop(int width = 72, int height = 64) const {
    const Grid<Rgb8> crop = test::meadow_crop(width, height);
    return write_picture("crop.png", width, height, [&](int x, int y) {
      const Rgb8& c = crop(x, y);
      return glm::vec3(c[0], c[1], c[2]) / 255.F;
    });
  }
};

TEST_F(Texture, IsLearntAndMadeWithoutEnd) {
  ASSERT_THAT(
      run({"texture", "learn", write_crop(), "--types", "20", "--out", path("m.model"), "--report",
           path("page"), "-q", "--json"}),
      Prints(AllOf(HasSubstr("\"held_out\""), HasSubstr("\"halves\""), HasSubstr("\"trials\""))));
  EXPECT_LT(read_bytes(path("m.model")).size(), 1700U);
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("texture.png"), HasSubstr("halves of the crop")));

  const auto make = [&](const std::string& name, std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"texture", "make", path("m.model"), "--out", path(name), "-q"});
    EXPECT_THAT(run(options), Ends(0));
    return read_picture(path(name));
  };
  const Grid<glm::vec3> one =
      make("one.png", {"--size", "50x40", "--threads", "1", "--report", path("made")});
  EXPECT_EQ(one.width(), 50);
  EXPECT_EQ(read_picture(path("made/texture.png")), one);
  EXPECT_THAT(read_bytes(path("made/index.html")),
              AllOf(HasSubstr("--size 50x40 --seed 1"), HasSubstr("72 × 64")));
  EXPECT_EQ(one, make("two.png", {"--size", "50", "40", "--threads", "2"}));
  EXPECT_NE(one, make("other.png", {"--size", "50", "40", "--seed", "9"}));
  // Overlapping windows.
  const Grid<glm::vec3> left = make("left.png", {"--window", "-30", "5", "60", "20"});
  const Grid<glm::vec3> right = make("right.png", {"--window", "10,10,20,10"});
  for (const auto [x, y] : test::cells(20, 10)) EXPECT_EQ(right(x, y), left(x + 40, y + 5));

  // A hole in the crop: what is around it stays to the bit.
  const std::string hole = write_labels("hole.tif", 72, 64, [](int x, int y) {
    return x > 20 && x < 40 && y > 20 && y < 44 ? 1 : 0;
  });
  const Outcome filled =
      run({"texture", "fill", path("crop.png"), "--hole", hole, "--model", path("m.model"), "--out",
           path("filled.png"), "--report", path("page")});
  ASSERT_EQ(filled.status, 0) << filled.err;
  EXPECT_THAT(filled.out, HasSubstr("437 of 4608"));
  const Grid<glm::vec3> before = read_picture(path("crop.png"));
  const Grid<glm::vec3> after = read_picture(path("filled.png"));
  int changed = 0;
  for (const auto [x, y] : test::cells(72, 64)) {
    const bool inside = x > 20 && x < 40 && y > 20 && y < 44;
    if (!inside) {
      EXPECT_EQ(after(x, y), before(x, y));
    }
    changed += after(x, y) != before(x, y) ? 1 : 0;
  }
  EXPECT_GT(changed, 300);
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("437 of 4608"), HasSubstr("before.png"), HasSubstr("after.png")));
  EXPECT_EQ(read_picture(path("page/before.png")), before) << "all of it lies around the hole";
}

TEST_F(Texture, JoinsPicturesAndNothingElse) {
  const auto colour = [](const Rgb8& c) { return glm::vec3(c[0], c[1], c[2]) / 255.F; };
  const auto bluish = [](const Rgb8& c) { return glm::vec3(c[2], c[1], c[0]) / 255.F; };
  const Grid<Rgb8> meadow = test::meadow_crop(72, 64);
  const Grid<Rgb8> other = test::meadow_crop(60, 64, 3);
  const std::string left =
      write_picture("left.png", 72, 64, [&](int x, int y) { return colour(meadow(x, y)); });
  const std::string right =
      write_picture("right.png", 60, 64, [&](int x, int y) { return bluish(other(x, y)); });
  ASSERT_THAT(run({"texture", "seam", left, right, "--out", path("seam.png"), "--band-px", "12",
                   "--report", path("page"), "-q", "--json"}),
              Prints(AllOf(HasSubstr("\"at_px\""), HasSubstr("\"before\""))));
  const Grid<glm::vec3> joined = read_picture(path("seam.png"));
  ASSERT_EQ(joined.width(), 132);
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("cut.png"), HasSubstr("\"at_px\": 72"), HasSubstr("--band-px 12")));
  EXPECT_EQ(read_picture(path("page/after.png")), joined);
  const Grid<glm::vec3> a = read_picture(left);
  const Grid<glm::vec3> b = read_picture(right);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 60; ++x) ASSERT_EQ(joined(x, y), a(x, y));
    for (int x = 12; x < 60; ++x) ASSERT_EQ(joined(72 + x, y), b(x, y));
  }
  // The same turned by a quarter.
  const std::string top =
      write_picture("top.png", 64, 72, [&](int x, int y) { return colour(meadow(y, x)); });
  const std::string below =
      write_picture("below.png", 64, 60, [&](int x, int y) { return bluish(other(y, x)); });
  ASSERT_EQ(run({"texture", "seam", top, below, "--down", "--out", path("down.png"), "--band-px",
                 "12", "-q"})
                .status,
            0);
  const Grid<glm::vec3> down = read_picture(path("down.png"));
  for (const auto [x, y] : test::cells(132, 64)) ASSERT_EQ(down(y, x), joined(x, y));
  EXPECT_EQ(run({"texture", "seam", left, "--out", path("seam.png")}).status, 2);
  EXPECT_EQ(run({"texture", "seam", left, below, "--out", path("seam.png")}).status, 2);
}

TEST_F(Texture, CorrectedPicturesHaveTheColoursOfTheOther) {
  const auto plain = [&](const std::string& name, glm::vec3 colour) {
    return write_picture(name, 60, 50, [&](int x, int y) {
      return colour * (.8F + .01F * static_cast<float>((3 * x + 5 * y) % 20));
    });
  };
  const std::string red = plain("red.png", {.8F, .4F, .3F});
  const std::string blue = plain("blue.png", {.3F, .4F, .7F});
  ASSERT_THAT(run({"texture", "correct", red, "--to", blue, "--out", path("out.png"), "--regions",
                   "1", "--report", path("page"), "--json", "-q"}),
              Prints(AllOf(HasSubstr("\"before\""), HasSubstr("\"after\""))));
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("source.png"), HasSubstr("target.png"), HasSubstr("saturation")));
  EXPECT_EQ(read_picture(path("page/corrected.png")), read_picture(path("out.png")));
  const glm::vec3 out = read_picture(path("out.png"))(30, 25);
  const glm::vec3 wanted = read_picture(blue)(30, 25);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(out[c], wanted[c], .03F);
  EXPECT_EQ(run({"texture", "correct", red, "--to", blue, "--out", path("x.png"), "--regions", "6"})
                .status,
            2);
  EXPECT_EQ(
      run({"texture", "correct", red, "--to", path("gone.png"), "--out", path("x.png")}).status, 3);
  EXPECT_EQ(run({"texture", "correct", red, "--to", blue, "--out", red}).status, 2);
}

// A red disc on a meadow: the meadow grows over it, and no pixel beside it changes.
TEST_F(Texture, RemovesWhatIsMarkedAndTouchesNothingElse) {
  const Grid<Rgb8> meadow = test::meadow_crop(110, 100);
  const auto marked = [](int x, int y) {
    return (x - 50) * (x - 50) + (y - 45) * (y - 45) < 12 * 12;
  };
  const std::string picture = write_picture("p.png", 110, 100, [&](int x, int y) {
    const Rgb8& c = meadow(x, y);
    return marked(x, y) ? glm::vec3(1.F, 0.F, 0.F) : glm::vec3(c[0], c[1], c[2]) / 255.F;
  });
  const std::string mask =
      write_labels("mask.tif", 110, 100, [&](int x, int y) { return marked(x, y) ? 1 : 0; });
  ASSERT_THAT(run({"texture", "remove", picture, "--mask", mask, "--out", path("out.png"),
                   "--report", path("page")}),
              Prints(HasSubstr("of 11000 pixels filled")));
  EXPECT_THAT(read_bytes(path("page/index.html")),
              AllOf(HasSubstr("texture remove p.png --mask mask.tif"), HasSubstr("after.png")));
  const Grid<glm::vec3> before = read_picture(picture);
  const Grid<glm::vec3> after = read_picture(path("out.png"));
  for (const auto [x, y] : test::cells(110, 100)) {
    if (!marked(x, y)) {
      ASSERT_EQ(after(x, y), before(x, y)) << x << ", " << y;
    } else {
      ASSERT_GT(after(x, y).y, after(x, y).x - .1F) << "still red at " << x << ", " << y;
    }
  }
  ASSERT_EQ(run({"texture", "remove", picture, "--mask", mask, "--out", path("one.png"),
                 "--threads", "1", "-q"})
                .status,
            0);
  EXPECT_EQ(read_picture(path("one.png")), after);
  const std::string all = write_labels("all.tif", 110, 100, [](int, int) { return 1; });
  EXPECT_THAT(run({"texture", "remove", picture, "--mask", all, "--out", path("x.png")}),
              Ends(3, HasSubstr("no texture around them")));
}

// A crop in bright light is planted in a dim picture, half dim meadow and half grey ground: it has
// the dim meadow's light, not its own and not the ground's.
TEST_F(Texture, PlantsACropInThePicturesLight) {
  const Grid<Rgb8> meadow = test::meadow_crop(120, 90);
  const auto of = [&](int x, int y, float light) {
    const Rgb8& c = meadow(x, y);
    return glm::vec3(c[0], c[1], c[2]) * (light / 255.F);
  };
  const auto marked = [](int x, int y) { return x >= 12 && x < 48 && y >= 20 && y < 60; };
  const std::string picture = write_picture("p.png", 120, 90, [&](int x, int y) {
    return x < 60 ? glm::vec3(.35F + .02F * static_cast<float>((x * 5 + y * 3) % 7))
                  : of(x, y, .5F);
  });
  const std::string crop =
      write_picture("crop.png", 64, 64, [&](int x, int y) { return of(x, y, 1.F); });
  const std::string mask =
      write_labels("mask.tif", 120, 90, [&](int x, int y) { return marked(x, y) ? 1 : 0; });
  const Grid<glm::vec3> before = read_picture(picture);
  const auto mean_of_planted = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"texture", "plant", picture, "--mask",        mask,
                                      "--from",  crop,    "--out", path("out.png"), "-q"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_THAT(run(words), Ends(0));
    const Grid<glm::vec3> after = read_picture(path("out.png"));
    glm::vec3 sum(0.F);
    for (const auto [x, y] : test::cells(120, 90)) {
      if (marked(x, y))
        sum += after(x, y) / (36.F * 40.F);
      else
        EXPECT_EQ(after(x, y), before(x, y)) << x << ", " << y;
    }
    return sum;
  };
  glm::vec3 bright(0.F);
  for (const auto [x, y] : test::cells(64, 64)) bright += of(x, y, 1.F) / (64.F * 64.F);
  const glm::vec3 planted = mean_of_planted({});
  const glm::vec3 uncorrected = mean_of_planted({"--as-it-is"});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(planted[c], .5F * bright[c], .06F) << c;
    EXPECT_NEAR(uncorrected[c], bright[c], .06F) << c;
  }
  const std::string ground =
      write_labels("ground.tif", 120, 90, [](int x, int) { return x < 60 ? 1 : 0; });
  const glm::vec3 grey = mean_of_planted({"--like", ground});
  EXPECT_NEAR(grey.x, grey.z, .08F) << "of the ground that --like names";
}

// A dim crop in a light meadow beside a dark one: the light of what lies around the mask, not of
// the dark part that is as dim as the crop.
TEST_F(Texture, PlantsInTheLightAroundTheMask) {
  const Grid<Rgb8> meadow = test::meadow_crop(160, 100);
  const auto of = [&](int x, int y, float light) {
    const Rgb8& c = meadow(x, y);
    return glm::vec3(c[0], c[1], c[2]) * (light / 255.F);
  };
  const auto marked = [](int x, int y) { return x >= 12 && x < 48 && y >= 30 && y < 70; };
  const std::string picture =
      write_picture("p.png", 160, 100, [&](int x, int y) { return of(x, y, x < 90 ? 1.2F : .4F); });
  const std::string crop =
      write_picture("crop.png", 64, 64, [&](int x, int y) { return of(x, y, .5F); });
  const std::string mask =
      write_labels("mask.tif", 160, 100, [&](int x, int y) { return marked(x, y) ? 1 : 0; });
  ASSERT_THAT(run({"texture", "plant", picture, "--mask", mask, "--from", crop, "--out",
                   path("out.png"), "-q"}),
              Ends(0));
  const Grid<glm::vec3> after = read_picture(path("out.png"));
  double green = 0.0;
  for (const auto [x, y] : test::cells(160, 100))
    if (marked(x, y)) green += static_cast<double>(after(x, y).y) / (36.0 * 40.0);
  EXPECT_NEAR(green, 1.2 * 131.0 / 255.0, .08);
}

TEST_F(Texture, BadInputIsNamed) {
  const auto refused = [&](const std::vector<std::string>& arguments, int status,
                           const std::string& word) {
    EXPECT_THAT(run(arguments), Ends(status, HasSubstr(word)));
  };
  const std::string crop = write_crop();
  const std::string tiny = write_picture(
      "tiny.png", 40, 90, [](int x, int) { return glm::vec3(static_cast<float>(x % 7) / 7.F); });
  refused({"texture", "learn", tiny, "--out", path("m.model")}, 3, "40 × 90");
  refused({"texture", "learn", crop, "--mask",
           write_labels("mask.tif", 10, 10, [](int, int) { return 1; }), "--out", path("m.model")},
          3, "10 × 10");
  refused({"texture", "learn", crop, "--mask",
           write_labels("none.tif", 72, 64, [](int, int) { return 0; }), "--out", path("m.model")},
          3, "0 pixels");
  refused({"texture", "learn", crop, "--out", crop}, 2, "is also an input");
  refused(
      {"texture", "learn", crop, "--method", "paper", "--begin", "discs", "--out", path("m.model")},
      2, "--method paper");
  refused({"texture", "fill", crop, "--hole", path("mask.tif"), "--model", path("m.model"), "--out",
           path("x.png")},
          3, "m.model");
  EXPECT_FALSE(std::filesystem::exists(path("m.model")));
  refused({"texture", "make", write("m.model", "belvedere_texture = 7\n"), "--size", "9", "9",
           "--out", path("x.png")},
          2, "version 7");
  refused({"texture", "make", path("gone.model"), "--size", "9", "9", "--out", path("x.png")}, 3,
          "gone.model");
  refused({"texture", "make", path("m.model"), "--out", path("x.png")}, 2, "--size");
  refused({"texture", "make", path("m.model"), "--size", "9", "9", "--out", path("x.exr")}, 2,
          ".png");
}

}  // namespace
}  // namespace belvedere
