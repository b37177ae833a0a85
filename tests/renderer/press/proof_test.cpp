#include "renderer/press/proof.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/image_io.h"
#include "renderer/image/rows/picture_files.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/renderer/image/rows/write_pictures.h"

namespace belvedere {
namespace {

// Greys that every press has, and a quarter of greens that none has.
Grid<glm::vec3> greys_and_greens() {
  return test::grid_of<glm::vec3>(80, 150, [&](int x, int y) {
    return x < 20 ? glm::vec3(0.0F, 1.0F, 0.003F * static_cast<float>(y))
                  : glm::vec3(0.3F + 0.004F * static_cast<float>(y));
  });
}

class Proof : public testing::Test {
 protected:
  Proof() {
    write_tiff16(folder_ / "a.tif", greys_and_greens(),
                 {.dots_per_inch = 300.0, .icc_profile = srgb_profile(), .notes = {}});
  }
  ProofReport make(const std::string& name) {
    Progress progress;
    return write_proof(find_press_picture(folder_ / "a.tif"), test::press_profile(),
                       {.device = {RenderingIntent::relative, true}}, 0.0, folder_ / name,
                       progress);
  }
  test::Folder folder_;
};

TEST_F(Proof, TellsSharesAndShowsThem) {
  const ProofReport report = make("b");
  EXPECT_EQ(report.pixels, 80U * 150U);
  EXPECT_DOUBLE_EQ(report.outside_share, 0.25);
  const Grid<glm::vec3> outside = read_picture(folder_ / "b_outside.png");
  const Grid<glm::vec3> shown = read_picture(folder_ / "b_proof.png");
  EXPECT_GT(outside(5, 70).x, 2.0F * outside(5, 70).y) << "red";
  EXPECT_NEAR(outside(50, 70).x, outside(50, 70).y, 1e-6) << "grey";
  EXPECT_NEAR(shown(50, 70).x, greys_and_greens()(50, 70).x, 0.03F) << "greys stay";
  EXPECT_EQ(shown(0, 70), shown(5, 70)) << "up to the edges";
  EXPECT_EQ(shown(79, 70), shown(50, 70));
  EXPECT_GT(shown(5, 70).x, 0.1F) << "the print's green is duller";
  EXPECT_EQ(read_image_info(folder_ / "b_proof.png").notes.at("belvedere:press"), report.press);
}

// Quantiles against sorting.
TEST_F(Proof, FiguresAreThoseOfThePixels) {
  const ProofReport report = make("b");
  const ProofRows rows =
      SoftProof(test::press_profile(), {.device = {RenderingIntent::relative, true}})
          .make(read_picture(folder_ / "a.tif"));
  std::vector<double> sorted(rows.delta_e.begin(), rows.delta_e.end());
  std::sort(sorted.begin(), sorted.end());
  double sum = 0.0;
  for (const double one : sorted) sum += one;
  EXPECT_NEAR(report.mean_delta_e, sum / static_cast<double>(sorted.size()), 1e-3);
  EXPECT_NEAR(report.delta_e_95, sorted[sorted.size() * 95 / 100 - 1], 0.0101);
  EXPECT_DOUBLE_EQ(report.highest_delta_e, sorted.back());
  InkCount ink(report.ink.limit_percent);
  ink.add(rows.inks);
  EXPECT_EQ(report.ink.highest_percent, ink.coverage().highest_percent);
}

TEST_F(Proof, SameBytesForAnyThreads) {
  {
    const ThreadLimit limit(1);
    make("one");
  }
  make("more");
  for (const char* file : {"_proof.png", "_outside.png"})
    EXPECT_EQ(test::read_bytes(folder_ / (std::string("one") + file)),
              test::read_bytes(folder_ / (std::string("more") + file)));
}

using testing::HasSubstr;

TEST(PressPicture, IsThePictureOfAFolderThatIsRgb) {
  const test::Folder folder;
  const Image picture(20, 10, glm::vec3(0.5F));
  test::write_pictures(folder / "panorama", {"tif", "png", "exr"}, picture);
  EXPECT_EQ(find_press_picture(folder.path()).file, folder / "panorama.tif");
  EXPECT_EQ(find_press_picture(folder.path()).width, 20);
  EXPECT_NEAR(find_press_picture(folder.path()).dots_per_inch, 300.0, 1e-3);
  test::write_pictures(folder / "panorama", {"tif"}, picture, {{}, test::press_profile()});
  EXPECT_EQ(find_press_picture(folder.path()).file, folder / "panorama.png")
      << "the TIFF is CMYK now";
}

TEST(PressPicture, SaysWhatItCannotTake) {
  const test::Folder folder;
  const Image picture(20, 10, glm::vec3(0.5F));
  test::write_pictures(folder / "panorama", {"tif", "exr"}, picture, {{}, test::press_profile()});
  const auto refused = [&](const std::string& path) {
    return test::input_error([&] { find_press_picture(path); });
  };
  EXPECT_THAT(refused(folder / "panorama.tif"), HasSubstr("CMYK"));
  EXPECT_THAT(refused(folder / "panorama.exr"), HasSubstr("linear light"));
  EXPECT_THAT(refused(folder / "absent.png"), HasSubstr("file not found"));
  EXPECT_THAT(refused(folder.path()), HasSubstr("has no panorama"));
}

TEST(PalettePress, FindsTheColourThatNoInksMake) {
  Palette palette = read_palette("summer");
  ClassPalette& pasture = palette.classes[static_cast<std::size_t>(LandCoverClass::pasture)];
  pasture.stops = {{1234.0, ToneRamp{glm::vec3(0.3F), glm::vec3(0.5F), glm::vec3(0.0F, 1.0F, 0.0F),
                                     glm::vec3(0.9F)}}};
  const std::vector<PaletteColour> colours = print_palette(palette, test::press_profile());
  const auto found = std::find_if(colours.begin(), colours.end(), [](const PaletteColour& one) {
    return one.where == "pasture at 1234 m, tone 0.66";
  });
  ASSERT_NE(found, colours.end());
  EXPECT_GT(found->delta_e, 10.0);
  EXPECT_GT(found->printed.x, 0.05F);
  EXPECT_LT((found - 1)->delta_e, 2.0) << "a grey";
  EXPECT_LT((found + 1)->delta_e, 2.0);
}

// Each ramp has its four tones at each altitude; sky is no ramp.
TEST(PalettePress, HasEveryColourOfThePalette) {
  const Palette palette = read_palette("winter");
  std::size_t expected = palette.sky.size() + 5 + palette.growth.leaves.size() +
                         (palette.growth.larch_share > 0.0 ? 1 : 0);
  for (const ClassPalette& one : palette.classes) expected += 4 * one.stops.size();
  EXPECT_EQ(print_palette(palette, test::press_profile()).size(), expected);
}

}  // namespace
}  // namespace belvedere
