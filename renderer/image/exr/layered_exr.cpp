#include "renderer/image/exr/layered_exr.h"

#include <algorithm>
#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "base/parallel.h"
#include "renderer/image/exr/exr_writer.h"
#include "renderer/image/exr/half_floats.h"
#include "renderer/image/srgb_table.h"

namespace belvedere {
namespace {

constexpr float highest = 65535.0F;

glm::vec3 encoded(const LayerPixel& pixel) {
  return glm::vec3(pixel[0], pixel[1], pixel[2]) / highest;
}
glm::vec3 linear(glm::vec3 colour) {
  return {srgb_decoded_fast(colour.x), srgb_decoded_fast(colour.y), srgb_decoded_fast(colour.z)};
}

glm::vec4 rounded(glm::vec4 value) {
  std::array<std::uint16_t, 4> halves{};
  to_halves(&value.x, 1, 4, halves.data());
  from_halves(halves.data(), 4, &value.x, 1);
  return value;
}

// The composite of the layers so far, for a band of rows.
struct Below {
  Grid<glm::vec3> wanted;  // encoded, as painting programs blend
  Grid<glm::vec3> made;    // linear, as compositors do
};

// Premultiplied colour and opacity of a layer's pixel in linear light; the composite below is
// updated.
glm::vec4 lay(const LayerPixel& above, glm::vec3& wanted, glm::vec3& made) {
  if (above[3] == 0) return glm::vec4(0.0F);
  const float opacity = static_cast<float>(above[3]) / highest;
  wanted += opacity * (encoded(above) - wanted);
  const float alpha = rounded(glm::vec4(opacity)).w;
  const glm::vec3 colour = linear(wanted) - (1.0F - alpha) * made;
  const glm::vec4 stored = rounded(glm::vec4(colour, alpha));
  made = glm::vec3(stored) + (1.0F - alpha) * made;
  return stored;
}

glm::vec4 alone(const LayerPixel& pixel) {
  const float opacity = static_cast<float>(pixel[3]) / highest;
  return glm::vec4(opacity * linear(encoded(pixel)), opacity);
}

PartSpec part_of_layer(const std::string& name, bool opaque) {
  PartSpec part{name,
                {{"R", ChannelType::half}, {"G", ChannelType::half}, {"B", ChannelType::half}}};
  if (!opaque) part.channels.push_back({"A", ChannelType::half});
  return part;
}

void write_band(ExrWriter& writer, std::size_t part, int y0, const Grid<glm::vec4>& band) {
  writer.write_rows(part, y0, band.height(),
                    [&](std::size_t channel, int x, int y, int count, float* out) {
                      const glm::vec4* pixels = &band(x, y - y0);
                      for (int i = 0; i < count; ++i) out[i] = pixels[i][static_cast<int>(channel)];
                    });
}

}  // namespace

void write_layered_exr(const std::string& path, const LayeredSheet& sheet, Progress& progress) {
  std::vector<PartSpec> parts = {part_of_layer("panorama", true)};
  for (const LayerSource& layer : sheet.layers) {
    parts.push_back(part_of_layer(layer.name, false));
    parts.back().notes = {{"title", layer.title}};
    if (layer.hidden) parts.back().notes["hidden"] = "1";
  }
  ExrWriter writer(path, sheet.width, sheet.height, parts, {});
  progress.begin("writing layers", sheet.height);
  for (int y0 = 0; y0 < sheet.height; y0 += ExrWriter::band_rows) {
    const int y1 = std::min(sheet.height, y0 + ExrWriter::band_rows);
    Grid<glm::vec4> band(sheet.width, y1 - y0);
    const auto fill = [&](const Grid<LayerPixel>& rows, auto&& pixel) {
      parallel_rows(band.height(), [&](int y) {
        for (std::size_t i = band.index(0, y);
             i < band.index(0, y) + static_cast<std::size_t>(band.width()); ++i)
          band[i] = pixel(rows[i], i);
      });
    };
    fill(sheet.merged(y0, y1), [](const LayerPixel& pixel, std::size_t) { return alone(pixel); });
    write_band(writer, 0, y0, band);
    Below below{Grid<glm::vec3>(band.width(), band.height(), glm::vec3(0.0F)),
                Grid<glm::vec3>(band.width(), band.height(), glm::vec3(0.0F))};
    for (std::size_t k = 0; k < sheet.layers.size(); ++k) {
      const Grid<LayerPixel> rows = sheet.layers[k].rows(y0, y1);
      if (sheet.layers[k].hidden)
        fill(rows, [](const LayerPixel& pixel, std::size_t) { return alone(pixel); });
      else
        fill(rows, [&](const LayerPixel& pixel, std::size_t i) {
          return lay(pixel, below.wanted[i], below.made[i]);
        });
      write_band(writer, k + 1, y0, band);
    }
    progress.advance(y1 - y0);
  }
  writer.finish();
}

}  // namespace belvedere
