// `belvedere synthesize` as users meet it: with the needs of paintings on paper (masks drawn in
// colours, lettering left out, several paintings matched), and from files alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "renderer/image/image_io.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool is_signature(int x, int y) { return x >= 20 && x < 52 && y >= 12 && y < 36; }

class SynthesizePaintings : public Program {
 protected:
  std::string style_ = write_picture("style.png", 64, 48, [](int x, int y) {
    if (is_signature(x, y)) return glm::vec3(1.F, 0.F, 0.F);
    const float v = static_cast<float>((x * 7 + y * 13) % 32) / 64.F;
    return glm::vec3(0.2F, 0.4F + v, 0.3F);
  });
  // Drawn in two colours, the border between them soft.
  std::string mask(const std::string& name, int width, int height, int border) const {
    return write_picture(name, width, height, [border](int x, int) {
      return x < border    ? glm::vec3(1.F, 1.F, 0.F)
             : x == border ? glm::vec3(0.5F, 0.5F, 0.5F)
                           : glm::vec3(0.F, 0.F, 1.F);
    });
  }
};

TEST_F(SynthesizePaintings, MasksMayBeDrawnInColours) {
  ASSERT_THAT(run({"synthesize", "--picture", style_, "--label", mask("a.png", 64, 48, 20),
                   mask("b.png", 40, 40, 19), "--out", path("out.png"), "--match", path("m.exr")}),
              Ends(0, HasSubstr("0 is #0000ff, 1 is #ffff00")));
  const Grid<std::uint32_t> xs = read_id_channel(path("m.exr"), "x");
  for (const auto [x, y] : test::cells(40, 40)) ASSERT_EQ(xs(x, y) <= 20, x <= 19) << x << " " << y;
}

TEST_F(SynthesizePaintings, ExcludedTexelsAreNeverCopied) {
  const std::string label = write_labels("label.tif", 64, 48, [](int x, int y) {
    return x >= 16 && x < 58 && y >= 8 && y < 40 ? 2 : 1;
  });
  const std::string target = write_labels("target.tif", 48, 40, [](int, int) { return 2; });
  const std::string letters =
      write_labels("letters.tif", 64, 48, [](int x, int y) { return is_signature(x, y) ? 1 : 0; });
  const auto red = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", "--picture", style_,  "--label",
                                          label,        target,      "--out", path("out.png")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(run(arguments), Ends(0));
    const Grid<glm::vec3> picture = read_picture(path("out.png"));
    int count = 0;
    for (const glm::vec3& colour : picture) count += colour.x > 0.9F ? 1 : 0;
    return count;
  };
  EXPECT_GT(red({}), 200);
  EXPECT_GT(red({"--exclude", "-"}), 200);
  EXPECT_EQ(red({"--exclude", letters}), 0);
  EXPECT_EQ(run({"synthesize", "--picture", style_, "--label", label, target, "--exclude", target,
                 "--out", path("o.png")})
                .status,
            2);
  EXPECT_EQ(run({"synthesize", "--picture", style_, "--label", label, target, "--exclude", "-",
                 "--exclude", "-", "--out", path("o.png")})
                .status,
            2);
}

TEST_F(SynthesizePaintings, HarmonizedPaintingsHaveTheFirstOnesColours) {
  const auto stroke = [](int x, int y) {
    return 0.2F * static_cast<float>((x * 7 + y * 13) % 16) / 16.F;
  };
  const std::string warm = write_picture(
      "warm.png", 64, 48, [&](int x, int y) { return glm::vec3(0.6F, 0.4F, 0.2F) + stroke(x, y); });
  const std::string cool = write_picture(
      "cool.png", 64, 48, [&](int x, int y) { return glm::vec3(0.2F, 0.4F, 0.6F) + stroke(y, x); });
  const std::string label = write_labels("label.tif", 64, 48, [](int, int) { return 1; });
  const auto bluest = [&](const std::string& how) {
    EXPECT_THAT(run({"synthesize", "--picture", warm, "--picture", cool, "--label", label, label,
                     "--label", label, label, "--out", path("out.png"), "--harmonize", how}),
                Ends(0));
    float max = -1.F;
    for (const glm::vec3& colour : read_picture(path("out.png")))
      max = std::max(max, colour.z - colour.x);
    return max;
  };
  EXPECT_GT(bluest("off"), 0.35F);
  EXPECT_LT(bluest("first"), -0.3F);
  EXPECT_LT(std::abs(bluest("common")), 0.15F);
  EXPECT_EQ(run({"synthesize", "--picture", warm, "--label", label, label, "--harmonize", "loud",
                 "--out", path("o.png")})
                .status,
            2);
}

TEST_F(SynthesizePaintings, PairsOfLabelsMayBeLessUnlike) {
  const std::string style_mask = mask("a.png", 64, 48, 20);
  const std::string target_mask = mask("b.png", 24, 20, 9);
  const auto status = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"synthesize", "--picture",   style_,
                                       "--label",    style_mask,    target_mask,
                                       "--out",      path("x.png"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).status;
  };
  EXPECT_EQ(status({"--class-dissimilarity", "1", "1", "0.5"}), 2);
  EXPECT_EQ(status({"--class-dissimilarity", "0", "1", "0.5", "--surroundings-of", "all"}), 0);
}

// ---- from files alone

// Two classes, a red and a green texture; the target swaps their sides. Whatever is synthesized,
// red stays on its label.
TEST_F(Program, SynthesizeFromImageFiles) {
  const auto texture = [](int x, int y) {
    const float v = static_cast<float>((x * 7 + y * 13) % 32) / 64.F;
    return x < 32 ? glm::vec3(0.5F + v, v, 0.F) : glm::vec3(0.F, 0.5F + v, v);
  };
  const std::string style = write_picture("style.png", 64, 48, texture);
  const std::string style_class =
      write_labels("style_class.tif", 64, 48, [](int x, int) { return x < 32 ? 1 : 2; });
  const std::string target_class =
      write_labels("target_class.tif", 48, 40, [](int x, int) { return x < 24 ? 2 : 1; });
  const std::string style_alt =
      write_labels("style_alt.tif", 64, 48, [](int, int y) { return 5 * y; });
  const std::string target_alt =
      write_labels("target_alt.tif", 48, 40, [](int, int y) { return 6 * y; });
  const auto arguments = [&](const std::string& out, const std::string& match,
                             const std::string& threads) {
    return std::vector<std::string>{
        "synthesize", "--picture", style,      "--label",   style_class, target_class, "--guide",
        "altitude",   style_alt,   target_alt, "1.0",       "--out",     out,          "--match",
        match,        "--seed",    "3",        "--threads", threads,     "--json",     "--quiet"};
  };
  ASSERT_THAT(run(arguments(path("out.png"), path("match.exr"), "1")),
              Prints(HasSubstr("\"pixels_without_texel\": 0")));
  const Grid<glm::vec3> source = read_picture(style);
  const Grid<glm::vec3> out = read_picture(path("out.png"));
  const Grid<std::uint32_t> xs = read_id_channel(path("match.exr"), "x");
  const Grid<std::uint32_t> ys = read_id_channel(path("match.exr"), "y");
  const Grid<std::uint32_t> from = read_id_channel(path("match.exr"), "exemplar");
  ASSERT_EQ(out.width(), 48);
  ASSERT_EQ(out.height(), 40);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool red = i % 48 >= 24;
    EXPECT_EQ(from[i], 0U);
    EXPECT_EQ(xs[i] < 32, red);
    EXPECT_EQ(out[i], source(static_cast<int>(xs[i]), static_cast<int>(ys[i])));
  }
  // Twice the same, and with two threads.
  ASSERT_EQ(run(arguments(path("out2.png"), path("match2.exr"), "2")).status, 0);
  EXPECT_EQ(read_bytes(path("out2.png")), read_bytes(path("out.png")));
  EXPECT_EQ(read_bytes(path("match2.exr")), read_bytes(path("match.exr")));
  // Two pictures: the second's labels and guides follow the first's.
  const Outcome two =
      run({"synthesize", "--picture",  style,      "--picture", style,          "--label",
           style_class,  target_class, "--label",  style_class, target_class,   "--guide",
           "altitude",   style_alt,    target_alt, "1",         "--guide",      "altitude",
           style_alt,    target_alt,   "1",        "--out",     path("two.tif")});
  EXPECT_EQ(two.status, 0) << two.err;
  EXPECT_EQ(read_image_info(path("two.tif")).format, "tiff");
}

TEST_F(Program, SynthesizeRefusesWhatDoesNotPair) {
  const std::string style =
      write_picture("style.png", 32, 32, [](int, int) { return glm::vec3(0.5F); });
  const std::string label = write_labels("label.tif", 32, 32, [](int, int) { return 1; });
  const std::string other = write_labels("other.tif", 31, 32, [](int, int) { return 1; });
  const std::string out = path("out.png");
  const auto status = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", "--picture", style};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_FALSE(fs::exists(out));
    return outcome.status;
  };
  EXPECT_EQ(status({"--label", other, label, "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--label", label, label, "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--guide", "a", other, label, "1", "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--guide", "a", label, label, "much", "--out", out}),
            2);
  EXPECT_EQ(status({"--label", label, label, "--guide", "a", label, label, "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--out", path("out.jpg")}), 2);
  EXPECT_EQ(status({"--label", label, path("none.tif"), "--out", out}), 3);
  EXPECT_EQ(status({"--label", label, label, "--out", path("label.tif/out.png")}), 4);
}

}  // namespace
}  // namespace belvedere
