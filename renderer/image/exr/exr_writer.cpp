#include "renderer/image/exr/exr_writer.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfTiledOutputPart.h>
#include <half.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/image/output_file.h"

namespace belvedere {
namespace {

// A file for OpenEXR that remembers whether anything went wrong: the library writes its table of offsets in a destructor, where an error
// would be lost.
class CheckedStream : public Imf::OStream {
 public:
  explicit CheckedStream(const std::string& path) : OStream(path.c_str()), file_(std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) code_ = errno;
  }
  ~CheckedStream() override { close(); }
  CheckedStream(const CheckedStream&) = delete;
  CheckedStream& operator=(const CheckedStream&) = delete;

  void write(const char bytes[], int count) override {
    if (code_ == 0 && std::fwrite(bytes, 1, static_cast<std::size_t>(count), file_) != static_cast<std::size_t>(count)) code_ = errno;
    check();
  }
  // Does not throw: the library asks in a destructor, outside of its try. The write that follows does.
  std::uint64_t tellp() override {
    const off_t at = code_ == 0 ? ::ftello(file_) : 0;
    if (at < 0) code_ = errno;
    return at < 0 ? 0 : static_cast<std::uint64_t>(at);
  }
  void seekp(std::uint64_t at) override {
    if (code_ == 0 && ::fseeko(file_, static_cast<off_t>(at), SEEK_SET) != 0) code_ = errno;
    check();
  }
  // 0, or the system's code of the first thing that failed.
  int close() {
    if (file_ != nullptr && std::fclose(file_) != 0 && code_ == 0) code_ = errno;
    file_ = nullptr;
    return code_;
  }
  int code() const { return code_; }

 private:
  void check() const {
    if (code_ != 0) throw Iex::IoExc(std::generic_category().message(code_));
  }
  std::FILE* file_ = nullptr;
  int code_ = 0;
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
  throw Error(ErrorKind::bug, path, "channel " + channel.name + " has a type that OpenEXR does not know", "half, float32, uint32");
}

// Attributes that OpenEXR needs for itself; a note of that name would break the file.
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

Imf::Header make_header(const std::string& path, int width, int height, const PartSpec& part, const FileNotes& notes) {
  Imf::Header header(width, height);
  header.setName(part.name);
  header.setType(Imf::TILEDIMAGE);
  header.setTileDescription(Imf::TileDescription(ExrWriter::band_rows, ExrWriter::band_rows, Imf::ONE_LEVEL));
  header.compression() = Imf::ZIP_COMPRESSION;
  header.lineOrder() = Imf::INCREASING_Y;
  header.zipCompressionLevel() = 2;                       // guidance measured: a quarter less time than level 4, the same size
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709, that is sRGB
  for (const ChannelSpec& channel : part.channels) {
    if (header.channels().findChannel(channel.name) != nullptr) {
      throw Error(ErrorKind::bug, path, "channel " + channel.name + " is there twice");
    }
    header.channels().insert(channel.name, Imf::Channel(pixel_type(path, channel)));
  }
  for (const auto& [key, value] : notes) {
    if (key.empty() || is_reserved(key)) throw Error(ErrorKind::bug, path, "\"" + key + "\" cannot be the name of a note");
    header.insert(key, Imf::StringAttribute(value));
  }
  return header;
}

// A half that is never infinite where the number was not.
half to_half(float v) {
  if (std::isfinite(v)) v = std::clamp(v, -static_cast<float>(HALF_MAX), static_cast<float>(HALF_MAX));
  return half(v);
}

// The channels of some rows one after the other, each in the type of the file: what OpenEXR reads from and what is compared afterwards.
struct Band {
  std::vector<char> bytes;
  std::vector<std::size_t> start;  // of each channel

  Band(const PartSpec& part, int width, int rows) {
    std::size_t at = 0;
    for (const ChannelSpec& channel : part.channels) {
      start.push_back(at);
      at += static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) * value_bytes(channel);
      at = (at + 7) / 8 * 8;
    }
    bytes.assign(at, 0);
  }
  static std::size_t value_bytes(const ChannelSpec& channel) { return channel.type == ChannelType::half ? 2 : 4; }

  // A view whose first row is row y0 of the picture.
  Imf::FrameBuffer frame(const std::string& path, const PartSpec& part, int width, int y0) {
    Imf::FrameBuffer out;
    for (std::size_t c = 0; c < part.channels.size(); ++c) {
      const std::size_t step = value_bytes(part.channels[c]);
      const std::size_t row = step * static_cast<std::size_t>(width);
      char* base = bytes.data() + start[c] - static_cast<std::ptrdiff_t>(row) * y0;
      out.insert(part.channels[c].name, Imf::Slice(pixel_type(path, part.channels[c]), base, step, row));
    }
    return out;
  }

  std::uint64_t digest() const {
    std::uint64_t h = bytes.size();
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, 8);
      h = mix_bits(h ^ word) + 0x9e3779b97f4a7c15ULL;
    }
    return h;
  }
};

// OpenEXR has threads of its own; they follow the limit of the others.
void set_threads() {
  const int threads = static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  const int requested = threads > 1 ? threads : 0;
  if (Imf::globalThreadCount() != requested) Imf::setGlobalThreadCount(requested);
}

}  // namespace

struct ExrWriter::State {
  // The bands to read back: enough to see that values arrive where they belong; that nothing is missing shows in the table of offsets.
  struct Sample {
    int y0 = -1;
    int rows = 0;
    std::uint64_t digest = 0;
  };
  struct Part {
    int next_row = 0;
    Sample first, last;
  };

  State(const std::string& path, int w, int h, const std::vector<PartSpec>& parts)
      : output(path), width(w), height(h), specs(parts), progress(parts.size()), stream(output.temporary()) {}

  // Says why the file cannot be written: the system's reason where there is one, else the library's.
  [[noreturn]] void fail(const std::string& reason) const {
    output.fail(stream.code() != 0 ? std::generic_category().message(stream.code()) : reason);
  }

  void write_band(std::size_t part, int y0, int rows, const float* interleaved);
  void verify() const;

  OutputFile output;
  int width;
  int height;
  std::vector<PartSpec> specs;
  std::vector<Part> progress;
  CheckedStream stream;
  std::unique_ptr<Imf::MultiPartOutputFile> file;  // after the stream: it writes when it is destroyed
};

void ExrWriter::State::write_band(std::size_t part, int y0, int rows, const float* interleaved) {
  const PartSpec& spec = specs[part];
  const std::size_t channels = spec.channels.size();
  Band band(spec, width, rows);
  parallel_rows(rows, [&](int r) {
    const std::size_t row = static_cast<std::size_t>(r) * static_cast<std::size_t>(width);
    for (std::size_t c = 0; c < channels; ++c) {
      const float* from = interleaved + row * channels + c;
      char* to = band.bytes.data() + band.start[c] + row * Band::value_bytes(spec.channels[c]);
      for (int x = 0; x < width; ++x, from += channels) {
        if (spec.channels[c].type == ChannelType::half) {
          const half h = to_half(*from);
          std::memcpy(to, &h, 2);
          to += 2;
        } else {
          std::memcpy(to, from, 4);  // as bits: an id may look like a signalling NaN
          to += 4;
        }
      }
    }
  });
  Imf::TiledOutputPart tiles(*file, static_cast<int>(part));
  tiles.setFrameBuffer(band.frame(output.path(), spec, width, y0));
  const int row = y0 / band_rows;
  tiles.writeTiles(0, tiles.numXTiles() - 1, row, row);
  if (y0 == 0) progress[part].first = {y0, rows, band.digest()};
  if (y0 + rows == height) progress[part].last = {y0, rows, band.digest()};
}

// Reads the first and last band of each part again from the temporary file.
void ExrWriter::State::verify() const {
  Imf::MultiPartInputFile again(output.temporary().c_str());
  for (std::size_t p = 0; p < specs.size(); ++p) {
    if (!again.partComplete(static_cast<int>(p))) fail("tiles are missing in part " + specs[p].name);
    for (const Sample& sample : {progress[p].first, progress[p].last}) {
      Band band(specs[p], width, sample.rows);
      Imf::InputPart input(again, static_cast<int>(p));
      input.setFrameBuffer(band.frame(output.path(), specs[p], width, sample.y0));
      input.readPixels(sample.y0, sample.y0 + sample.rows - 1);
      if (band.digest() != sample.digest) fail("part " + specs[p].name + " reads otherwise than it was written");
    }
  }
}

ExrWriter::ExrWriter(const std::string& path, int width, int height, const std::vector<PartSpec>& parts, const FileNotes& notes) {
  if (width < 1 || height < 1 || parts.empty()) throw Error(ErrorKind::bug, path, "a file without pixels or parts");
  std::vector<Imf::Header> headers;
  headers.reserve(parts.size());
  for (const PartSpec& part : parts) headers.push_back(make_header(path, width, height, part, headers.empty() ? notes : FileNotes{}));
  state_ = std::make_unique<State>(path, width, height, parts);
  if (state_->stream.code() != 0) state_->fail({});
  set_threads();
  try {
    state_->file = std::make_unique<Imf::MultiPartOutputFile>(state_->stream, headers.data(), static_cast<int>(headers.size()));
  } catch (const std::exception& e) {
    state_->fail(e.what());
  }
}

ExrWriter::~ExrWriter() = default;
ExrWriter::ExrWriter(ExrWriter&&) noexcept = default;
ExrWriter& ExrWriter::operator=(ExrWriter&&) noexcept = default;

void ExrWriter::write_rows(std::size_t part, int y0, int rows, const std::vector<float>& interleaved) {
  State& state = *state_;
  if (part >= state.specs.size() || state.file == nullptr) throw Error(ErrorKind::bug, state.output.path(), "rows of an unknown part");
  State::Part& progress = state.progress[part];
  const std::size_t row_values = static_cast<std::size_t>(state.width) * state.specs[part].channels.size();
  const bool whole = rows % band_rows == 0 || y0 + rows == state.height;
  if (rows < 1 || y0 != progress.next_row || y0 + rows > state.height || !whole ||
      interleaved.size() < row_values * static_cast<std::size_t>(rows)) {
    throw Error(ErrorKind::bug, state.output.path(),
                "rows " + std::to_string(y0) + " to " + std::to_string(y0 + rows) + " where row " + std::to_string(progress.next_row) +
                    " is next of " + std::to_string(state.height));
  }
  try {
    for (int y = 0; y < rows; y += band_rows) {
      state.write_band(part, y0 + y, std::min(band_rows, rows - y), interleaved.data() + row_values * static_cast<std::size_t>(y));
    }
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    state.fail(e.what());
  }
  progress.next_row = y0 + rows;
}

void ExrWriter::finish() {
  State& state = *state_;
  for (std::size_t p = 0; p < state.specs.size(); ++p) {
    if (state.progress[p].next_row != state.height) {
      throw Error(ErrorKind::bug, state.output.path(),
                  "part " + state.specs[p].name + " ends at row " + std::to_string(state.progress[p].next_row));
    }
  }
  state.file.reset();
  if (state.stream.close() != 0) state.fail({});
  try {
    state.verify();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {
    state.fail(e.what());
  }
  state.output.commit();
}

void write_exr(const std::string& path, const Image& linear, const FileNotes& notes) {
  const PartSpec part{"picture", {{"R", ChannelType::half}, {"G", ChannelType::half}, {"B", ChannelType::half}}};
  ExrWriter writer(path, linear.width(), linear.height(), {part}, notes);
  std::vector<float> band;
  for (int y = 0; y < linear.height(); y += ExrWriter::band_rows) {
    const int rows = std::min(ExrWriter::band_rows, linear.height() - y);
    const glm::vec3* from = linear.row(y);
    band.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows) * static_cast<std::size_t>(linear.width()); ++i) {
      band.insert(band.end(), {from[i].x, from[i].y, from[i].z});
    }
    writer.write_rows(0, y, rows, band);
  }
  writer.finish();
}

}  // namespace belvedere
