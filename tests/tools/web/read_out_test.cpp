#include "tools/web/read_out.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/text/base64.h"
#include "renderer/image/guidance_io.h"
#include "terrain/io/crs.h"
#include "tests/files.h"

namespace belvedere::tools {
namespace {

using testing::HasSubstr;

constexpr int sheet_width = 90;
constexpr int sheet_height = 70;  // more than a row of tiles
const glm::dvec3 sheet_origin(680000.0, 5250000.0, 0.0);

// Sky above row 10, below it ground whose numbers are its pixel.
GuidanceBuffers guidance() {
  GuidanceBuffers out;
  out.origin_m = sheet_origin;
  out.depth_m = Grid<float>(sheet_width, sheet_height, std::numeric_limits<float>::infinity());
  out.altitude_m = Grid<float>(sheet_width, sheet_height);
  out.position_m = Grid<glm::vec3>(sheet_width, sheet_height);
  out.land_cover = Grid<LandCoverClass>(sheet_width, sheet_height, LandCoverClass::sky);
  for (int y = 10; y < sheet_height; ++y)
    for (int x = 0; x < sheet_width; ++x) {
      out.depth_m(x, y) = static_cast<float>(100 * y);
      out.altitude_m(x, y) = static_cast<float>(1000 + x);
      out.position_m(x, y) = {10.F * static_cast<float>(x),
                              10.F * static_cast<float>(sheet_height - y), 0.F};
      out.land_cover(x, y) = x < 40 ? LandCoverClass::forest : LandCoverClass::rock;
    }
  return out;
}

TEST(ReadOut, IsTheMiddleOfSquaresOfPixels) {
  const test::Folder folder;
  write_guidance(folder / "g.exr", guidance(), {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut whole = sample_read_out(folder / "g.exr", sheet_width * sheet_height);
  EXPECT_EQ(whole.step_px, 1);
  EXPECT_EQ(whole.altitude_m(33, 60), 1033.F);
  const ReadOut out = sample_read_out(folder / "g.exr", 800);
  ASSERT_EQ(out.step_px, 3);
  ASSERT_EQ(out.distance_m.width(), 30);
  ASSERT_EQ(out.distance_m.height(), 24);
  for (int row = 0; row < 24; ++row)
    for (int column = 0; column < 30; ++column) {
      const int x = std::min(3 * column + 1, sheet_width - 1);
      const int y = std::min(3 * row + 1, sheet_height - 1);
      ASSERT_EQ(std::isinf(out.distance_m(column, row)), y < 10);
      if (y < 10) continue;
      ASSERT_EQ(out.distance_m(column, row), static_cast<float>(100 * y));
      ASSERT_EQ(out.altitude_m(column, row), static_cast<float>(1000 + x));
      ASSERT_EQ(out.class_id(column, row),
                static_cast<float>(x < 40 ? LandCoverClass::forest : LandCoverClass::rock));
      const glm::dvec2 position =
          transform_point("EPSG:32632", "EPSG:4326",
                          glm::dvec2(sheet_origin) + 10.0 * glm::dvec2(x, sheet_height - y));
      ASSERT_NEAR(out.longitude_deg(column, row), position.x, 1e-6);
      ASSERT_NEAR(out.latitude_deg(column, row), position.y, 1e-6);
    }
  EXPECT_THAT(read_out_script(out), HasSubstr("\"longitude\""));
}

// The value after a key of a script, from `from` on.
std::string_view behind(std::string_view script, std::string_view key, std::size_t from = 0) {
  const std::string quoted = "\"" + std::string(key) + "\": ";
  const std::size_t at = script.find(quoted, from);
  return at == std::string_view::npos ? std::string_view() : script.substr(at + quoted.size());
}
std::string bytes_behind(std::string_view script, std::string_view key, std::size_t from = 0) {
  const std::string_view text = behind(script, key, from);
  return text.empty() ? "" : base64_bytes(text.substr(1, text.find('"', 1) - 1)).value_or("");
}
int whole_of(const std::string& bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[2 * i]) +
         256 * static_cast<unsigned char>(bytes[2 * i + 1]);
}

// Data of the page: classes of a byte, the rest as steps of two bytes, low byte first.
TEST(ReadOut, TheScriptsNumbersAreThoseOfThePicture) {
  const test::Folder folder;
  write_guidance(folder / "g.exr", guidance(), {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut out = sample_read_out(folder / "g.exr", 800);
  const std::string script = read_out_script(out);
  const std::string classes = bytes_behind(script, "classes");
  const std::string altitudes = bytes_behind(script, "altitudes");
  const std::string distances = bytes_behind(script, "distances");
  const std::size_t cells = out.distance_m.size();
  ASSERT_EQ(classes.size(), cells);
  ASSERT_EQ(altitudes.size(), 2 * cells);
  ASSERT_EQ(distances.size(), 2 * cells);
  const double altitude_from = std::strtod(behind(script, "altitudeFrom").data(), nullptr);
  const double distance_step = std::strtod(behind(script, "distanceStep").data(), nullptr);
  const std::size_t longitude = script.find("\"longitude\"");
  const std::string degrees = bytes_behind(script, "values", longitude);
  ASSERT_EQ(degrees.size(), 2 * cells);
  const double west = std::strtod(behind(script, "from", longitude).data(), nullptr);
  const double east = std::strtod(behind(script, "to", longitude).data(), nullptr);
  for (std::size_t i = 0; i < cells; ++i) {
    if (std::isinf(out.distance_m[i])) {
      ASSERT_EQ(static_cast<unsigned char>(classes[i]), 255);
      ASSERT_EQ(whole_of(distances, i), 65535);
      continue;
    }
    ASSERT_EQ(static_cast<unsigned char>(classes[i]), static_cast<int>(out.class_id[i]));
    ASSERT_NEAR(altitude_from + whole_of(altitudes, i), out.altitude_m[i], 0.5);
    ASSERT_NEAR(distance_step * whole_of(distances, i), out.distance_m[i], 0.5 * distance_step);
    ASSERT_NEAR(west + (east - west) * whole_of(degrees, i) / 65535.0, out.longitude_deg[i], 1e-6);
  }
}

// Sky takes the place of the origin, which is none of its own, and ground of the first pixel its
// own.
TEST(ReadOut, TheFirstPixelHasItsPlace) {
  const test::Folder folder;
  GuidanceBuffers ground = guidance();
  ground.depth_m(0, 0) = 700.F;
  ground.position_m(0, 0) = {300.F, 400.F, 0.F};
  ground.land_cover(0, 0) = LandCoverClass::rock;
  write_guidance(folder / "g.exr", ground, {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut out = sample_read_out(folder / "g.exr", sheet_width * sheet_height);
  const glm::dvec2 first = transform_point("EPSG:32632", "EPSG:4326",
                                           glm::dvec2(sheet_origin) + glm::dvec2(300.0, 400.0));
  const glm::dvec2 origin = transform_point("EPSG:32632", "EPSG:4326", glm::dvec2(sheet_origin));
  EXPECT_NEAR(out.longitude_deg(0, 0), first.x, 1e-6);
  EXPECT_NEAR(out.latitude_deg(0, 0), first.y, 1e-6);
  EXPECT_NEAR(out.longitude_deg(1, 0), origin.x, 1e-6);
  EXPECT_NEAR(out.latitude_deg(1, 0), origin.y, 1e-6);
}

// The only ground is the last pixel: the script's scale is its longitude.
TEST(ReadOut, TheLastPixelCountsForTheExtent) {
  const test::Folder folder;
  GuidanceBuffers ground = guidance();
  for (float& depth : ground.depth_m) depth = std::numeric_limits<float>::infinity();
  ground.depth_m(sheet_width - 1, sheet_height - 1) = 700.F;
  write_guidance(folder / "g.exr", ground, {{"belvedere:crs", "EPSG:32632"}});
  const ReadOut out = sample_read_out(folder / "g.exr", sheet_width * sheet_height);
  const std::string script = read_out_script(out);
  const std::size_t longitude = script.find("\"longitude\"");
  EXPECT_NEAR(std::strtod(behind(script, "from", longitude).data(), nullptr),
              out.longitude_deg(sheet_width - 1, sheet_height - 1), 1e-6);
}

TEST(ReadOut, WithoutASystemThereAreNoPlaces) {
  const test::Folder folder;
  write_guidance(folder / "g.exr", guidance(), {{"belvedere:crs", "none"}});
  const ReadOut out = sample_read_out(folder / "g.exr", 800);
  EXPECT_FALSE(out.has_places);
  EXPECT_THAT(read_out_script(out), Not(HasSubstr("longitude")));
  GuidanceBuffers bare;
  bare.altitude_m = guidance().altitude_m;
  write_guidance(folder / "bare.exr", bare, {});
  EXPECT_THAT(
      test::message_of(ErrorKind::input, [&] { sample_read_out(folder / "bare.exr", 800); }),
      HasSubstr("no distances"));
}

}  // namespace
}  // namespace belvedere::tools
