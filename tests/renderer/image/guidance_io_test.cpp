#include "renderer/image/guidance_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "tests/renderer/image/picture_bytes.h"

namespace belvedere {
namespace {

using test::Folder;

float uniform(int x, int y, std::uint64_t draw, double low, double high) {
  return static_cast<float>(low + (high - low) * random_uniform(3, x, y, draw));
}

GuidanceBuffers make_guidance(int width, int height) {
  GuidanceBuffers g;
  std::uint64_t draw = 0;
  const auto numbers = [&](Grid<float>& grid, double low, double high) {
    grid = Grid<float>(width, height);
    ++draw;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) grid(x, y) = uniform(x, y, draw, low, high);
    }
  };
  const auto vectors = [&](Grid<glm::vec3>& grid, double low, double high, bool unit) {
    grid = Grid<glm::vec3>(width, height);
    draw += 3;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        glm::vec3 v(uniform(x, y, draw, low, high), uniform(x, y, draw + 1, low, high), uniform(x, y, draw + 2, low, high));
        if (unit) v = glm::normalize(v + glm::vec3(0.0f, 0.0f, 2.0f));
        grid(x, y) = v;
      }
    }
    draw += 3;
  };
  numbers(g.depth_m, 100, 1e5);
  vectors(g.position_m, -60000, 60000, false);
  vectors(g.normal, -1, 1, true);
  vectors(g.normal_detail, -1, 1, true);
  vectors(g.normal_smooth, -1, 1, true);
  numbers(g.altitude_m, 0, 4000);
  numbers(g.coverage, 0, 1);
  numbers(g.front, 0, 1);
  numbers(g.silhouette, 0, 1);
  numbers(g.shadow, 0, 1);
  numbers(g.sky_view, 0, 1);
  numbers(g.slope_deg, 0, 90);
  numbers(g.aspect_deg, 0, 360);
  numbers(g.footprint_m, 1, 500);
  numbers(g.ridge, -1, 1);
  numbers(g.relief_s_m, -300, 300);
  numbers(g.relief_m_m, -600, 600);
  numbers(g.relief_l_m, -900, 900);
  numbers(g.valley_height_m, 0, 2000);
  numbers(g.tone, 0, 1);
  numbers(g.built, 0, 1);
  vectors(g.base, 0, 1, false);
  g.land_cover = Grid<LandCoverClass>(width, height);
  g.fall_line = g.grain = Grid<glm::vec2>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      g.land_cover(x, y) = static_cast<LandCoverClass>((x + y) % land_cover_class_count);
      const float angle = uniform(x, y, 99, 0, 6.28);
      if (x != 1) g.fall_line(x, y) = {std::cos(angle), std::sin(angle)};
      g.grain(x, y) = glm::vec2(uniform(x, y, 97, -1, 1), uniform(x, y, 98, -1, 1));
      if (y == 0) g.depth_m(x, y) = std::numeric_limits<float>::infinity();
    }
  }
  return g;
}

// Half keeps 11 bits: a relative error of 2^-11 at most, half of that when rounded.
void expect_near(const Grid<float>& a, const Grid<float>& b, double relative, const char* name) {
  ASSERT_TRUE(a.same_size(b)) << name;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;  // infinity too
    ASSERT_NEAR(a[i], b[i], relative * std::abs(static_cast<double>(a[i])) + 1e-7) << name << " " << i;
  }
}

template <class V>
void expect_near(const Grid<V>& a, const Grid<V>& b, double absolute, const char* name) {
  ASSERT_TRUE(a.same_size(b)) << name;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < V::length(); ++c) ASSERT_NEAR(a[i][c], b[i][c], absolute) << name << " " << i;
  }
}

TEST(GuidanceIo, RoundTrip) {
  const Folder folder("guidance");
  const GuidanceBuffers g = make_guidance(100, 150);
  write_guidance(folder / "g.exr", g, {{"camera", "perspective"}});
  const GuidanceBuffers r = read_guidance(folder / "g.exr");
  EXPECT_EQ(r.depth_m, g.depth_m);
  EXPECT_EQ(r.position_m, g.position_m);
  EXPECT_EQ(r.altitude_m, g.altitude_m);
  EXPECT_EQ(r.footprint_m, g.footprint_m);
  EXPECT_EQ(r.land_cover, g.land_cover);
  constexpr double half = 0x1p-11;
  expect_near(g.coverage, r.coverage, half, "coverage");
  expect_near(g.front, r.front, half, "front");
  expect_near(g.silhouette, r.silhouette, half, "silhouette");
  expect_near(g.shadow, r.shadow, half, "shadow");
  expect_near(g.sky_view, r.sky_view, half, "sky_view");
  expect_near(g.slope_deg, r.slope_deg, half, "slope");
  expect_near(g.aspect_deg, r.aspect_deg, half, "aspect");
  expect_near(g.ridge, r.ridge, half, "ridge");
  expect_near(g.relief_s_m, r.relief_s_m, half, "relief_s");
  expect_near(g.relief_m_m, r.relief_m_m, half, "relief_m");
  expect_near(g.relief_l_m, r.relief_l_m, half, "relief_l");
  expect_near(g.valley_height_m, r.valley_height_m, half, "valley_height");
  expect_near(g.tone, r.tone, half, "tone");
  expect_near(g.base, r.base, half, "base");
  expect_near(g.normal, r.normal, half, "normal");
  expect_near(g.normal_detail, r.normal_detail, half, "normal_detail");
  expect_near(g.normal_smooth, r.normal_smooth, half, "normal_smooth");
  expect_near(g.built, r.built, half, "built");
  expect_near(g.grain, r.grain, half, "grain");
  expect_near(g.fall_line, r.fall_line, half, "fall_line");
  for (const glm::vec3& normal : r.normal) ASSERT_NEAR(glm::length(normal), 1.0, 1e-6);
  EXPECT_EQ(r.fall_line(1, 5), glm::vec2(0.0f)) << "flat ground has no direction";
}

TEST(GuidanceIo, HeaderNamesChannelsTypesAndClasses) {
  const Folder folder("guidance");
  write_guidance(folder / "g.exr", make_guidance(10, 10), {{"camera", "perspective"}});
  const ImageInfo info = read_image_info(folder / "g.exr");
  std::map<std::string, ChannelType> found;
  for (const PartSpec& part : info.parts) {
    for (const ChannelSpec& c : part.channels) found[c.name] = c.type;
  }
  std::map<std::string, ChannelType> wanted;
  for (const char* name : {"Z", "P.X", "P.Y", "P.Z", "altitude.V", "footprint.V"}) wanted[name] = ChannelType::float32;
  for (const char* name :
       {"N.X",      "N.Y",          "N.Z",      "Nd.X",      "Nd.Y",    "Nd.Z",     "Ns.X",       "Ns.Y",       "Ns.Z",    "coverage.A",
        "front.A",  "silhouette.V", "shadow.V", "skyview.V", "slope.V", "aspect.V", "fallline.X", "fallline.Y", "ridge.V", "relief.S",
        "relief.M", "relief.L",     "valley.V", "built.V",   "grain.X", "grain.Y",  "tone.V",     "base.R",     "base.G",  "base.B"}) {
    wanted[name] = ChannelType::half;
  }
  wanted["landcover.id"] = ChannelType::uint32;
  EXPECT_EQ(found, wanted);
  EXPECT_EQ(info.notes.at("camera"), "perspective");
  EXPECT_THAT(info.notes.at("legend"), testing::HasSubstr("\n4 forest 1e5a28\n"));
}

TEST(GuidanceIo, StreamedIsTheSameFile) {
  const Folder folder("guidance");
  const GuidanceBuffers g = make_guidance(70, 200);
  write_guidance(folder / "whole.exr", g, {});
  GuidanceWriter writer(folder / "streamed.exr", 70, 200, {});
  writer.write_rows(g, 0, 128, 0);
  // The rest comes from buffers with a margin of their own.
  GuidanceBuffers lower = make_guidance(70, 200);
  writer.write_rows(lower, 128, 72, 128);
  writer.finish();
  EXPECT_EQ(test::read_bytes(folder / "whole.exr"), test::read_bytes(folder / "streamed.exr"));
}

TEST(GuidanceIo, AbsentChannelsStayEmpty) {
  const Folder folder("guidance");
  GuidanceBuffers g;
  g.depth_m = Grid<float>(5, 4, 2.0f);
  g.tone = Grid<float>(5, 4, 0.5f);
  write_guidance(folder / "g.exr", g, {});
  const GuidanceBuffers r = read_guidance(folder / "g.exr");
  EXPECT_EQ(r.depth_m, g.depth_m);
  EXPECT_EQ(r.tone, g.tone);
  EXPECT_TRUE(r.land_cover.empty());
  EXPECT_TRUE(r.base.empty());
  EXPECT_TRUE(r.normal.empty());
}

TEST(GuidanceIo, RefusesWhatIsNone) {
  const Folder folder("guidance");
  const auto kind = [&](const std::string& name) {
    try {
      read_guidance(folder / name);
    } catch (const Error& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr(name));
      return e.kind();
    }
    return ErrorKind::bug;
  };
  write_exr(folder / "picture.exr", Image(3, 3), {});
  EXPECT_EQ(kind("picture.exr"), ErrorKind::input);
  EXPECT_EQ(kind("absent.exr"), ErrorKind::input);
  ExrWriter writer(folder / "id.exr", 2, 1, {{"class", {{"landcover.id", ChannelType::uint32}}}}, {});
  writer.write_rows(0, 0, 1, {std::bit_cast<float>(3u), std::bit_cast<float>(12u)});
  writer.finish();
  EXPECT_EQ(kind("id.exr"), ErrorKind::input);
}

TEST(GuidanceIo, ChannelsMustNotComeAndGo) {
  const Folder folder("guidance");
  GuidanceBuffers g = make_guidance(10, 128);
  GuidanceWriter writer(folder / "g.exr", 10, 128, {});
  writer.write_rows(g, 0, 64, 0);
  g.tone = {};
  EXPECT_THROW(writer.write_rows(g, 64, 64, 64), Error);
}

}  // namespace
}  // namespace belvedere
