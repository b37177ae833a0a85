#include "tools/cli/synthesis_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::HasSubstr;

TEST(SynthesisFiles, LabelsAreNumbersUpTo254) {
  EXPECT_EQ(to_label("--fallback", 0), 0);
  EXPECT_EQ(to_label("--fallback", 254), 254);
  for (const int number : {-1, 255, 1000})
    EXPECT_THAT(test::usage_error([&] { to_label("--fallback", number); }), HasSubstr("--fallback"))
        << number;
}

TEST(SynthesisFiles, ColoursAreCutAndRounded) {
  Grid<glm::vec3> picture(1, 1, glm::vec3(-1.F, 0.5F, 2.F));
  EXPECT_EQ(to_rgb8(picture)(0, 0), (Rgb8{0, 128, 255}));
}

TEST(SynthesisFiles, MatchesComeBackWithTheirPictures) {
  const test::Folder folder;
  MatchField matches(3, 70);  // more than a band of rows
  for (std::size_t i = 0; i < matches.size(); ++i)
    matches[i] = {static_cast<std::uint16_t>(i % 2), static_cast<std::uint16_t>(i % 9), 4};
  matches(1, 69) = {};
  write_matches(folder / "m.exr", matches, {{"a b.png", 9, 5}, {"c.png", 40, 30}},
                {{"note", "kept"}});
  const StoredMatches stored = read_matches(folder / "m.exr");
  EXPECT_EQ(stored.matches, matches);
  ASSERT_EQ(stored.pictures.size(), 2U);
  EXPECT_EQ(stored.pictures[0].name, "a b.png");
  EXPECT_EQ(stored.pictures[1].width, 40);
  EXPECT_EQ(read_image_info(folder / "m.exr").notes.at("note"), "kept");
}

TEST(SynthesisFiles, MatchesOutsideOfTheirPictureAreRefused) {
  const test::Folder folder;
  const MatchField matches(2, 2, {0, 9, 0});
  write_matches(folder / "m.exr", matches, {{"a.png", 9, 5}}, {});
  EXPECT_THAT(test::input_error([&] { read_matches(folder / "m.exr"); }), HasSubstr("9 × 5"));
  write_matches(folder / "n.exr", MatchField(2, 2, {3, 0, 0}), {{"a.png", 9, 5}}, {});
  EXPECT_THAT(test::input_error([&] { read_matches(folder / "n.exr"); }),
              HasSubstr("pictures 0 … 0"));
}

TEST(SynthesisFiles, PairingIsChecked) {
  const auto refusal = [](const SynthesisFiles& files) {
    return test::usage_error([&] { read_synthesis(files); });
  };
  EXPECT_THAT(refusal({}), HasSubstr("--picture is missing"));
  SynthesisFiles files;
  files.pictures = {"a.png", "b.png"};
  files.labels = {{"l.png", "t.png"}};
  EXPECT_THAT(refusal(files), HasSubstr("2 --picture but 1 --label"));
}

}  // namespace
}  // namespace belvedere::tools
