#include "renderer/image/layers/psd_file.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "renderer/image/icc/device_colour.h"
#include "renderer/image/layers/layer_png.h"

namespace belvedere {
namespace {

// Numbers are big-endian; lengths that take 8 bytes in a large file take 4 in a small one.
class PsdWriter {
 public:
  PsdWriter(const OutputFile& file, const LayeredSheet& sheet, bool large)
      : file_(file),
        sheet_(sheet),
        large_(large),
        out_(file.temporary(), std::ios::binary | std::ios::trunc) {
    if (!out_) file.fail("it cannot be created");
  }

  void write(Progress& progress) {
    progress.begin("writing layers", static_cast<double>(sheet_.height) *
                                         static_cast<double>(4 * sheet_.layers.size() + 3));
    text("8BPS");
    number(large_ ? 2 : 1, 2);
    text(std::string(6, '\0'));
    number(3, 2);
    number(static_cast<std::uint64_t>(sheet_.height), 4);
    number(static_cast<std::uint64_t>(sheet_.width), 4);
    number(16, 2);
    number(3, 2);  // RGB
    number(0, 4);  // colour mode data
    write_resources();
    const std::streamoff section = open_length(large_ ? 8 : 4);
    number(0, large_ ? 8 : 4);  // layers of 8 bits: none
    number(0, 4);               // global mask
    text("8BIM");
    text("Lr16");
    const std::streamoff layers = open_length(large_ ? 8 : 4);
    write_layers(progress);
    close_length(layers, large_ ? 8 : 4, 4);
    close_length(section, large_ ? 8 : 4, 1);
    // The composite, for programs that read no layers.
    number(1, 2);
    write_rows(sheet_.merged, {0, 1, 2}, progress);
    out_.flush();
    if (!out_) file_.fail("it cannot be written");
  }

 private:
  void text(const std::string& bytes) {
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  void number(std::uint64_t value, int bytes) {
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
      out_.put(static_cast<char>(value >> shift & 255U));
  }
  // A length that is known once its content is written.
  std::streamoff open_length(int bytes) {
    number(0, bytes);
    return out_.tellp();
  }
  void close_length(std::streamoff begin, int bytes, int multiple) {
    while ((out_.tellp() - begin) % multiple != 0) out_.put('\0');
    patch(begin - bytes, static_cast<std::uint64_t>(out_.tellp() - begin), bytes);
  }
  void patch(std::streamoff at, std::uint64_t value, int bytes) {
    const std::streamoff end = out_.tellp();
    out_.seekp(at);
    number(value, bytes);
    out_.seekp(end);
  }

  void resource(int id, const std::string& bytes) {
    text("8BIM");
    number(static_cast<std::uint64_t>(id), 2);
    number(0, 2);  // no name
    number(bytes.size(), 4);
    text(bytes);
    if (bytes.size() % 2 != 0) out_.put('\0');
  }
  void write_resources() {
    const std::streamoff begin = open_length(4);
    if (sheet_.dots_per_inch > 0.0) {
      const auto fixed = static_cast<std::uint32_t>(sheet_.dots_per_inch * 65536.0 + 0.5);
      std::string bytes;
      for (int side = 0; side < 2; ++side) {
        for (int shift = 24; shift >= 0; shift -= 8)
          bytes += static_cast<char>(fixed >> shift & 255U);
        bytes += std::string("\0\1\0\1", 4);  // per inch, shown in inches
      }
      resource(1005, bytes);
    }
    const std::vector<std::uint8_t> profile = srgb_profile();
    resource(1039, std::string(profile.begin(), profile.end()));
    close_length(begin, 4, 1);
  }

  void write_layers(Progress& progress) {
    number(sheet_.layers.size(), 2);
    std::vector<std::streamoff> lengths;  // offset of those of a layer's first channel
    for (const LayerSource& layer : sheet_.layers) {
      for (const int side : {0, 0, sheet_.height, sheet_.width})
        number(static_cast<std::uint64_t>(side), 4);
      number(4, 2);
      lengths.push_back(out_.tellp());
      for (const int channel : {-1, 0, 1, 2}) {
        number(static_cast<std::uint64_t>(channel) & 0xffffU, 2);
        number(0, large_ ? 8 : 4);
      }
      text("8BIMnorm");
      out_.put('\xff');  // opaque
      out_.put('\0');    // no clipping
      out_.put(layer.hidden ? '\x0a' : '\x08');
      out_.put('\0');
      const std::streamoff extra = open_length(4);
      number(0, 4);  // no mask
      number(0, 4);  // no blending ranges
      const std::string title = layer.title.substr(0, 255);
      out_.put(static_cast<char>(title.size()));
      text(title + std::string((4 - (title.size() + 1) % 4) % 4, '\0'));
      close_length(extra, 4, 1);
    }
    for (std::size_t k = 0; k < sheet_.layers.size(); ++k) {
      constexpr std::size_t channels[4] = {3, 0, 1, 2};
      for (int c = 0; c < 4; ++c) {
        const std::streamoff begin = out_.tellp();
        number(1, 2);  // PackBits
        write_rows(sheet_.layers[k].rows, {channels[c]}, progress);
        const int step = large_ ? 10 : 6;
        patch(lengths[k] + c * step + 2, static_cast<std::uint64_t>(out_.tellp() - begin),
              large_ ? 8 : 4);
      }
    }
  }

  // Channels one after the other: the lengths of all packed rows, then the rows.
  void write_rows(const LayerRows& rows, const std::vector<std::size_t>& channels,
                  Progress& progress) {
    const int count_bytes = large_ ? 4 : 2;
    const std::streamoff table = out_.tellp();
    std::vector<std::uint32_t> counts;
    text(
        std::string(channels.size() * static_cast<std::size_t>(sheet_.height * count_bytes), '\0'));
    for (const std::size_t channel : channels)
      for (int y0 = 0; y0 < sheet_.height; y0 += layer_band_rows) {
        const Grid<LayerPixel> band = rows(y0, std::min(sheet_.height, y0 + layer_band_rows));
        for (int y = 0; y < band.height(); ++y) {
          const std::string packed = pack_row(band.row(y), channel);
          counts.push_back(static_cast<std::uint32_t>(packed.size()));
          text(packed);
        }
        progress.advance(band.height());
      }
    const std::streamoff end = out_.tellp();
    out_.seekp(table);
    for (const std::uint32_t count : counts) number(count, count_bytes);
    out_.seekp(end);
  }

  // PackBits (Macintosh Technical Note 1023): runs of 3 to 128 equal bytes, and others unchanged.
  std::string pack_row(const LayerPixel* row, std::size_t channel) const {
    std::string bytes;
    for (int x = 0; x < sheet_.width; ++x) {
      bytes += static_cast<char>(row[x][channel] >> 8);
      bytes += static_cast<char>(row[x][channel] & 255);
    }
    std::string out;
    std::size_t literal = 0;  // start of bytes that are not written yet
    const auto flush = [&](std::size_t end) {
      for (; literal < end; literal = std::min(end, literal + 128)) {
        const std::size_t count = std::min<std::size_t>(128, end - literal);
        out += static_cast<char>(count - 1);
        out.append(bytes, literal, count);
      }
    };
    for (std::size_t i = 0; i < bytes.size();) {
      std::size_t run = 1;
      while (i + run < bytes.size() && run < 128 && bytes[i + run] == bytes[i]) ++run;
      if (run >= 3) {
        flush(i);
        out += static_cast<char>(1 - static_cast<int>(run));
        out += bytes[i];
        literal = i + run;
      }
      i += run;
    }
    flush(bytes.size());
    return out;
  }

  const OutputFile& file_;
  const LayeredSheet& sheet_;
  bool large_;
  std::ofstream out_;
};

}  // namespace

void write_psd(const std::string& path, const LayeredSheet& sheet, Progress& progress) {
  // PackBits may lengthen a row by a 128th.
  const double bytes = 1.01 * static_cast<double>(sheet.width) * sheet.height *
                       (8.0 * static_cast<double>(sheet.layers.size()) + 6.0);
  const bool large = std::max(sheet.width, sheet.height) > 30000 || bytes > sheet.large_from_bytes;
  OutputFile file(path);
  PsdWriter(file, sheet, large).write(progress);
  file.prepare();
  file.commit();
}

}  // namespace belvedere
