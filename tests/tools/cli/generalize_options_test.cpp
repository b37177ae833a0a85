#include "tools/cli/command_generalize.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/files.h"
#include "tests/tools/read_options.h"

namespace belvedere::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

GeneralizeOptions read_generalize_options(const std::string& line) {
  return test::read_options<GeneralizeOptions>(add_generalize_options, line);
}
std::string refusal(const std::string& line) {
  return test::usage_error([&] { resolve_bands(read_generalize_options(line)); });
}

TEST(GeneralizeOptions, WeightsAreListsWithCommas) {
  const GeneralizeOptions options = read_generalize_options(
      "in.tif out.tif --global 1,1,0.5 --ridges 0,-0.5,1 --viewer 10,20 --distances 5,9 "
      "--curvature plan");
  EXPECT_THAT(options.viewer, ElementsAre(10.0, 20.0));
  const GeneralizeParameters bands = resolve_bands(options);
  EXPECT_THAT(bands.foreground, ElementsAre(1.F, 1.F, 0.5F));
  EXPECT_THAT(bands.background, ElementsAre(1.F, 1.F, 0.5F)) << "else as near";
  EXPECT_THAT(bands.foreground_ridges, ElementsAre(0.F, -0.5F, 1.F));
  EXPECT_THAT(bands.foreground_valleys, IsEmpty());
  EXPECT_EQ(bands.curvature, CurvatureForm::plan);
}

TEST(GeneralizeOptions, PresetsGiveWeightsAndMasks) {
  EXPECT_FALSE(masked_slopes(read_generalize_options("a b --global 1")));
  EXPECT_FALSE(masks_slope_feet(read_generalize_options("a b --global 1")));
  EXPECT_TRUE(masks_slope_feet(read_generalize_options("a b --global 1 --automatic-mask")));
  const auto own = masked_slopes(read_generalize_options("a b --preset figure5 --mask-slope 2,8"));
  ASSERT_TRUE(own);
  EXPECT_EQ(own->original_to_deg, 2.0);
  EXPECT_EQ(own->generalized_from_deg, 8.0);
  EXPECT_TRUE(masked_slopes(read_generalize_options("a b --preset figure5"))) << "the preset's own";
  EXPECT_THAT(resolve_bands(read_generalize_options("a b --preset figure2")).foreground,
              ElementsAre(1.F, 1.F, 2.F, 0.25F, 0.F));
  EXPECT_THROW(read_generalize_options("a b --preset nonsense"), Error);
}

TEST(GeneralizeOptions, WhatCannotBeMeantIsRefused) {
  EXPECT_THAT(refusal("a b"), HasSubstr("--preset NAME"));
  EXPECT_THAT(refusal("a b --global 1,1 --ridges 1"), HasSubstr("as many as --global has, 2"));
  EXPECT_THAT(refusal("a b --global 1,5.1"), HasSubstr("0 … 5"));
  EXPECT_THAT(refusal("a b --global 1,nan"), HasSubstr("weight"));
  EXPECT_THAT(refusal("a b --global 1 --valleys -6"), HasSubstr("-5 … 5"));
  EXPECT_THAT(refusal("a b --global 1,1,1,1,1,1,1,1,1,1,1,1,1"), HasSubstr("1 to 12"));
  EXPECT_THAT(refusal("a b --global 1,1 --background-global 1,0"), HasSubstr("--viewer E,N"));
}

TEST(GeneralizeOptions, TheCommandIsToldWithoutFolders) {
  const GeneralizeOptions options = read_generalize_options(
      "/data/in.tif /out/o.tif --global 1,0.5 --viewer 1,2 --mask /m/mask.tif --mask-slope 2,8 "
      "--automatic-mask --destripe --widen-valleys "
      "60 --curvature plan --full-curvature 0.4 --blur 2 --exponent 0.6 --base 1.1 --change-lakes");
  EXPECT_EQ(
      describe_generalize(options, resolve_bands(options)),
      "belvedere generalize in.tif o.tif --global 1,0.5 --background-global 1,0.5 --viewer "
      "1,2 --mask mask.tif --mask-slope 2,8 "
      "--automatic-mask --change-lakes --base 1.1 --curvature plan --full-curvature 0.4 --blur 2 "
      "--exponent 0.6 --destripe --widen-valleys 60");
}

}  // namespace
}  // namespace belvedere::tools
