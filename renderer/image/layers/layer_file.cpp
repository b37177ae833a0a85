#include "renderer/image/layers/layer_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "base/text/text_encoding.h"
#include "renderer/image/deflate.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/exr/exr_writer.h"
#include "renderer/image/layers/layer_png.h"
#include "renderer/image/layers/psd_file.h"
#include "renderer/image/srgb.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr int thumbnail_px = 256;  // required by the specification

// A ZIP archive of uncompressed files (APPNOTE.TXT 6.3.3): its first entry has no extra field,
// which identifies OpenRaster, and where an entry or the archive is over 4 GB its numbers are in
// the fields of ZIP64. libarchive, minizip and others add fields of times and owners everywhere.
class Zip {
 public:
  explicit Zip(const OutputFile& file)
      : file_(file), out_(file.temporary(), std::ios::binary | std::ios::trunc) {
    if (!out_) file.fail("it cannot be created");
  }
  void add_text(const std::string& name, const std::string& text) {
    begin({name, crc32_after(0, text.data(), text.size()), text.size(), offset_});
    put(text);
  }
  void add_file(const std::string& name, const std::string& path) {
    std::uint32_t crc = 0;
    read_all(path,
             [&](const std::string& bytes) { crc = crc32_after(crc, bytes.data(), bytes.size()); });
    begin({name, crc, fs::file_size(path), offset_});
    read_all(path, [&](const std::string& bytes) { put(bytes); });
  }
  void close() {
    const std::uint64_t directory = offset_;
    for (const Entry& entry : entries_)
      put("PK\1\2" + number(version_made, 2) + common(entry, true) + number(0, 2) + number(0, 2) +
          number(0, 2) + number(0, 4) + number(std::min(entry.offset, full), 4) + entry.name +
          zip64(entry, true));
    const std::uint64_t bytes = offset_ - directory;
    const std::uint64_t count = entries_.size();
    if (directory >= full) {
      const std::uint64_t end = offset_;
      put("PK\6\6" + number(44, 8) + number(version_made, 2) + number(version_made, 2) +
          number(0, 4) + number(0, 4) + number(count, 8) + number(count, 8) + number(bytes, 8) +
          number(directory, 8));
      put("PK\6\7" + number(0, 4) + number(end, 8) + number(1, 4));
    }
    put("PK\5\6" + number(0, 2) + number(0, 2) + number(count, 2) + number(count, 2) +
        number(bytes, 4) + number(std::min(directory, full), 4) + number(0, 2));
    out_.flush();
    if (!out_) file_.fail("it cannot be written");
  }

 private:
  static constexpr std::uint64_t full = 0xffffffffU;
  static constexpr std::uint64_t version_made = 45;  // 4.5: ZIP64
  struct Entry {
    std::string name;
    std::uint32_t crc;
    std::uint64_t bytes;
    std::uint64_t offset;
  };

  static std::string number(std::uint64_t value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255U);
    return out;
  }
  // Numbers that do not fit, in the order of the format.
  static std::string zip64(const Entry& entry, bool with_offset) {
    std::string values;
    if (entry.bytes >= full) values += number(entry.bytes, 8) + number(entry.bytes, 8);
    if (with_offset && entry.offset >= full) values += number(entry.offset, 8);
    return values.empty() ? values : number(1, 2) + number(values.size(), 2) + values;
  }
  // The fields shared by local header and directory; dated 2000-01-01, so that the same picture
  // gives the same bytes.
  static std::string common(const Entry& entry, bool in_directory) {
    constexpr std::uint64_t date = 20U << 9U | 1U << 5U | 1U;
    return number(entry.bytes >= full ? version_made : 20, 2) + number(1U << 11U, 2) +
           number(0, 2) + number(0, 2) + number(date, 2) + number(entry.crc, 4) +
           number(std::min(entry.bytes, full), 4) + number(std::min(entry.bytes, full), 4) +
           number(entry.name.size(), 2) + number(zip64(entry, in_directory).size(), 2);
  }
  void begin(const Entry& entry) {
    put("PK\3\4" + common(entry, false) + entry.name + zip64(entry, false));
    entries_.push_back(entry);
  }
  void put(const std::string& bytes) {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!out_) file_.fail("it cannot be written");
    offset_ += bytes.size();
  }
  template <class F>
  void read_all(const std::string& path, F&& use) {
    std::ifstream from(path, std::ios::binary);
    std::string bytes(std::size_t{1} << 20U, '\0');
    while (from.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || from.gcount() > 0)
      use(bytes.substr(0, static_cast<std::size_t>(from.gcount())));
  }

  const OutputFile& file_;
  std::ofstream out_;
  std::uint64_t offset_ = 0;
  std::vector<Entry> entries_;
};

// Layers from the top down, as in stack.xml.
std::string stack_xml(const LayeredSheet& sheet) {
  const auto dots = static_cast<int>(sheet.dots_per_inch + 0.5);
  std::string out = fmt::format(
      "<?xml version='1.0' encoding='UTF-8'?>\n<image version=\"0.0.5\" w=\"{}\" "
      "h=\"{}\"{}>\n<stack>\n",
      sheet.width, sheet.height, dots > 0 ? fmt::format(" xres=\"{0}\" yres=\"{0}\"", dots) : "");
  for (std::size_t k = sheet.layers.size(); k-- > 0;) {
    const LayerSource& layer = sheet.layers[k];
    out += fmt::format(
        "<layer name=\"{}\" src=\"data/{}.png\" x=\"0\" y=\"0\" opacity=\"1.0\" visibility=\"{}\" "
        "composite-op=\"svg:src-over\"/>\n",
        markup_text(layer.title), layer.name, layer.hidden ? "hidden" : "visible");
  }
  return out + "</stack>\n</image>\n";
}

// OpenRaster 0.0.5 (https://www.openraster.org): a ZIP archive of PNG with 16 bits per channel,
// stack.xml and a preview. Archives over 4 GB are ZIP64.
void write_ora(const std::string& path, const LayeredSheet& sheet, Progress& progress) {
  OutputFile file(path);
  OutputFile png(fs::path(path)
                     .replace_extension("layer.png")
                     .string());  // its temporary file is used, and removed in the end
  progress.begin("writing layers",
                 static_cast<double>(sheet.height) * static_cast<double>(sheet.layers.size() + 1));
  Zip zip(file);
  zip.add_text("mimetype", "image/openraster");
  zip.add_text("stack.xml", stack_xml(sheet));
  for (const LayerSource& layer : sheet.layers) {
    write_layer_png(png.temporary(), sheet.width, sheet.height, sheet.dots_per_inch, false,
                    layer.rows, progress);
    zip.add_file("data/" + layer.name + ".png", png.temporary());
  }
  write_layer_png(png.temporary(), sheet.width, sheet.height, sheet.dots_per_inch, true,
                  sheet.merged, progress);
  zip.add_file("mergedimage.png", png.temporary());
  write_thumbnail_png(png.temporary(), sheet.width, sheet.height, thumbnail_px, sheet.merged);
  zip.add_file("Thumbnails/thumbnail.png", png.temporary());
  zip.close();
  file.prepare();
  file.commit();
}

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

const std::vector<LayerFormat>& layer_formats() {
  static const std::vector<LayerFormat> all = {
      {"ora", "OpenRaster", "panorama.ora", write_ora},
      {"psd", "Photoshop", "panorama.psd", write_psd},
      {"exr", "OpenEXR", "panorama_layers.exr", write_layered_exr}};
  return all;
}

const LayerFormat& layer_format(const std::string& extension) {
  std::string known;
  for (const LayerFormat& format : layer_formats()) {
    if (format.extension == extension) return format;
    known += (known.empty() ? "" : ", ") + format.extension;
  }
  throw Error(ErrorKind::usage, "format of layers", fmt::format("\"{}\"", extension), known);
}

}  // namespace belvedere
