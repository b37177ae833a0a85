#include "renderer/image/exr/compositing_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "renderer/image/image_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

std::uint32_t bits_of(const char* name) {
  return std::bit_cast<std::uint32_t>(cryptomatte_id(name));
}

// Published values of MurmurHash3_x86_32 with seed 0.
TEST(Cryptomatte, HashIsMurmurHash3) {
  EXPECT_EQ(murmur_hash3(""), 0U);
  EXPECT_EQ(murmur_hash3("test"), 0xba6bd213U);
  EXPECT_EQ(murmur_hash3("Hello, world!"), 0xc0363e43U);
  EXPECT_EQ(murmur_hash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
}

// Ids of the sample files of the specification.
TEST(Cryptomatte, IdsAreThoseOfTheSpecification) {
  EXPECT_EQ(bits_of("bunny"), 0x13851a76U);
  EXPECT_EQ(bits_of("default"), 0x42c9679fU);
}

// 0x8047664c would be subnormal, 0xffa5d8d1 no number: only their exponents change.
TEST(Cryptomatte, EveryIdIsANumber) {
  EXPECT_EQ(murmur_hash3("class138"), 0x8047664cU);
  EXPECT_EQ(bits_of("class138"), 0x80c7664cU);
  EXPECT_EQ(murmur_hash3("class190"), 0xffa5d8d1U);
  EXPECT_EQ(bits_of("class190"), 0xff25d8d1U);
  EXPECT_TRUE(std::isnormal(cryptomatte_id("")));
}

TEST(Cryptomatte, NotesNameTheLayerByItsHash) {
  const FileNotes notes = cryptomatte_notes("ViewLayer.CryptoLandCover", {"sky", "a \"b\""});
  EXPECT_EQ(notes.size(), 4U);
  EXPECT_EQ(notes.at("cryptomatte/c8b75a6/name"), "ViewLayer.CryptoLandCover");
  EXPECT_EQ(notes.at("cryptomatte/c8b75a6/hash"), "MurmurHash3_32");
  EXPECT_EQ(notes.at("cryptomatte/c8b75a6/conversion"), "uint32_to_float32");
  EXPECT_THAT(notes.at("cryptomatte/c8b75a6/manifest"),
              testing::StartsWith("{\"sky\":\"d12be799\",\"a \\\"b\\\"\":\""));
  EXPECT_EQ(cryptomatte_notes("x", {}).begin()->first.size(),
            std::string("cryptomatte/0123456/conversion").size());
}

// Forest in front, sky that shows a little terrain, rock that shows more sky than ground; in rows
// that repeat.
struct Passes {
  explicit Passes(int height = 1) : picture(3, height), matte(3, height) {
    guidance.depth_m = Grid<float>(3, height);
    guidance.coverage = guidance.shadow = guidance.sky_view = guidance.depth_m;
    guidance.position_m = guidance.normal = Grid<glm::vec3>(3, height);
    guidance.land_cover = Grid<LandCoverClass>(3, height);
    for (int y = 0; y < height; ++y) {
      const float depth_m[] = {100.F, std::numeric_limits<float>::infinity(), 50.F};
      const float coverage[] = {1.F, 0.25F, 0.375F};
      const LandCoverClass land_cover[] = {LandCoverClass::forest, LandCoverClass::sky,
                                           LandCoverClass::rock};
      for (int x = 0; x < 3; ++x) {
        guidance.depth_m(x, y) = depth_m[x];
        guidance.coverage(x, y) = coverage[x];
        guidance.land_cover(x, y) = land_cover[x];
        guidance.position_m(x, y) = {1.5F, 2.5F, static_cast<float>(x)};
        guidance.normal(x, y) = {0.F, 0.F, 1.F};
        guidance.shadow(x, y) = 0.5F;
        guidance.sky_view(x, y) = 0.25F;
        picture(x, y) = {0.125F, 0.25F, static_cast<float>(x + y)};
      }
      matte(0, y) = {{1, 2}, {51, 204}};
    }
  }
  void write(const std::string& path, int rows) const {
    CompositingWriter writer(path, 3, picture.height(), {"road", "lift"}, {{"origin", "7 8 9"}});
    for (int y = 0; y < picture.height(); y += rows) {
      const PixelRect band{0, y, 3, std::min(y + rows, picture.height())};
      GuidanceBuffers part;
      part.depth_m = part_of(guidance.depth_m, band);
      part.coverage = part_of(guidance.coverage, band);
      part.shadow = part_of(guidance.shadow, band);
      part.sky_view = part_of(guidance.sky_view, band);
      part.position_m = part_of(guidance.position_m, band);
      part.normal = part_of(guidance.normal, band);
      part.land_cover = part_of(guidance.land_cover, band);
      writer.write_rows({part, part_of(picture, band), part_of(matte, band)}, y);
    }
    writer.complete();
    writer.commit();
  }

  GuidanceBuffers guidance;
  Image picture;
  Grid<MattePixel> matte;
};

class CompositingFile : public testing::Test {
 protected:
  float at(const std::string& channel, int x, int y = 0) const {
    return read_channel(path_, "ViewLayer." + channel)(x, y);
  }
  test::Folder folder_;
  const std::string path_ = folder_ / "a.exr";
};

TEST_F(CompositingFile, PassesAreNamedAndMeantAsInBlender) {
  Passes().write(path_, 64);
  EXPECT_EQ(at("Combined.R", 2), 0.125F);
  EXPECT_EQ(at("Combined.G", 2), 0.25F);
  EXPECT_EQ(at("Combined.B", 2), 2.F);
  EXPECT_EQ(at("Combined.A", 1), 1.F);
  EXPECT_EQ(at("Depth.Z", 0), 100.F);
  EXPECT_EQ(at("Depth.Z", 1), 1e10F) << "sky, as Blender has it";
  EXPECT_EQ(at("Position.Y", 0), 2.5F);
  EXPECT_EQ(at("Position.Z", 2), 2.F);
  EXPECT_EQ(at("Normal.Z", 0), 1.F);
  EXPECT_EQ(at("Normal.Z", 1), 0.F) << "sky";
  EXPECT_EQ(at("Shadow.B", 0), 0.5F);
  EXPECT_EQ(at("AO.G", 0), 0.25F);
  EXPECT_EQ(at("IndexMA.X", 0), 4.F) << "forest";
  const ImageInfo info = read_image_info(path_);
  EXPECT_EQ(info.parts.size(), 1U);
  EXPECT_EQ(info.notes.at("origin"), "7 8 9");
  EXPECT_EQ(info.notes.at("cryptomatte/c8b75a6/name"), "ViewLayer.CryptoLandCover");
  EXPECT_EQ(info.notes.at("cryptomatte/73bc914/manifest"),
            "{\"road\":\"c9fb4202\",\"lift\":\"36c21d60\"}");
}

TEST_F(CompositingFile, MattesRankWhatCoversMost) {
  Passes().write(path_, 64);
  const auto ranks = [&](const std::string& layer, int x) {
    return std::vector<float>{at(layer + "00.r", x), at(layer + "00.g", x), at(layer + "00.b", x),
                              at(layer + "00.a", x)};
  };
  const auto id = [](const char* name) { return cryptomatte_id(name); };
  using Ranks = std::vector<float>;
  EXPECT_EQ(ranks("CryptoLandCover", 0), (Ranks{id("forest"), 1.F, 0.F, 0.F}));
  EXPECT_EQ(ranks("CryptoLandCover", 1), (Ranks{id("sky"), 0.75F, 0.F, 0.F}));
  EXPECT_EQ(ranks("CryptoLandCover", 2), (Ranks{id("sky"), 0.625F, id("rock"), 0.375F}));
  EXPECT_EQ(ranks("CryptoFeature", 0),
            (Ranks{id("lift"), 204.F / 255.F, id("road"), 51.F / 255.F}));
  EXPECT_EQ(ranks("CryptoFeature", 1), (Ranks{0.F, 0.F, 0.F, 0.F}));
}

TEST_F(CompositingFile, SameBytesForAnyThreadsAndBands) {
  const Passes passes(150);
  passes.write(path_, 64);
  const ThreadLimit one(1);
  passes.write(folder_ / "b.exr", 128);
  EXPECT_EQ(test::read_bytes(path_), test::read_bytes(folder_ / "b.exr"));
}

}  // namespace
}  // namespace belvedere
