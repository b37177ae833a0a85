#include "renderer/image/icc/press_colour.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <algorithm>
#include <memory>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/image_io.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/image/srgb.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/icc/press_profile.h"
#include "tests/renderer/image/random_picture.h"

namespace belvedere {
namespace {

using test::random_picture;
using testing::HasSubstr;

// Colours that the press can print: of inks, where a monitor has them too.
Grid<glm::vec3> printable_chart(const std::vector<std::uint8_t>& press) {
  const SoftProof proof(press, {});
  std::vector<glm::vec3> kept;
  const Grid<glm::vec3> all = random_picture(60, 60, 3);
  const ProofRows rows = proof.make(all);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (rows.outside[i] == 0) kept.push_back(all[i]);
  Grid<glm::vec3> out(static_cast<int>(kept.size()), 1);
  std::copy(kept.begin(), kept.end(), out.begin());
  return out;
}

struct RawTiff {
  std::uint16_t channels = 0, bits = 0, photometric = 0, inkset = 0;
  std::vector<std::uint8_t> profile;
  Grid<Inks> inks;
};

// By libtiff alone, tile by tile.
RawTiff read_raw(const std::string& path, int width, int height) {
  RawTiff out;
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(TIFFOpen(path.c_str(), "r"), TIFFClose);
  TIFFGetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &out.channels);
  TIFFGetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, &out.bits);
  TIFFGetField(tiff.get(), TIFFTAG_PHOTOMETRIC, &out.photometric);
  TIFFGetField(tiff.get(), TIFFTAG_INKSET, &out.inkset);
  std::uint32_t size = 0;
  void* data = nullptr;
  if (TIFFGetField(tiff.get(), TIFFTAG_ICCPROFILE, &size, &data) != 0)
    out.profile.assign(static_cast<std::uint8_t*>(data), static_cast<std::uint8_t*>(data) + size);
  out.inks = Grid<Inks>(width, height);
  std::vector<std::uint8_t> tile(static_cast<std::size_t>(TIFFTileSize(tiff.get())));
  for (const auto [x0, y0] : test::cells({0, 0, width, height}, 256)) {
    TIFFReadTile(tiff.get(), tile.data(), static_cast<std::uint32_t>(x0),
                 static_cast<std::uint32_t>(y0), 0, 0);
    for (const auto [x, y] :
         test::cells({x0, y0, std::min(width, x0 + 256), std::min(height, y0 + 256)}))
      for (int c = 0; c < 4; ++c) {
        const auto i = static_cast<std::size_t>(((y - y0) * 256 + x - x0) * 4 + c);
        out.inks(x, y)[c] =
            out.bits == 16
                ? static_cast<float>(reinterpret_cast<std::uint16_t*>(tile.data())[i]) / 65535.0F
                : static_cast<float>(tile[i]) / 255.0F;
      }
  }
  return out;
}

// Pairs 1, 5, 9, 17, 25, 34 of Sharma, Wu, Dalal, The CIEDE2000 color-difference formula (2005),
// table 1.
TEST(PressColour, DeltaEIsThePublishedOne) {
  EXPECT_NEAR(delta_e_2000({50.0000F, 2.6772F, -79.7751F}, {50.0000F, 0.0000F, -82.7485F}), 2.0425,
              1e-4);
  EXPECT_NEAR(delta_e_2000({50.0000F, -1.1848F, -84.8006F}, {50.0000F, 0.0000F, -82.7485F}), 1.0000,
              1e-4);
  EXPECT_NEAR(delta_e_2000({50.0000F, 2.4900F, -0.0010F}, {50.0000F, -2.4900F, 0.0009F}), 7.1792,
              1e-4);
  EXPECT_NEAR(delta_e_2000({50.0000F, 2.5000F, 0.0000F}, {73.0000F, 25.0000F, -18.0000F}), 27.1492,
              1e-4);
  EXPECT_NEAR(delta_e_2000({60.2574F, -34.0099F, 36.2677F}, {60.4626F, -34.1751F, 39.4387F}),
              1.2644, 1e-4);
  EXPECT_NEAR(delta_e_2000({2.0776F, 0.0795F, -1.1350F}, {0.9033F, -0.0636F, -0.5514F}), 0.9082,
              1e-4);
}

// White is paper; printed colours come back as requested, through a file of 16 and of 8 bits.
TEST(PressColour, AChartComesBackFromTheFile) {
  const std::vector<std::uint8_t> press = test::press_profile();
  const Grid<glm::vec3> chart = printable_chart(press);
  ASSERT_GT(chart.width(), 1000);
  const Grid<glm::vec3> lab = rgb_to_lab(chart);
  const test::Folder folder;
  const InkLook look(press);
  for (const int bits : {16, 8}) {
    const PressConversion conversion(press, {RenderingIntent::relative, false});
    write_whole(*open_tiff_inks(
                    folder / "a.tif", chart.width(), 1, bits, {.icc_profile = press, .notes = {}},
                    [&](const Grid<glm::vec3>& rows) { return conversion.convert(rows); }),
                chart);
    const RawTiff raw = read_raw(folder / "a.tif", chart.width(), 1);
    EXPECT_EQ(raw.channels, 4);
    EXPECT_EQ(raw.bits, bits);
    EXPECT_EQ(raw.photometric, PHOTOMETRIC_SEPARATED);
    EXPECT_EQ(raw.inkset, INKSET_CMYK);
    EXPECT_EQ(raw.profile, press);
    const Grid<glm::vec3> printed = look.lab(raw.inks);
    const Grid<glm::vec3> said = look.lab(conversion.convert(chart));
    double sum = 0.0;
    double highest = 0.0;
    double lost = 0.0;
    for (std::size_t i = 0; i < lab.size(); ++i) {
      const double difference = delta_e_2000(lab[i], printed[i]);
      sum += difference;
      highest = std::max(highest, difference);
      lost = std::max(lost, delta_e_2000(said[i], printed[i]));
    }
    RecordProperty("lost" + std::to_string(bits), std::to_string(lost));
    EXPECT_LT(lost, bits == 16 ? 0.02 : 0.7)
        << "the file adds next to nothing to what the profile's own tables miss";
    RecordProperty("mean" + std::to_string(bits),
                   std::to_string(sum / static_cast<double>(lab.size())));
    EXPECT_LT(sum / static_cast<double>(lab.size()), 1.0) << bits << " bits; highest " << highest;
    EXPECT_LT(highest, 2.0 + 0.2) << "the chart holds what the press makes within 2";
  }
}

TEST(PressColour, InksAreThoseOfTheConversionInAnyRowsAndThreads) {
  const std::vector<std::uint8_t> press = test::press_profile();
  const Grid<glm::vec3> picture = random_picture(300, 270, 3);
  const PressConversion conversion(press, {});
  Grid<Inks> one;
  {
    const ThreadLimit limit(1);
    one = conversion.convert(picture);
  }
  EXPECT_EQ(one, conversion.convert(picture));
  const test::Folder folder;
  const auto write = [&](const std::string& name, int rows_at_once) {
    PictureFiles files(folder / name, {"tif"}, 300, 270, {{}, press}, 300.0, {});
    Image linear = picture;
    for (glm::vec3& colour : linear)
      for (int c = 0; c < 3; ++c)
        colour[c] = static_cast<float>(srgb_decoded(static_cast<double>(colour[c])));
    for (int y = 0; y < 270; y += rows_at_once) {
      const int rows = std::min(rows_at_once, 270 - y);
      Image part(300, rows);
      std::copy(linear.row(y), linear.row(y) + part.size(), part.data());
      files.write_rows(part);
    }
    files.finish();
    return *files.ink();
  };
  const InkCoverage a = write("a", 270);
  const InkCoverage b = write("b", 7);
  EXPECT_EQ(test::read_bytes(folder / "a.tif"), test::read_bytes(folder / "b.tif"));
  EXPECT_EQ(a.pixels, 300U * 270U);
  EXPECT_EQ(a.highest_percent, b.highest_percent);
  EXPECT_EQ(a.mean_percent, b.mean_percent);
  const RawTiff raw = read_raw(folder / "a.tif", 300, 270);
  for (std::size_t i = 0; i < one.size(); ++i)
    for (int c = 0; c < 4; ++c)
      ASSERT_NEAR(raw.inks[i][c], one[i][c], 5e-4) << i << ": linear light and back lies between";
  const ImageInfo info = read_image_info(folder / "a.tif");
  EXPECT_EQ(info.parts.at(0).channels.size(), 4U);
  EXPECT_EQ(info.icc_profile, press);
  EXPECT_THAT(test::input_error([&] { read_picture(folder / "a.tif"); }), HasSubstr("CMYK"));
}

TEST(PressColour, TheProfilesOwnLimitHoldsItsInks) {
  const std::vector<std::uint8_t> press = test::press_profile();
  const double limit = press_ink_limit_percent(press);
  EXPECT_GT(limit, 200.0);
  EXPECT_LE(limit, 400.0);
  InkCount count(limit);
  count.add(PressConversion(press, {}).convert(random_picture(100, 100, 3)));
  EXPECT_LT(count.coverage().above_share(), 0.01);
}

// Paper is white, and no press prints the green of a monitor.
TEST(PressColour, ProofsTellWhatIsMissed) {
  Grid<glm::vec3> picture(3, 1);
  picture(0, 0) = glm::vec3(1.0F);
  picture(1, 0) = {0.0F, 1.0F, 0.0F};
  picture(2, 0) = glm::vec3(0.6F, 0.55F, 0.5F);
  const std::vector<std::uint8_t> press = test::press_profile();
  const ProofRows shown =
      SoftProof(press, {.device = {RenderingIntent::relative, true}}).make(picture);
  EXPECT_LT(shown.delta_e(0, 0), 0.5F);
  EXPECT_EQ(shown.outside(0, 0), 0);
  EXPECT_GT(shown.delta_e(1, 0), 10.0F);
  EXPECT_EQ(shown.outside(1, 0), 1);
  EXPECT_EQ(shown.outside(2, 0), 0);
  EXPECT_LT(1.0F - std::min({shown.shown(0, 0).x, shown.shown(0, 0).y, shown.shown(0, 0).z}),
            0.02F);
  const ProofRows paper = SoftProof(press, {.device = {}, .paper = true}).make(picture);
  EXPECT_LT(paper.shown(0, 0).z, shown.shown(0, 0).z)
      << "paper is darker than the monitor's white, and yellower";
}

TEST(PressColour, WhatIsNoPressProfileIsNamed) {
  const test::Folder folder;
  const std::vector<std::uint8_t> press = test::press_profile();
  folder.write("text.icc", "no profile at all");
  folder.write("link.icc", test::changed_header(press, 12, "link"));
  folder.write("abstract.icc", test::changed_header(press, 12, "abst"));
  folder.write("names.icc", test::changed_header(press, 12, "nmcl"));
  const std::vector<std::uint8_t> rgb = srgb_profile();
  folder.write("rgb.icc", test::changed_header(rgb, 16, "RGB "));
  // Letters beyond ASCII: no colours of any profile.
  folder.write("colours.icc", test::changed_header(press, 16, "\xd2MYK"));
  const auto refused = [&](const char* file) {
    return test::input_error([&] { read_press_profile(folder / file); });
  };
  EXPECT_THAT(refused("text.icc"), HasSubstr("is not an ICC profile"));
  EXPECT_THAT(refused("link.icc"), HasSubstr("device link"));
  EXPECT_THAT(refused("abstract.icc"), HasSubstr("abstract profile"));
  EXPECT_THAT(refused("names.icc"), HasSubstr("named colours"));
  EXPECT_THAT(refused("rgb.icc"), HasSubstr("colours in RGB"));
  EXPECT_THAT(refused("colours.icc"), HasSubstr("colours in ?MYK"));
  EXPECT_THAT(refused("absent.icc"), HasSubstr("absent.icc"));
  EXPECT_THAT(test::input_error([&] { read_device_profile(folder / "link.icc"); }),
              HasSubstr("device link"));
  EXPECT_EQ(read_device_profile(folder / "rgb.icc"), rgb);
  EXPECT_EQ(read_device_profile(test::press_file), press);
  EXPECT_THAT(test::input_error([&] { PressConversion(press, {}, press); }),
              HasSubstr("a picture in RGB"));
}

TEST(InkCount, SumsInksOfPixels) {
  Grid<Inks> rows(4, 1, Inks(0.0F));
  rows(1, 0) = {1.0F, 1.0F, 1.0F, 1.0F};      // 400 %
  rows(2, 0) = {0.75F, 0.75F, 0.75F, 0.75F};  // 300 %, the limit itself
  rows(3, 0) = {0.5F, 0.0F, 0.0F, 0.5F};      // 100 %
  InkCount count(300.0);
  count.add(rows);
  count.add(Grid<Inks>(4, 3, Inks(0.0F)));
  const InkCoverage found = count.coverage();
  EXPECT_EQ(found.pixels, 16U);
  EXPECT_EQ(found.pixels_above, 1U);
  EXPECT_DOUBLE_EQ(found.above_share(), 1.0 / 16.0);
  EXPECT_DOUBLE_EQ(found.highest_percent, 400.0);
  EXPECT_NEAR(found.mean_percent, 800.0 / 16.0, 1e-4);
}

TEST(InkCount, OfNothingIsNothing) {
  const InkCoverage found = InkCount(300.0).coverage();
  EXPECT_EQ(found.mean_percent, 0.0);
  EXPECT_EQ(found.above_share(), 0.0);
}

}  // namespace
}  // namespace belvedere
