#include "renderer/image/exr/exr_writer.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfVersion.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/parallel.h"
#include "renderer/image/deflate.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/image_file.h"
#include "renderer/image/provenance.h"

// Tiles are packed and written to the file here (OpenEXR file layout, openexr.com): the library's
// zlib takes more than twice the time of libdeflate for the same size, and needs all values of a
// row of tiles at once.

namespace belvedere {
namespace {

// Appends a number little-endian, as in files and in memory here.
static_assert(std::endian::native == std::endian::little);
template <class Number>
void put_number(std::string& out, Number number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

constexpr std::size_t longest_name = 31;

// Keeps the output of the library in memory.
class TextStream : public Imf::OStream {
 public:
  TextStream() : OStream("header") {}
  void write(const char bytes[], int count) override {
    text_.append(bytes, static_cast<std::size_t>(count));
  }
  std::uint64_t tellp() override { return text_.size(); }
  void seekp(std::uint64_t) override {}
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

Imf::PixelType pixel_type(const std::string& path, const ChannelSpec& channel) {
  switch (channel.type) {
    case ChannelType::half:
      return Imf::HALF;
    case ChannelType::float32:
      return Imf::FLOAT;
    case ChannelType::uint32:
      return Imf::UINT;
    default:
      break;
  }
  throw Error(ErrorKind::bug, path,
              "channel " + channel.name + " has a type that OpenEXR does not have",
              "half, float32, uint32");
}

// Attributes that OpenEXR uses itself; a note of that name would break the file.
bool is_reserved(const std::string& key) {
  static const char* const names[] = {"channels",
                                      "chunkCount",
                                      "compression",
                                      "dataWindow",
                                      "displayWindow",
                                      "lineOrder",
                                      "name",
                                      "pixelAspectRatio",
                                      "screenWindowCenter",
                                      "screenWindowWidth",
                                      "tiles",
                                      "type",
                                      "version",
                                      "view",
                                      "chromaticities",
                                      "envmap",
                                      "multiView",
                                      "wrapmodes",
                                      "timeCode",
                                      "keyCode",
                                      "preview",
                                      "renderingTransform"};
  return std::any_of(std::begin(names), std::end(names), [&](const char* n) { return key == n; });
}

Imf::Header make_header(const std::string& path, int width, int height, int tile_px,
                        const PartSpec& part, const FileNotes& notes, bool many) {
  Imf::Header header(width, height);
  header.setName(part.name);
  header.setType(Imf::TILEDIMAGE);
  header.setTileDescription(Imf::TileDescription(static_cast<unsigned>(tile_px),
                                                 static_cast<unsigned>(tile_px), Imf::ONE_LEVEL));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.lineOrder() = Imf::INCREASING_Y;
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709, that is sRGB
  for (const ChannelSpec& channel : part.channels) {
    if (header.channels().findChannel(channel.name) != nullptr) {
      throw Error(ErrorKind::bug, path, "channel " + channel.name + " occurs twice");
    }
    header.channels().insert(channel.name, Imf::Channel(pixel_type(path, channel)));
  }
  for (const auto& [key, value] : notes) {
    if (key.empty() || is_reserved(key))
      throw Error(ErrorKind::bug, path, "\"" + key + "\" cannot be the name of a note");
    header.insert(key, Imf::StringAttribute(value));
  }
  const auto tiles = [&](int pixels) { return (pixels + tile_px - 1) / tile_px; };
  if (many) header.setChunkCount(tiles(width) * tiles(height));
  return header;
}

// The bytes of a tiled OpenEXR file before its tables of offsets: magic number, version, and a
// header for each part, made by the library. ZIP, primaries of sRGB; notes go to the first part,
// those of a PartSpec to theirs. Error(bug) for duplicate parts or channels, notes named like
// OpenEXR's own attributes, unknown types.
std::string exr_head(const std::string& path, int width, int height, int tile_px,
                     const std::vector<PartSpec>& parts, const FileNotes& notes) {
  const bool many = parts.size() > 1;
  bool long_names = std::any_of(notes.begin(), notes.end(),
                                [](const auto& note) { return note.first.size() > longest_name; });
  for (const PartSpec& part : parts)
    for (const ChannelSpec& channel : part.channels)
      long_names |= channel.name.size() > longest_name;
  const int flags = (many ? Imf::MULTI_PART_FILE_FLAG : Imf::TILED_FLAG) |
                    (long_names ? Imf::LONG_NAMES_FLAG : 0);
  std::string head;
  put_number(head, std::int32_t{Imf::MAGIC});
  put_number(head, std::int32_t{Imf::EXR_VERSION | flags});
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (std::size_t other = 0; other < p; ++other)
      if (parts[other].name == parts[p].name)
        throw Error(ErrorKind::bug, path, "part " + parts[p].name + " occurs twice");
    TextStream stream;
    FileNotes all = parts[p].notes;
    if (p == 0) all.insert(notes.begin(), notes.end());
    make_header(path, width, height, tile_px, parts[p], all, many).writeTo(stream, true);
    head += stream.text();
  }
  if (many) head += '\0';
  return head;
}

using Bytes = std::vector<std::uint8_t>;

constexpr int tile_size = ExrWriter::band_rows;
constexpr int tiles_at_once = 128;    // are packed together, then written; limits memory
constexpr int compression_level = 1;  // guidance measured: 2.4 times as fast as zlib's level 2, the
                                      // same size; level 4: 2 % smaller

int tiles_of(int pixels) { return (pixels + tile_size - 1) / tile_size; }

// A file that keeps the error code of its first failure.
class CheckedFile {
 public:
  explicit CheckedFile(const std::string& path) : file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) code_ = errno;
  }
  ~CheckedFile() { close(); }
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;

  bool write(const void* bytes, std::size_t count) {
    if (code_ == 0 && std::fwrite(bytes, 1, count, file_) != count) code_ = errno;
    return code_ == 0;
  }
  bool seek(std::uint64_t at) {
    if (code_ == 0 && ::fseeko(file_, static_cast<off_t>(at), SEEK_SET) != 0) code_ = errno;
    return code_ == 0;
  }
  bool close() {
    if (file_ != nullptr && std::fclose(file_) != 0 && code_ == 0) code_ = errno;
    file_ = nullptr;
    return code_ == 0;
  }
  int code() const { return code_; }

 private:
  std::FILE* file_ = nullptr;
  int code_ = 0;
};

std::size_t value_bytes(const ChannelSpec& channel) {
  return channel.type == ChannelType::half ? 2 : 4;
}

// The library's order of the channels in a file: by name.
std::vector<std::size_t> file_order(const PartSpec& part) {
  std::vector<std::size_t> order(part.channels.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return part.channels[a].name < part.channels[b].name;
  });
  return order;
}

// The values of a tile in file order: row by row, in a row channel by channel.
Bytes tile_values(const PartSpec& part, const std::vector<std::size_t>& order,
                  const PixelRect& tile, const ExrWriter::Values& values) {
  std::size_t pixel_bytes = 0;
  for (const ChannelSpec& channel : part.channels) pixel_bytes += value_bytes(channel);
  const auto width = static_cast<std::size_t>(tile.width());
  Bytes out(pixel_bytes * width * static_cast<std::size_t>(tile.height()));
  std::uint8_t* to = out.data();
  std::array<float, tile_size> row{};
  std::array<std::uint16_t, tile_size> halves{};
  for (int y = tile.y0; y < tile.y1; ++y) {
    for (const std::size_t c : order) {
      values(c, tile.x0, y, tile.width(), row.data());
      const bool narrow = part.channels[c].type == ChannelType::half;
      if (narrow) to_halves(row.data(), 1, width, halves.data());
      const std::size_t bytes = width * value_bytes(part.channels[c]);
      // As bits: an id may look like a signalling NaN.
      std::memcpy(to, narrow ? static_cast<const void*>(halves.data()) : row.data(), bytes);
      to += bytes;
    }
  }
  return out;
}

// ZIP compression of OpenEXR: bytes at even offsets first, then those at odd ones, each as the
// difference from the previous one plus 128, packed by zlib; unpacked where that is no shorter.
Bytes pack_tile(const Bytes& values) {
  Bytes parted(values.size());
  const std::size_t half_way = values.size() / 2;  // an even number: values have 2 or 4 bytes
  for (std::size_t i = 0; i < half_way; ++i) {
    parted[i] = values[2 * i];
    parted[half_way + i] = values[2 * i + 1];
  }
  for (std::size_t i = parted.size() - 1; i > 0; --i)
    parted[i] = static_cast<std::uint8_t>(parted[i] - parted[i - 1] + 128);
  Bytes packed = Deflater(compression_level).pack(parted.data(), parted.size());
  return packed.size() < values.size() ? packed : values;
}

}  // namespace

struct ExrWriter::State {
  struct Part {
    int next_row = 0;
    std::vector<std::size_t> order;
    std::vector<std::uint64_t> offsets;  // of the tiles, row by row
  };

  State(const std::string& path, int w, int h, const std::vector<PartSpec>& parts,
        const FileNotes& notes)
      : width(w),
        height(h),
        specs(parts),
        head(exr_head(path, w, h, tile_size, parts, notes)),
        output(path),
        file(output.temporary()) {
    for (const PartSpec& part : parts)
      progress.push_back({0, file_order(part),
                          std::vector<std::uint64_t>(static_cast<std::size_t>(tiles_of(w)) *
                                                     static_cast<std::size_t>(tiles_of(h)))});
    const std::string room = head + tables();
    if (!file.write(room.data(), room.size())) fail({});
    end = room.size();
  }

  // Throws that the file cannot be written: for the system's reason if there is one, else for
  // `reason`.
  [[noreturn]] void fail(const std::string& reason) const {
    output.fail(file.code() != 0 ? std::generic_category().message(file.code()) : reason);
  }
  std::string tables() const {
    std::string out;
    for (const Part& part : progress)
      for (const std::uint64_t offset : part.offsets) put_number(out, offset);
    return out;
  }
  void write_tiles(std::size_t part, int y0, const Values& values);
  void add(std::string_view bytes) {
    if (!file.write(bytes.data(), bytes.size())) fail({});
    written.add(bytes);
    end += bytes.size();
  }
  void verify() const;

  int width;
  int height;
  std::vector<PartSpec> specs;
  std::vector<Part> progress;
  std::string head;
  OutputFile output;
  CheckedFile file;
  std::uint64_t end = 0;  // offset of the next tile
  ContentHash written;    // of what follows the tables of offsets
};

// One row of tiles.
void ExrWriter::State::write_tiles(std::size_t part, int y0, const Values& values) {
  const int across = tiles_of(width);
  for (int first = 0; first < across; first += tiles_at_once) {
    std::vector<Bytes> packed(static_cast<std::size_t>(std::min(tiles_at_once, across - first)));
    parallel_rows(static_cast<int>(packed.size()), [&](int i) {
      const int x0 = (first + i) * tile_size;
      const PixelRect tile{x0, y0, std::min(x0 + tile_size, width),
                           std::min(y0 + tile_size, height)};
      packed[static_cast<std::size_t>(i)] =
          pack_tile(tile_values(specs[part], progress[part].order, tile, values));
    });
    for (std::size_t i = 0; i < packed.size(); ++i) {
      const int x = first + static_cast<int>(i);
      const int y = y0 / tile_size;
      progress[part].offsets[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
                             static_cast<std::size_t>(x)] = end;
      std::string start;
      if (specs.size() > 1) put_number(start, static_cast<std::int32_t>(part));
      for (const int number : {x, y, 0, 0, static_cast<int>(packed[i].size())})
        put_number(start, std::int32_t{number});  // 0, 0: of full size
      add(start);
      add({reinterpret_cast<const char*>(packed[i].data()), packed[i].size()});
    }
  }
}

// Reads the whole file again, as bytes: header and tables must be identical, the tiles match by
// hash.
void ExrWriter::State::verify() const {
  const auto complain = [&] { fail("it reads back differently from what was written"); };
  std::ifstream again(output.temporary(), std::ios::binary);
  const std::string expected = head + tables();
  std::string bytes(expected.size(), '\0');
  if (!again.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || bytes != expected)
    complain();
  ContentHash read;
  bytes.resize(std::size_t{1} << 18);
  do {
    again.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    read.add(std::string_view(bytes).substr(0, static_cast<std::size_t>(again.gcount())));
  } while (again);
  if (again.bad() || read.digits() != written.digits()) complain();
}

ExrWriter::ExrWriter(const std::string& path, int width, int height,
                     const std::vector<PartSpec>& parts, const FileNotes& notes) {
  if (width < 1 || height < 1 || parts.empty())
    throw Error(ErrorKind::bug, path, "a file without pixels or parts");
  state_ = std::make_unique<State>(path, width, height, parts, notes);
}

ExrWriter::~ExrWriter() = default;
ExrWriter::ExrWriter(ExrWriter&&) noexcept = default;
ExrWriter& ExrWriter::operator=(ExrWriter&&) noexcept = default;

void ExrWriter::write_rows(std::size_t part, int y0, int rows, const Values& values) {
  State& state = *state_;
  if (part >= state.specs.size())
    throw Error(ErrorKind::bug, state.output.path(), "rows of an unknown part");
  State::Part& progress = state.progress[part];
  const bool whole = rows % band_rows == 0 || y0 + rows == state.height;
  if (rows < 1 || y0 != progress.next_row || y0 + rows > state.height || !whole) {
    throw Error(ErrorKind::bug, state.output.path(),
                "rows " + std::to_string(y0) + " to " + std::to_string(y0 + rows) + " where row " +
                    std::to_string(progress.next_row) + " is next of " +
                    std::to_string(state.height));
  }
  for (int y = 0; y < rows; y += band_rows) state.write_tiles(part, y0 + y, values);
  progress.next_row = y0 + rows;
}

void ExrWriter::write_rows(std::size_t part, int y0, int rows,
                           const std::vector<float>& interleaved) {
  const std::size_t channels =
      part < state_->specs.size() ? state_->specs[part].channels.size() : 0;
  const auto width = static_cast<std::size_t>(state_->width);
  if (rows > 0 && interleaved.size() < width * channels * static_cast<std::size_t>(rows))
    throw Error(ErrorKind::bug, state_->output.path(),
                "too few values for " + std::to_string(rows) + " rows");
  write_rows(part, y0, rows, [&](std::size_t channel, int x, int y, int count, float* out) {
    const float* from =
        interleaved.data() +
        (static_cast<std::size_t>(y - y0) * width + static_cast<std::size_t>(x)) * channels +
        channel;
    for (int i = 0; i < count; ++i, from += channels) std::memcpy(out + i, from, sizeof(float));
  });
}

void ExrWriter::complete() {
  State& state = *state_;
  for (std::size_t p = 0; p < state.specs.size(); ++p) {
    if (state.progress[p].next_row != state.height) {
      throw Error(ErrorKind::bug, state.output.path(),
                  "part " + state.specs[p].name + " ends at row " +
                      std::to_string(state.progress[p].next_row));
    }
  }
  const std::string tables = state.tables();
  if (!state.file.seek(state.head.size()) || !state.file.write(tables.data(), tables.size()) ||
      !state.file.close())
    state.fail({});
  state.verify();
  state.output.prepare();
}

void ExrWriter::commit() { state_->output.commit(); }

void ExrWriter::finish() {
  complete();
  commit();
}

namespace {

class ExrRows : public PictureRows {
 public:
  ExrRows(const std::string& path, int width, int height, const FileNotes& notes)
      : PictureRows(path, width, height, ExrWriter::band_rows),
        writer_(path, width, height,
                {{"picture",
                  {{"R", ChannelType::half}, {"G", ChannelType::half}, {"B", ChannelType::half}}}},
                notes),
        band_(width, std::min(height, ExrWriter::band_rows)) {}

 private:
  void take(const Grid<glm::vec3>& from, int first, int rows, int at) override {
    const glm::vec3* begin = from.row(first);
    std::copy(begin, begin + band_.index(0, rows), band_.row(at));
  }
  void write_band(int y0, int rows) override {
    writer_.write_rows(0, y0, rows, [&](std::size_t channel, int x, int y, int count, float* out) {
      const glm::vec3* pixels = &band_(x, y - y0);
      for (int i = 0; i < count; ++i) out[i] = pixels[i][static_cast<int>(channel)];
    });
  }
  void complete() override { writer_.complete(); }
  void replace() override { writer_.commit(); }

  ExrWriter writer_;
  Image band_;
};

}  // namespace

std::unique_ptr<PictureRows> open_exr(const std::string& path, int width, int height,
                                      const FileNotes& notes) {
  return std::make_unique<ExrRows>(path, width, height, notes);
}

double exr_writer_bytes(int width, int) {
  constexpr double tile_bytes = 3.0 * tile_size * tile_size * 2;
  return static_cast<double>(sizeof(glm::vec3)) * tile_size * width +
         4.0 * tile_bytes * tiles_at_once;  // a band, tiles while packed
}

void write_exr(const std::string& path, const Image& linear, const FileNotes& notes) {
  write_whole(*open_exr(path, linear.width(), linear.height(), notes), linear);
}

}  // namespace belvedere
