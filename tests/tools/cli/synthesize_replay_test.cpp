// synthesize --replay: other layers of the same paintings, copied by a stored match field.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <filesystem>

#include "base/random.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Replay : public Program {
 protected:
  static constexpr int width = 48;
  static constexpr int height = 40;

  // A painting of two classes, a target that has a third besides, and the matches between them.
  void SetUp() override {
    style_ = write_picture("style.png", width, height, [](int x, int y) {
      return glm::vec3(x < 24 ? 0.9F : 0.2F, static_cast<float>((x * 7 + y * 13) % 32) / 64.F,
                       static_cast<float>(y) / 64.F);
    });
    const std::string style_class =
        write_labels("style_class.tif", width, height, [](int x, int) { return x < 24 ? 1 : 2; });
    const std::string target_class = write_labels("target_class.tif", 37, 30, [](int x, int y) {
      return y < 3 ? 3 : x < 20 ? 2 : 1;
    });
    match_ = path("match.exr");
    ASSERT_THAT(run({"synthesize", "--picture", style_, "--label", style_class, target_class,
                     "--out", path("made.tif"), "--match", match_, "--quiet"}),
                Ends(0));
    exemplar_ = read_id_channel(match_, "exemplar");
    x_ = read_id_channel(match_, "x");
    y_ = read_id_channel(match_, "y");
  }
  Outcome replay(const std::vector<std::string>& layers, const std::string& out,
                 const std::string& match = "") const {
    std::vector<std::string> arguments = {"synthesize", "--replay", match.empty() ? match_ : match,
                                          "--out", out};
    for (const std::string& layer : layers) arguments.insert(arguments.end(), {"--picture", layer});
    return run(arguments);
  }
  // A match field by hand, one pixel; texel as it stands in the file.
  std::string write_match(const std::string& name, std::uint32_t exemplar, std::uint32_t x,
                          std::uint32_t y, const FileNotes& notes,
                          ChannelType type = ChannelType::uint32) const {
    ExrWriter writer(
        path(name), 1, 1,
        {{"match", {{"exemplar", type}, {"x", ChannelType::uint32}, {"y", ChannelType::uint32}}}},
        notes);
    writer.write_rows(
        0, 0, 1,
        {std::bit_cast<float>(exemplar), std::bit_cast<float>(x), std::bit_cast<float>(y)});
    writer.finish();
    return path(name);
  }

  std::string style_, match_;
  Grid<std::uint32_t> exemplar_, x_, y_;
};

TEST_F(Replay, TheSamePictureGivesTheSamePixels) {
  ASSERT_THAT(replay({style_}, path("again.tif")), Ends(0, HasSubstr("111 pixels stay black")));
  EXPECT_EQ(read_picture(path("again.tif")), read_picture(path("made.tif")));
}

TEST_F(Replay, SixteenBitsComeThroughExactly) {
  Grid<glm::vec3> layer(width, height);
  std::vector<int> values;
  for (std::size_t i = 0; i < layer.size(); ++i)
    for (int c = 0; c < 3; ++c)
      layer[i][c] = static_cast<float>(random_index(65536, 9, static_cast<int>(i), c)) / 65535.F;
  write_tiff16(path("layer.tif"), layer, {});
  ASSERT_THAT(replay({path("layer.tif")}, path("out.tif")), Ends(0));
  EXPECT_EQ(read_image_info(path("out.tif")).parts.front().channels.front().type,
            ChannelType::uint16);
  const Grid<glm::vec3> source = read_picture(path("layer.tif"));
  const Grid<glm::vec3> out = read_picture(path("out.tif"));
  ASSERT_TRUE(out.same_size(exemplar_));
  for (std::size_t i = 0; i < out.size(); ++i) {
    const glm::vec3 expected = exemplar_[i] == 0
                                   ? source(static_cast<int>(x_[i]), static_cast<int>(y_[i]))
                                   : glm::vec3(0.F);
    EXPECT_EQ(out[i], expected);
  }
  // A PNG cannot hold them, and reports it.
  EXPECT_THAT(replay({path("layer.tif")}, path("out.png")), Ends(0, HasSubstr("keeps 8")));
}

TEST_F(Replay, OpenExrKeepsEveryChannelInItsType) {
  const std::vector<PartSpec> parts = {
      {"light", {{"B", ChannelType::half}, {"G", ChannelType::half}, {"R", ChannelType::half}}},
      {"ground", {{"Z", ChannelType::float32}, {"landcover.id", ChannelType::uint32}}}};
  {
    ExrWriter writer(path("layer.exr"), width, height, parts, {});
    std::vector<float> light, ground;
    for (int i = 0; i < width * height; ++i) {
      light.insert(light.end(), {static_cast<float>(i), -2.5F, 60000.F});
      ground.insert(ground.end(),
                    {1.F / static_cast<float>(i + 3),
                     std::bit_cast<float>(4000000000U + static_cast<std::uint32_t>(i))});
    }
    writer.write_rows(0, 0, height, light);
    writer.write_rows(1, 0, height, ground);
    writer.finish();
  }
  ASSERT_THAT(replay({path("layer.exr")}, path("out.exr")), Ends(0));
  const ImageInfo info = read_image_info(path("out.exr"));
  ASSERT_EQ(info.parts.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) EXPECT_EQ(info.parts[p].channels, parts[p].channels);
  const Grid<float> blue = read_channel(path("out.exr"), "B");
  const Grid<float> green = read_channel(path("out.exr"), "G");
  const Grid<float> z = read_channel(path("out.exr"), "Z");
  const Grid<std::uint32_t> id = read_id_channel(path("out.exr"), "landcover.id");
  for (std::size_t i = 0; i < id.size(); ++i) {
    const auto at = static_cast<float>(y_[i] * width + x_[i]);
    const bool copied = exemplar_[i] == 0;
    EXPECT_EQ(blue[i], copied ? at : 0.F);
    EXPECT_EQ(green[i], copied ? -2.5F : 0.F);
    EXPECT_EQ(z[i], copied ? 1.F / (at + 3.F) : 0.F);
    EXPECT_EQ(id[i], copied ? 4000000000U + static_cast<std::uint32_t>(at) : 0U);
  }
  // In a TIFF values outside 0 … 1 are clamped, with a note.
  EXPECT_THAT(replay({path("layer.exr")}, path("out.tif")),
              Ends(0, HasSubstr("an .exr would keep them")));
}

TEST_F(Replay, SeveralPaintingsEachTakeTheirLayer) {
  const std::string first = write_picture(
      "first.png", 8, 4, [](int x, int) { return glm::vec3(static_cast<float>(x) / 255.F); });
  const std::string second = write_picture("second.png", 4, 8, [](int, int y) {
    return glm::vec3(static_cast<float>(100 + y) / 255.F);
  });
  const FileNotes notes{{"belvedere:matched_pictures", "8 4 a painting.png\n4 8 another.png\n"}};
  const std::string match = write_match("two.exr", 1, 3, 7, notes);
  ASSERT_EQ(replay({first, second}, path("out.tif"), match).status, 0);
  EXPECT_EQ(read_picture(path("out.tif"))[0], glm::vec3(107.F / 255.F));
  EXPECT_THAT(replay({second, first}, path("swapped.tif"), match),
              Ends(2, AllOf(HasSubstr("second.png"), HasSubstr("4 × 8"),
                            HasSubstr("8 × 4, as a painting.png"))));
  EXPECT_THAT(replay({first}, path("one.tif"), match),
              Ends(2, HasSubstr("a painting.png, another.png")));
}

TEST_F(Replay, RefusesWhatDoesNotFit) {
  const std::string small =
      write_picture("small.png", width - 1, height, [](int, int) { return glm::vec3(0.5F); });
  const auto refused = [&](int status, const std::vector<std::string>& layers,
                           const std::string& out, const std::string& match,
                           const std::string& words) {
    EXPECT_THAT(replay(layers, path(out), match), Ends(status, HasSubstr(words)));
    EXPECT_FALSE(fs::exists(path(out)));
  };
  refused(2, {small}, "out.tif", "", "47 × 40");
  refused(2, {style_, style_}, "out.tif", "", "2 --picture are given");
  refused(2, {style_}, "out.jpg", "", ".tif (16 bit)");
  refused(2, {style_}, "out.exr", "", "linear light");
  refused(3, {path("none.png")}, "out.tif", "", "none.png");
  refused(3, {style_}, "out.tif", style_, "is not a match field but png");
  refused(3, {style_}, "out.tif", path("none.exr"), "none.exr");
  // Another program's file: no note about pictures, or a wrong one.
  refused(3, {style_}, "out.tif", write_match("float.exr", 0, 0, 0, {}, ChannelType::float32),
          "no channel exemplar of whole numbers");
  refused(2, {style_}, "out.tif", write_match("far.exr", 0, width, 0, {}), "texel 48, 0 is needed");
  refused(2, {style_}, "out.tif", write_match("other.exr", 1, 0, 0, {}), "at least 2");
  refused(3, {style_}, "out.tif",
          write_match("beyond.exr", 0, 0, height,
                      {{"belvedere:matched_pictures", "48 40 style.png\n"}}),
          "copies texel 0, 40 of picture 0");
  refused(3, {style_}, "out.tif",
          write_match("note.exr", 0, 0, 0, {{"belvedere:matched_pictures", "wide high\n"}}),
          "wide high");
  refused(3, {style_}, "out.tif", write_match("large.exr", 70000, 0, 0, {}), "of picture 70000");
  EXPECT_THAT(run({"synthesize", "--replay", match_, "--picture", style_, "--label", style_, style_,
                   "--out", path("out.tif")}),
              Ends(2, AllOf(HasSubstr("--replay"), HasSubstr("--label"))));
  const Outcome half =
      run({"synthesize", "--picture", style_, "--label", style_, "--out", path("out.tif")});
  EXPECT_EQ(half.status, 2);
  EXPECT_THAT(
      half.err,
      HasSubstr("--label: needs two files, of the painting and of the target, but --out follows"));
  EXPECT_THAT(run({"synthesize", "--picture", style_, "--out", path("out.tif")}),
              Ends(2, HasSubstr("--label")));
}

}  // namespace
}  // namespace belvedere
