#include "renderer/image/rows/picture_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <tuple>

#include "base/error.h"
#include "base/memory/sanitized.h"
#include "base/memory_limit.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/image/picture_formats.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/image/random_picture.h"
#include "tests/renderer/image/rows/write_pictures.h"
#include "tests/small_disk.h"

namespace belvedere {
namespace {

using test::Folder;
using test::random_picture;

Image rows_of(const Image& picture, int first, int rows) {
  Image out(picture.width(), rows);
  std::copy(picture.row(first), picture.row(first) + out.size(), out.data());
  return out;
}

// A profile that is not sRGB: red and green have changed places in its table of tags.
std::vector<std::uint8_t> printer_profile() {
  std::vector<std::uint8_t> bytes = srgb_profile();
  std::string text(bytes.begin(), bytes.end());
  const std::size_t red = text.find("rXYZ");
  const std::size_t green = text.find("gXYZ");
  bytes[red] = 'g';
  bytes[green] = 'r';
  return bytes;
}

std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

// The files of a folder by name, with their bytes.
std::map<std::string, std::string> contents_of(const Folder& folder) {
  std::map<std::string, std::string> out;
  for (const std::string& name : names_in(folder.path()))
    out[name] = test::read_bytes(folder / name);
  return out;
}

void write_in_rows(const std::string& stem, const std::vector<std::string>& extensions,
                   const Image& linear, const PictureColours& colours, int step) {
  PictureFiles files(stem, extensions, linear.width(), linear.height(), colours, 300.0,
                     {{"scene", "a = 1"}});
  for (int y = 0; y < linear.height(); y += step)
    files.write_rows(rows_of(linear, y, std::min(step, linear.height() - y)));
  files.finish();
}

TEST(PictureFiles, HowTheRowsComeChangesNoByte) {
  const PictureColours colours{.display = {}, .device_profile = printer_profile()};
  struct Case {
    int width, height;
    std::vector<std::string> extensions;
  };
  // Tiles, bands and groups of each format, the last ones cut; and a picture whose PNG is reduced
  // by 2.
  for (const Case& c : {Case{300, 333, picture_extensions()}, Case{9001, 75, {"png"}}}) {
    const Image linear = random_picture(c.width, c.height);
    const Folder whole("whole");
    write_in_rows(whole / "p", c.extensions, linear, colours, c.height);
    EXPECT_EQ(names_in(whole.path()).size(), c.extensions.size());
    for (const int step : {1, 7, 64}) {
      const Folder parts("parts");
      write_in_rows(parts / "p", c.extensions, linear, colours, step);
      EXPECT_TRUE(contents_of(parts) == contents_of(whole))
          << step << " rows at a time of " << c.width << " pixels";
    }
  }
}

TEST(PictureFiles, APngAboveItsLongestSideIsReducedInLinearLight) {
  const Folder folder("reduced");
  for (const auto& [width, height, factor] : {std::tuple{8001, 7, 2}, std::tuple{3, 16001, 3}}) {
    Image linear = random_picture(width, height);
    linear(0, 0) = glm::vec3(4.0F, 0.0F,
                             0.0F);  // brighter than white: its share of the mean is of light, not
                                     // of the displayed value
    test::write_pictures(folder / "p", {"png", "tif"}, linear);
    EXPECT_EQ(read_picture(folder / "p.tif").width(), width) << "of full size";
    const ImageInfo info = read_image_info(folder / "p.png");
    EXPECT_NEAR(info.dots_per_inch, 300.0 / factor, 0.02);
    EXPECT_EQ(info.notes.at("belvedere:reduced"), "by " + std::to_string(factor) + ", from " +
                                                      std::to_string(width) + " × " +
                                                      std::to_string(height) + " pixels");
    const Grid<glm::vec3> png = read_picture(folder / "p.png");
    ASSERT_EQ(png.width(), (width + factor - 1) / factor);
    ASSERT_EQ(png.height(), (height + factor - 1) / factor);
    Image mean(png.width(), png.height());
    for (const auto [x, y] : test::cells(mean)) {
      glm::dvec3 sum(0.0);
      int count = 0;
      for (int v = y * factor; v < std::min(height, (y + 1) * factor); ++v)
        for (int u = x * factor; u < std::min(width, (x + 1) * factor); ++u, ++count)
          sum += glm::dvec3(linear(u, v));
      mean(x, y) = glm::vec3(sum / static_cast<double>(count));
    }
    const Grid<glm::vec3> shown = to_display(mean, {});
    for (std::size_t i = 0; i < png.size(); ++i)
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(png[i][c] * 255.0, std::min(1.0F, shown[i][c]) * 255.0, 0.501) << i;
  }
  EXPECT_EQ(
      reduction_notes("panorama", {"tif", "png"}, 20000, 8000),
      (std::vector<std::string>{"panorama.png is 6667 × 2667 pixels, the picture reduced by 3"}));
  EXPECT_TRUE(reduction_notes("panorama", {"tif", "png"}, 8000, 8000).empty());
}

TEST(PictureFiles, OnlyTheFormatsAskedForAreWritten) {
  const Folder folder("formats");
  const Image linear = random_picture(20, 10);
  test::write_pictures(folder / "p", {"png"}, linear);
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"p.png"}));
  const Error error = test::error_of([&] {
    test::write_pictures(folder / "q", {"exr", "gif"}, linear);
  });
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_THAT(error.found(), testing::HasSubstr("gif"));
  for (const std::string& extension : picture_extensions())
    EXPECT_THAT(error.allowed(), testing::HasSubstr(extension));
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"p.png"}))
      << "refused before anything is written";
}

TEST(PictureFiles, ThePrintersProfileIsForDeviceFormatsAlone) {
  const Folder folder("formats");
  const Image linear = random_picture(20, 10);
  const Grid<glm::vec3> display = to_display(linear, {});
  const std::vector<std::uint8_t> printer = printer_profile();
  test::write_pictures(folder / "p", picture_extensions(), linear,
                       {.display = {}, .device_profile = printer});
  const Grid<glm::vec3> printed = ProfileConversion(printer).convert(display);
  for (const PictureFormat& format : picture_formats()) {
    if (format.open == nullptr) continue;
    SCOPED_TRACE(format.title);
    const std::string path = folder / ("p." + std::string(format.extension));
    const Grid<glm::vec3> again = read_picture(path);
    const Grid<glm::vec3>& expected = format.linear ? linear : format.device ? printed : display;
    for (std::size_t i = 0; i < again.size(); ++i)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(again[i][c], expected[i][c], 0.003);
    const std::vector<std::uint8_t> profile = format.device    ? printer
                                              : format.profile ? srgb_profile()
                                                               : std::vector<std::uint8_t>{};
    EXPECT_EQ(read_image_info(path).icc_profile, profile);
  }
}

TEST(PictureFiles, AFullDiskForOneKeepsTheOldFilesOfAll) {
  const Folder folder("full");
  const Image linear = random_picture(200, 150);
  const std::vector<std::string> extensions = picture_extensions();
  test::write_pictures(folder / "whole", extensions, linear);
  std::uintmax_t largest = 0;
  std::uintmax_t smallest = ~std::uintmax_t{0};
  for (const std::string& extension : extensions) {
    const std::uintmax_t size = std::filesystem::file_size(folder / ("whole." + extension));
    largest = std::max(largest, size);
    smallest = std::min(smallest, size);
    folder.write("p." + extension, "old");
  }
  EXPECT_LT(smallest, largest) << "else no limit lets some pass and others not";
  const std::map<std::string, std::string> before = contents_of(folder);
  std::vector<std::uintmax_t> limits{0, smallest, largest - 1};
  for (int i = 1; i < 16; ++i) limits.push_back(largest * static_cast<std::uintmax_t>(i) / 16);
  for (const std::uintmax_t limit : limits) {
    {
      const test::SmallDisk disk(static_cast<rlim_t>(limit));
      test::message_of(ErrorKind::output,
                       [&] { write_in_rows(folder / "p", extensions, linear, {}, 7); });
    }
    EXPECT_TRUE(contents_of(folder) == before) << limit;
  }
  const test::SmallDisk disk(static_cast<rlim_t>(largest));
  EXPECT_NO_THROW(test::write_pictures(folder / "p", extensions, linear)) << "just large enough";
}

TEST(PictureFiles, NothingIsReplacedBeforeAllCanBe) {
  const Folder folder("together");
  folder.write("p.tif", "old");
  folder.write("p.exr/file", "a folder of that name");
  const Image linear = random_picture(20, 10);
  EXPECT_THAT(test::message_of(ErrorKind::output,
                               [&] {
                                 test::write_pictures(folder / "p", {"tif", "exr"}, linear);
                               }),
              testing::HasSubstr("p.exr"));
  EXPECT_EQ(test::read_bytes(folder / "p.tif"), "old");
  testing::internal::CaptureStderr();
  for (const int rows : {0, 9, 150}) {
    PictureFiles files(folder / "p", {"tif", "png"}, 20, 300, {}, 300.0, {});
    files.write_rows(Image(20, rows));  // and then the run ends
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "the library never prints";
  EXPECT_EQ(test::read_bytes(folder / "p.tif"), "old");
  EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"p.exr", "p.tif"}))
      << "no temporary file stays";
}

TEST(PictureFiles, RefusesRowsThatDoNotFit) {
  const Folder folder("rows");
  for (const std::string& extension : picture_extensions()) {
    PictureFiles files(folder / "p", {extension}, 20, 10, {}, 300.0, {});
    files.write_rows(Image(20, 6));
    EXPECT_THAT(test::message_of(ErrorKind::bug, [&] { files.write_rows(Image(19, 1)); }),
                testing::HasSubstr("19 × 1"));
    EXPECT_THAT(test::message_of(ErrorKind::bug, [&] { files.write_rows(Image(20, 5)); }),
                testing::HasSubstr("after row 6"));
    EXPECT_THAT(test::message_of(ErrorKind::bug, [&] { files.finish(); }),
                testing::HasSubstr("row 6 of 10"));
  }
  EXPECT_EQ(folder.count(), 0U);
}

TEST(PictureFiles, WhatIsPackedWholeIsRefusedOverTheBudget) {
  const Folder folder("budget");
  const MemoryLimit limit(std::uint64_t{8} << 20);
  test::message_of(ErrorKind::limit, [&] {
    PictureFiles(folder / "p", {"exr", "jxl"}, 400, 300, {}, 300.0, {});
  });
  EXPECT_EQ(folder.count(), 0U);
  EXPECT_NO_THROW(PictureFiles(folder / "p", {"exr", "jxl"}, 200, 300, {}, 300.0, {}));
}

// A figure of /proc/self/status in bytes, 0 where there is none.
double status(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":")) return 1024.0 * std::stod(line.substr(name.size() + 1));
  return 0.0;
}

double peak_of(const std::string& stem, int height) {
  constexpr int width = 600;
  constexpr int step = 50;
  Image rows(width, step);
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = glm::vec3(static_cast<float>(i % 97) / 97.0F);
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak
  const double before = status("VmRSS");
  PictureFiles files(stem, {"tif", "png", "exr"}, width, height, {}, 300.0, {});
  for (int y = 0; y < height; y += step) files.write_rows(rows);
  files.finish();
  return status("VmHWM") - before;
}

TEST(PictureFiles, MemoryDoesNotGrowWithTheHeight) {
#ifdef BELVEDERE_SANITIZED
  GTEST_SKIP() << "sanitizers keep freed memory";
#endif
  if (status("VmHWM") == 0.0 || !std::ofstream("/proc/self/clear_refs"))
    GTEST_SKIP() << "no /proc/self to ask";
  const Folder folder("memory");
  mallopt(M_MMAP_THRESHOLD, 1 << 16);  // freed arrays go back to the system at once
  peak_of(folder / "first", 1000);     // what libraries keep once they have it
  const double small = peak_of(folder / "p", 1000);
  const double large = peak_of(folder / "p", 13000);
  // The PNG, reduced to 8 bits and a quarter of the pixels, would be the minimum that anything
  // could hold: .75 bytes per pixel.
  EXPECT_LT((large - small) / (600.0 * 12000.0), 0.4) << small << " " << large;
  EXPECT_GT(large, 1e6) << "nothing was measured";
}

}  // namespace
}  // namespace belvedere
