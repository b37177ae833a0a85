// Layers in linear light, read by OpenImageIO and composited as compositors do.
#include "renderer/image/exr/layered_exr.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/image/srgb.h"
#include "tests/files.h"

namespace belvedere {
namespace {

constexpr int width = 70;
constexpr int height = 150;  // two bands and a piece of one

// Opaque, half covering and empty pixels; the last is hidden.
Grid<LayerPixel> layer(int number) {
  Grid<LayerPixel> out(width, height, LayerPixel{});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double kind = random_uniform(5, x, y, static_cast<std::uint64_t>(10 * number));
      if (number > 0 && kind < 0.3) continue;
      for (std::uint64_t c = 0; c < 4; ++c)
        out(x, y)[c] = static_cast<std::uint16_t>(
            65535.0 * random_uniform(5, x, y, static_cast<std::uint64_t>(10 * number) + 1 + c));
      if (number == 0 || kind > 0.8) out(x, y)[3] = 65535;
    }
  return out;
}

struct Stack {
  std::vector<Grid<LayerPixel>> layers;
  Grid<LayerPixel> merged{width, height};
  LayeredSheet sheet{width, height, 300.0, {}, {}};
  Stack() {
    for (int k = 0; k < 5; ++k) layers.push_back(layer(k));
    for (std::size_t i = 0; i < merged.size(); ++i) {
      merged[i][3] = 65535;
      for (std::size_t c = 0; c < 3; ++c) {
        double flat = 0.0;
        for (std::size_t k = 0; k < 4; ++k)
          flat += layers[k][i][3] / 65535.0 * (layers[k][i][c] - flat);
        merged[i][c] = static_cast<std::uint16_t>(std::lround(flat));
      }
    }
    for (std::size_t k = 0; k < 5; ++k)
      sheet.layers.push_back({"layer" + std::to_string(k), "Layer", k == 4, rows_of(layers[k])});
    sheet.merged = rows_of(merged);
  }
  static LayerRows rows_of(const Grid<LayerPixel>& from) {
    return [&from](int y0, int y1) {
      Grid<LayerPixel> rows(width, y1 - y0);
      std::copy(from.row(y0), from.row(y0) + rows.size(), rows.data());
      return rows;
    };
  }
};

std::vector<float> part_of_file(const std::string& file, int part, int channels) {
  const auto input = OIIO::ImageInput::open(file);
  EXPECT_TRUE(input) << OIIO::geterror();
  if (!input || !input->seek_subimage(part, 0)) return {};
  const OIIO::ImageSpec spec = input->spec(part);
  EXPECT_EQ(spec.nchannels, channels);
  std::vector<float> out(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  EXPECT_TRUE(input->read_image(part, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, out.data()));
  return out;
}

TEST(LayeredExr, LayersOverEachOtherInLinearLightAreThePanorama) {
  const test::Folder folder;
  const Stack stack;
  Progress progress;
  write_layered_exr(folder / "a.exr", stack.sheet, progress);
  const std::vector<float> panorama = part_of_file(folder / "a.exr", 0, 3);
  std::vector<double> flat(panorama.size());
  double negative = 0.0;
  for (int k = 0; k < 4; ++k) {
    const std::vector<float> one = part_of_file(folder / "a.exr", 1 + k, 4);
    for (std::size_t i = 0; i < stack.merged.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        flat[3 * i + c] = one[4 * i + c] + (1.0 - one[4 * i + 3]) * flat[3 * i + c];
        negative = std::min(negative, static_cast<double>(one[4 * i + c]));
      }
  }
  for (std::size_t i = 0; i < stack.merged.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double wanted = srgb_decoded(stack.merged[i][c] / 65535.0);
      ASSERT_NEAR(panorama[3 * i + c], wanted, 1e-7 + wanted / 2048.0) << i;
      // The last of the layers is rounded to a half, and merged to a step of 65535.
      ASSERT_NEAR(flat[3 * i + c], wanted, 2e-5 + 1.0 / 4096.0) << i;
      ASSERT_NEAR(srgb_encoded(std::max(0.0, flat[3 * i + c])) * 255.0, stack.merged[i][c] / 257.0,
                  0.5)
          << i;
    }
  EXPECT_LT(negative, -1e-3)
      << "what mixing in encoded sRGB needs where paint is darker than its ground";
}

TEST(LayeredExr, PartsHaveNamesAndHiddenOnesTheirOwnColours) {
  const test::Folder folder;
  const Stack stack;
  Progress progress;
  write_layered_exr(folder / "a.exr", stack.sheet, progress);
  write_layered_exr(folder / "b.exr", stack.sheet, progress);
  EXPECT_EQ(test::read_bytes(folder / "a.exr"), test::read_bytes(folder / "b.exr"));
  EXPECT_EQ(folder.count(), 2U) << "nothing else is left";
  const ImageInfo info = read_image_info(folder / "a.exr");
  ASSERT_EQ(info.parts.size(), 6U);
  EXPECT_EQ(info.parts[0].name, "panorama");
  EXPECT_EQ(info.parts[3].name, "layer2");
  const auto input = OIIO::ImageInput::open(folder / "a.exr");
  EXPECT_EQ(input->spec(5).get_string_attribute("hidden"), "1");
  EXPECT_EQ(input->spec(4).get_string_attribute("hidden"), "");
  EXPECT_EQ(input->spec(2).get_string_attribute("title"), "Layer");
  const std::vector<float> hidden = part_of_file(folder / "a.exr", 5, 4);
  for (std::size_t i = 0; i < stack.merged.size(); ++i) {
    const LayerPixel& pixel = stack.layers[4][i];
    ASSERT_NEAR(hidden[4 * i + 3], pixel[3] / 65535.0, 5e-4);
    ASSERT_NEAR(hidden[4 * i], pixel[3] / 65535.0 * srgb_decoded(pixel[0] / 65535.0), 5e-4);
  }
}

}  // namespace
}  // namespace belvedere
