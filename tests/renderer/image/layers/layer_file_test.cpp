#include "renderer/image/layers/layer_file.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "renderer/image/image_io.h"
#include "renderer/image/srgb.h"
#include "tests/files.h"
#include "tests/grids.h"

// Files of layers, read by programs of other people: Python's zipfile, OpenImageIO, ImageMagick
// (OpenImageIO finds no layers of 16 bits in PSD).
// Layers in linear light, read by OpenImageIO and composited as compositors do.

namespace belvedere {
namespace {

using testing::HasSubstr;

Grid<LayerPixel> random_layer(int width, int height, int number) {
  Grid<LayerPixel> out(width, height, LayerPixel{});
  for (const auto [x, y] : test::cells(width, height))
    for (std::uint64_t c = 0; c < 4; ++c) {
      // Runs of equal bytes, noise, and nothing: all cases of PackBits.
      const double v = y % 3 == 0   ? random_uniform(3, x + 1000 * number, y, c)
                       : y % 3 == 1 ? 0.25 * (number % 4)
                                    : 0.0;
      out(x, y)[c] = static_cast<std::uint16_t>(v * 65535.0);
    }
  return out;
}

struct Sheet {
  std::vector<Grid<LayerPixel>> layers;
  Grid<LayerPixel> merged;
  LayeredSheet sheet;
  Sheet(int width, int height) {
    for (int k = 0; k < 3; ++k) layers.push_back(random_layer(width, height, k + 1));
    merged = random_layer(width, height, 9);
    sheet = {width, height, 300.0, {}, rows_of(merged)};
    sheet.layers = {{"one", "Ground & so", false, rows_of(layers[0])},
                    {"two", "Trees", false, rows_of(layers[1])},
                    {"three", "Mask", true, rows_of(layers[2])}};
  }
  static LayerRows rows_of(const Grid<LayerPixel>& layer) {
    return [&layer](int y0, int y1) {
      Grid<LayerPixel> rows(layer.width(), y1 - y0);
      std::copy(layer.row(y0), layer.row(y0) + rows.size(), rows.data());
      return rows;
    };
  }
};

// The numbers of one subimage as they stand in the file.
std::vector<std::uint16_t> numbers(const std::string& file, int subimage, int channels) {
  OIIO::ImageSpec settings;
  settings.attribute("oiio:UnassociatedAlpha", 1);
  settings.attribute("oiio:RawColor", 1);
  const auto input = OIIO::ImageInput::open(file, &settings);
  EXPECT_TRUE(input) << OIIO::geterror();
  if (!input || !input->seek_subimage(subimage, 0)) return {};
  const OIIO::ImageSpec spec = input->spec(subimage);
  EXPECT_EQ(spec.nchannels, channels);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT16);
  std::vector<std::uint16_t> out(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  EXPECT_TRUE(
      input->read_image(subimage, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, out.data()));
  return out;
}

// The same of a layer, by ImageMagick.
std::vector<std::uint16_t> magick_numbers(const test::Folder& folder, const std::string& file,
                                          int scene) {
  const std::string command = "cd " + folder.path() + " && convert '" + file + "[" +
                              std::to_string(scene) + "]' -depth 16 -endian LSB rgba:numbers";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string bytes = test::read_bytes(folder / "numbers");
  std::vector<std::uint16_t> out(bytes.size() / 2);
  std::memcpy(out.data(), bytes.data(), out.size() * 2);
  return out;
}

void expect_same(const std::vector<std::uint16_t>& found, const Grid<LayerPixel>& layer,
                 std::size_t channels) {
  ASSERT_EQ(found.size(), layer.size() * channels);
  for (std::size_t i = 0; i < layer.size(); ++i)
    for (std::size_t c = 0; c < channels; ++c)
      ASSERT_EQ(found[i * channels + c], layer[i][c]) << i << " " << c;
}

TEST(LayerFile, OpenRasterHoldsItsLayers) {
  const test::Folder folder;
  const Sheet s(70, 150);
  Progress progress;
  layer_format("ora").write(folder / "a.ora", s.sheet, progress);
  EXPECT_EQ(folder.count(), 1U) << "nothing else is left";
  EXPECT_EQ(test::read_bytes(folder / "a.ora").substr(30, 24), "mimetypeimage/openraster")
      << "first, and not packed";
  ASSERT_EQ(std::system(("cd " + folder.path() + " && python3 -m zipfile -e a.ora x").c_str()), 0);
  const std::string stack = test::read_bytes(folder / "x/stack.xml");
  EXPECT_THAT(stack, HasSubstr("name=\"Ground &amp; so\""));
  EXPECT_LT(stack.find("three.png"), stack.find("one.png")) << "from the top down";
  EXPECT_THAT(
      stack,
      HasSubstr("src=\"data/three.png\" x=\"0\" y=\"0\" opacity=\"1.0\" visibility=\"hidden\""));
  for (std::size_t k = 0; k < 3; ++k)
    expect_same(numbers(folder / ("x/data/" + s.sheet.layers[k].name + ".png"), 0, 4), s.layers[k],
                4);
  expect_same(numbers(folder / "x/mergedimage.png", 0, 3), s.merged, 3);
  EXPECT_LE(read_picture(folder / "x/Thumbnails/thumbnail.png").height(), 256);
  EXPECT_NEAR(read_image_info(folder / "x/data/one.png").dots_per_inch, 300.0, 0.1);
}

TEST(LayerFile, PhotoshopHoldsItsLayers) {
  const test::Folder folder;
  const Sheet s(70, 150);
  Progress progress;
  layer_format("psd").write(folder / "a.psd", s.sheet, progress);
  EXPECT_EQ(test::read_bytes(folder / "a.psd").substr(0, 6), std::string("8BPS\0\1", 6));
  expect_same(numbers(folder / "a.psd", 0, 3), s.merged, 3);
  for (int k = 0; k < 3; ++k)
    expect_same(magick_numbers(folder, "a.psd", k + 1), s.layers[static_cast<std::size_t>(k)], 4);
}

TEST(LayerFile, LargePicturesAreTheLargeForm) {
  const test::Folder folder;
  Sheet s(300, 40);
  s.sheet.large_from_bytes = 1000.0;
  Progress progress;
  layer_format("psd").write(folder / "a.psd", s.sheet, progress);
  EXPECT_EQ(test::read_bytes(folder / "a.psd").substr(0, 6), std::string("8BPS\0\2", 6));
  expect_same(numbers(folder / "a.psd", 0, 3), s.merged, 3);
  expect_same(magick_numbers(folder, "a.psd", 2), s.layers[1], 4);
  const Sheet wide(30001, 2);
  layer_format("psd").write(folder / "b.psd", wide.sheet, progress);
  EXPECT_EQ(test::read_bytes(folder / "b.psd").substr(0, 6), std::string("8BPS\0\2", 6))
      << "PSD has 30000 pixels a side";
}

TEST(LayerFile, SameBytesAndFaults) {
  const test::Folder folder;
  const Sheet s(50, 40);
  Progress progress;
  for (const LayerFormat& format : layer_formats()) {
    format.write(folder / "a", s.sheet, progress);
    format.write(folder / "b", s.sheet, progress);
    EXPECT_EQ(test::read_bytes(folder / "a"), test::read_bytes(folder / "b")) << format.title;
    test::message_of(ErrorKind::output, [&] { format.write("/dev/full/a", s.sheet, progress); });
  }
  EXPECT_THAT(test::usage_error([] { layer_format("xcf"); }), HasSubstr("ora, psd, exr"));
}

constexpr int width = 70;
constexpr int height = 150;  // two bands and a piece of one

// Opaque, half covering and empty pixels; the last is hidden.
Grid<LayerPixel> layer(int number) {
  Grid<LayerPixel> out(width, height, LayerPixel{});
  for (const auto [x, y] : test::cells(width, height)) {
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
