#include "renderer/image/srgb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/image/icc/painting_file.h"
#include "renderer/image/image_io.h"
#include "tests/notes.h"
#include "tests/renderer/image/picture_bytes.h"

namespace belvedere {
namespace {

TEST(SrgbTable, IsTheCurveToWithinAFloat) {
  for (int k = 0; k <= 1000000; ++k) {
    const float encoded = static_cast<float>(k) * 1e-6F;
    const auto truth = static_cast<float>(srgb_decoded(static_cast<double>(encoded)));
    const float found = srgb_decoded_fast(encoded);
    ASSERT_GE(found, std::nextafter(truth, -1.F)) << encoded;
    ASSERT_LE(found, std::nextafter(truth, 2.F)) << encoded;
  }
}

TEST(SrgbTable, RisesThroughItsKnotsAndItsEnds) {
  EXPECT_EQ(srgb_decoded_fast(0.F), 0.F);
  EXPECT_EQ(srgb_decoded_fast(1.F), 1.F);
  float before = -1.F;
  for (int k = 0; k <= 4096; ++k) {
    const float next = srgb_decoded_fast(static_cast<float>(k) / 4096.F);
    EXPECT_GT(next, before) << k;
    before = next;
  }
}

TEST(SrgbTable, BeyondWhatFilesHoldItIsTheCurve) {
  for (const float encoded : {-0.25F, -1e-3F, 1.0001F, 1.7F})
    EXPECT_EQ(srgb_decoded_fast(encoded),
              static_cast<float>(srgb_decoded(static_cast<double>(encoded))))
        << encoded;
  EXPECT_TRUE(std::isnan(srgb_decoded_fast(std::nanf(""))));
}

// L*a*b* of the primaries of sRGB under D50, as colour tables print them.
struct Known {
  glm::dvec3 lab;
  glm::vec3 srgb;
};
const Known known[] = {{{100.0, 0.0, 0.0}, {1, 1, 1}},
                       {{0.0, 0.0, 0.0}, {0, 0, 0}},
                       {{53.585, 0.0, 0.0}, {0.50196F, 0.50196F, 0.50196F}},
                       {{54.29, 80.81, 69.89}, {1, 0, 0}},
                       {{87.82, -79.27, 80.99}, {0, 1, 0}},
                       {{29.57, 68.30, -112.03}, {0, 0, 1}}};

TEST(CieLab, PrimariesOfSrgb) {
  for (const Known& one : known)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(srgb_from_lab(one.lab)[c], one.srgb[c], 0.006F) << one.lab.x << ' ' << c;
}

// A TIFF of one row with these colours; samples are little-endian.
std::string lab_tiff(int bits, int photometric) {
  std::string row;
  for (const Known& one : known)
    for (int c = 0; c < 3; ++c) {
      const double step = bits == 8 ? 1.0 : 256.0;
      const bool icc = photometric == 9;
      const double white = icc && bits == 16 ? 65280.0 : 256.0 * step - 1.0;
      const double value =
          c == 0 ? one.lab.x / 100.0 * white : (one.lab[c] + (icc ? 128.0 : 0.0)) * step;
      row += test::little_endian(static_cast<std::uint64_t>(std::lround(value)), bits / 8);
    }
  std::string out = std::string("II*\0", 4) + test::little_endian(8, 4);
  const std::uint32_t data = 8 + 2 + 12 * 9 + 4 + 6;
  out += test::little_endian(9, 2);
  const auto entry = [&](int tag, int type, std::size_t count, std::size_t value) {
    out += test::little_endian(static_cast<std::uint64_t>(tag), 2) +
           test::little_endian(static_cast<std::uint64_t>(type), 2) +
           test::little_endian(count, 4) + test::little_endian(value, 4);
  };
  entry(256, 4, 1, std::size(known));
  entry(257, 4, 1, 1);
  entry(258, 3, 3, data - 6);
  entry(259, 3, 1, 1);
  entry(262, 3, 1, static_cast<std::size_t>(photometric));
  entry(273, 4, 1, data);
  entry(277, 3, 1, 3);
  entry(278, 4, 1, 1);
  entry(279, 4, 1, row.size());
  out += test::little_endian(0, 4);
  for (int c = 0; c < 3; ++c) out += test::little_endian(static_cast<std::uint64_t>(bits), 2);
  return out + row;
}

TEST(CieLab, TiffsOfLabAreReadInSrgb) {
  const test::Folder folder;
  for (const int bits : {8, 16})
    for (const int photometric : {8, 9}) {
      const std::string path = folder / "lab.tif";
      test::write_bytes(path, lab_tiff(bits, photometric));
      test::Notes notes;
      const Grid<glm::vec3> picture = read_painting(path, notes);
      EXPECT_THAT(notes.text(), testing::HasSubstr("CIE Lab"));
      ASSERT_EQ(picture.width(), static_cast<int>(std::size(known)));
      for (std::size_t i = 0; i < picture.size(); ++i)
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(picture[i][c], known[i].srgb[c], bits == 8 ? 0.05F : 0.006F)
              << bits << ' ' << photometric << ' ' << i << ' ' << c;
      EXPECT_EQ(read_picture(path), picture) << "every reader of pictures";
    }
  test::write_bytes(folder / "itu.tif", lab_tiff(8, 10));
  EXPECT_THAT(test::input_error([&] { read_picture(folder / "itu.tif"); }),
              testing::HasSubstr("Lab"));
}

}  // namespace
}  // namespace belvedere
