#include "renderer/image/exr/exr_reader.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfVersion.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <utility>

#include "base/error.h"
#include "renderer/image/image_file.h"

// Sizes are taken from our own reading of the header: opening a file with the library allocates
// tables of the size it claims.

namespace belvedere {
namespace {

using image_io::check_memory;
using image_io::throw_damaged;

struct PartHeader {
  Imf::Header header;
  std::string name;
  std::int64_t width = 0;
  std::int64_t height = 0;
};

// Runs f, converting the library's exceptions to Error(input).
template <class F>
auto guarded(const std::string& path, F&& f) {
  try {
    return f();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::limit, path, "does not fit into memory");
  } catch (const std::exception& e) {
    throw_damaged(path, e.what());
  }
}

std::uint32_t read_word(Imf::IStream& stream) {
  std::array<char, 4> bytes{};
  stream.read(bytes.data(), 4);
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i)
    word = word << 8 | static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(i)]);
  return word;
}

// The library takes the memory that an attribute claims before it reads it: sizes beyond the end of
// the file are refused first. Leaves the stream where it was.
void check_attributes(const std::string& path, Imf::StdIFStream& stream, std::uint64_t file_bytes) {
  const std::uint64_t begin = stream.tellg();
  const auto text_length = [&] {
    std::size_t length = 0;
    for (char c = 1; c != 0 && length <= 256; ++length) stream.read(&c, 1);
    return length - 1;
  };
  while (text_length() > 0) {  // its name; an empty one ends the header
    text_length();             // its type
    const auto bytes = static_cast<std::uint64_t>(static_cast<std::uint32_t>(read_word(stream)));
    const std::uint64_t at = stream.tellg();
    if (at + bytes > file_bytes) throw_damaged(path, "an attribute is longer than the file");
    stream.seekg(at + bytes);
  }
  stream.seekg(begin);
}

// The headers of all parts; nothing beyond them is read.
std::vector<PartHeader> read_headers(const std::string& path) {
  if (!image_io::first_bytes(path).starts_with("\x76\x2f\x31\x01"))
    throw Error(ErrorKind::input, path, "is not an OpenEXR file", "an OpenEXR file (.exr)");
  return guarded(path, [&] {
    Imf::StdIFStream stream(path.c_str());
    read_word(stream);
    int version = static_cast<int>(read_word(stream));
    if (Imf::getVersion(version) != Imf::EXR_VERSION ||
        !Imf::supportsFlags(Imf::getFlags(version))) {
      throw Error(ErrorKind::input, path, "is of an unknown version of OpenEXR");
    }
    if (Imf::isNonImage(version))
      throw Error(ErrorKind::input, path, "is a deep OpenEXR file", "a flat one");
    const std::uint64_t bytes = std::filesystem::file_size(path);
    std::vector<PartHeader> parts;
    while (true) {
      if (Imf::isMultiPart(version)) {
        // An empty header, a single zero, ends the list.
        char next = 0;
        const std::uint64_t at = stream.tellg();
        stream.read(&next, 1);
        if (next == 0) break;
        stream.seekg(at);
      }
      PartHeader part;
      check_attributes(path, stream, bytes);
      part.header.readFrom(stream, version);
      part.name = part.header.hasName() ? part.header.name() : "";
      const Imath::Box2i window = part.header.dataWindow();
      part.width = std::int64_t{window.max.x} - window.min.x + 1;
      part.height = std::int64_t{window.max.y} - window.min.y + 1;
      if (part.width < 1 || part.height < 1) throw_damaged(path, "a picture without pixels");
      parts.push_back(std::move(part));
      if (!Imf::isMultiPart(version)) break;
      if (parts.size() > 1000) throw_damaged(path, "more than 1000 parts");
    }
    if (parts.empty()) throw_damaged(path, "no parts");
    return parts;
  });
}

ChannelType channel_type(Imf::PixelType type) {
  return type == Imf::HALF   ? ChannelType::half
         : type == Imf::UINT ? ChannelType::uint32
                             : ChannelType::float32;
}

// Memory of `values` values per pixel of our own, one row of tiles or lines of the library's, and
// its table of offsets.
void check_part(const std::string& path, const PartHeader& part, int value_bytes) {
  double bytes = static_cast<double>(part.width) * static_cast<double>(part.height) * value_bytes;
  if (part.header.hasTileDescription()) {
    const Imf::TileDescription tile = part.header.tileDescription();
    double pixel_bytes = 0.0;
    for (auto c = part.header.channels().begin(); c != part.header.channels().end(); ++c)
      pixel_bytes += 4.0;
    const double across = std::max<double>(static_cast<double>(part.width), tile.xSize);
    bytes += across * tile.ySize * pixel_bytes;
    if (tile.xSize < 1 || tile.ySize < 1) throw_damaged(path, "tiles without pixels");
  }
  check_memory(path, part.width, part.height, bytes);
}

struct Target {
  std::string channel;
  Imf::PixelType type;
  char* first = nullptr;  // of the top left pixel
  std::size_t pixel_bytes = 0;
};

// Fills the targets from one part, all of it or an error.
void read_part(const std::string& path, std::size_t index, const PartHeader& part,
               const std::vector<Target>& targets) {
  guarded(path, [&] {
    Imf::MultiPartInputFile file(path.c_str());
    if (!file.partComplete(static_cast<int>(index)))
      throw_damaged(path, "tiles or rows are missing");
    Imf::InputPart input(file, static_cast<int>(index));
    const Imath::Box2i window = part.header.dataWindow();
    Imf::FrameBuffer frame;
    for (const Target& t : targets) {
      const std::size_t row_bytes = t.pixel_bytes * static_cast<std::size_t>(part.width);
      frame.insert(t.channel, Imf::Slice::Make(t.type, t.first, window, t.pixel_bytes, row_bytes));
    }
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
  });
}

const Imf::Channel* find_channel(const std::string& path, const PartHeader& part,
                                 const std::string& name) {
  const Imf::Channel* channel = part.header.channels().findChannel(name);
  if (channel != nullptr && (channel->xSampling != 1 || channel->ySampling != 1)) {
    throw Error(ErrorKind::input, path, "channel " + name + " is subsampled",
                "channels of full resolution");
  }
  return channel;
}

std::string list_channels(const std::vector<PartHeader>& parts) {
  std::string list;
  for (const PartHeader& part : parts) {
    for (auto c = part.header.channels().begin(); c != part.header.channels().end(); ++c) {
      list += (list.empty() ? "" : ", ") + std::string(c.name());
    }
  }
  return list;
}

// Channels by name from the first part that has them, each part read once; an absent channel gives
// an empty grid.
template <class T>
std::vector<Grid<T>> read_some(const std::string& path, const std::vector<PartHeader>& parts,
                               const std::vector<std::string>& channels, bool ids) {
  std::vector<Grid<T>> out(channels.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<std::size_t> present;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Imf::Channel* found =
          out[c].empty() ? find_channel(path, parts[p], channels[c]) : nullptr;
      if (found == nullptr) continue;
      if ((found->type == Imf::UINT) != ids) {
        throw Error(ErrorKind::input, path,
                    "channel " + channels[c] + (ids ? " contains no ids" : " contains ids"),
                    ids ? "32-bit whole numbers" : "half or float");
      }
      present.push_back(c);
    }
    if (present.empty()) continue;
    check_part(path, parts[p], static_cast<int>(sizeof(T) * present.size()));
    std::vector<Target> targets;
    for (const std::size_t c : present) {
      out[c] = Grid<T>(static_cast<int>(parts[p].width), static_cast<int>(parts[p].height));
      targets.push_back({channels[c], ids ? Imf::UINT : Imf::FLOAT,
                         reinterpret_cast<char*>(out[c].data()), sizeof(T)});
    }
    read_part(path, p, parts[p], targets);
  }
  return out;
}

template <class T>
Grid<T> read_one(const std::string& path, const std::string& channel, bool ids) {
  const std::vector<PartHeader> parts = read_headers(path);
  Grid<T> out = std::move(read_some<T>(path, parts, {channel}, ids).front());
  if (out.empty())
    throw Error(ErrorKind::input, path, "has no channel " + channel, list_channels(parts));
  return out;
}

// The central pixels of squares of step × step of one channel, a band of rows at a time.
Grid<float> sample_channel(const std::string& path, std::size_t index, const PartHeader& part,
                           const std::string& channel, bool ids, int step) {
  const int width = static_cast<int>(part.width);
  const int height = static_cast<int>(part.height);
  const auto centre = [&](int k, int end) { return std::min(k * step + step / 2, end - 1); };
  Grid<float> out((width + step - 1) / step, (height + step - 1) / step);
  const int band =
      part.header.hasTileDescription() ? static_cast<int>(part.header.tileDescription().ySize) : 64;
  guarded(path, [&] {
    Imf::MultiPartInputFile file(path.c_str());
    if (!file.partComplete(static_cast<int>(index)))
      throw_damaged(path, "tiles or rows are missing");
    Imf::InputPart input(file, static_cast<int>(index));
    const Imath::Box2i window = part.header.dataWindow();
    std::vector<std::uint32_t> rows(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(band));
    int next = 0;
    for (int y0 = 0; y0 < height; y0 += band) {
      const int y1 = std::min(height, y0 + band);
      if (centre(next, height) >= y1) continue;
      Imf::FrameBuffer frame;
      frame.insert(channel, Imf::Slice::Make(ids ? Imf::UINT : Imf::FLOAT, rows.data(),
                                             {window.min.x, window.min.y + y0}, width, y1 - y0));
      input.setFrameBuffer(frame);
      input.readPixels(window.min.y + y0, window.min.y + y1 - 1);
      for (; next < out.height() && centre(next, height) < y1; ++next)
        for (int x = 0; x < out.width(); ++x) {
          const std::size_t i = static_cast<std::size_t>(centre(next, height) - y0) *
                                    static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(centre(x, width));
          out(x, next) = ids ? static_cast<float>(rows[i]) : std::bit_cast<float>(rows[i]);
        }
    }
  });
  return out;
}

}  // namespace

ImageInfo read_exr_info(const std::string& path) {
  const std::vector<PartHeader> parts = read_headers(path);
  check_memory(path, parts[0].width, parts[0].height, 0.0);
  ImageInfo info;
  info.format = "openexr";
  info.width = static_cast<int>(parts[0].width);
  info.height = static_cast<int>(parts[0].height);
  for (const PartHeader& part : parts) {
    PartSpec spec{part.name, {}};
    for (auto c = part.header.channels().begin(); c != part.header.channels().end(); ++c) {
      spec.channels.push_back({c.name(), channel_type(c.channel().type)});
    }
    info.parts.push_back(std::move(spec));
  }
  for (auto a = parts[0].header.begin(); a != parts[0].header.end(); ++a) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
    const std::string key = a.name();
    if (text != nullptr && key != "name" && key != "type") info.notes[key] = text->value();
  }
  return info;
}

Grid<glm::vec3> read_exr_picture(const std::string& path, Grid<float>* alpha) {
  const std::vector<PartHeader> parts = read_headers(path);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const PartHeader& part = parts[p];
    const bool colour = find_channel(path, part, "R") != nullptr &&
                        find_channel(path, part, "G") != nullptr &&
                        find_channel(path, part, "B") != nullptr;
    if (!colour && find_channel(path, part, "Y") == nullptr) continue;
    check_part(path, part, alpha != nullptr ? 16 : 12);
    Grid<glm::vec3> out(static_cast<int>(part.width), static_cast<int>(part.height));
    std::vector<Target> targets;
    char* first = reinterpret_cast<char*>(out.data());
    if (colour) {
      for (int c = 0; c < 3; ++c)
        targets.push_back({std::string(1, "RGB"[c]), Imf::FLOAT, first + std::ptrdiff_t{4} * c,
                           sizeof(glm::vec3)});
    } else {
      targets.push_back({"Y", Imf::FLOAT, first, sizeof(glm::vec3)});
    }
    Grid<float> own;
    Grid<float>& opacity = alpha != nullptr ? *alpha : own;
    const bool has_alpha = find_channel(path, part, "A") != nullptr;
    if (alpha != nullptr || has_alpha) opacity = Grid<float>(out.width(), out.height(), 1.0f);
    if (has_alpha)
      targets.push_back({"A", Imf::FLOAT, reinterpret_cast<char*>(opacity.data()), sizeof(float)});
    read_part(path, p, part, targets);
    if (!colour) {
      for (glm::vec3& v : out) v = glm::vec3(v.x);
    }
    image_io::blacken_transparent(out, opacity);
    return out;
  }
  throw Error(ErrorKind::input, path, "contains no picture but " + list_channels(parts),
              "channels R, G, B or Y");
}

Grid<float> read_channel(const std::string& path, const std::string& channel) {
  return read_one<float>(path, channel, false);
}

std::vector<Grid<float>> read_channels(const std::string& path,
                                       const std::vector<std::string>& channels) {
  return read_some<float>(path, read_headers(path), channels, false);
}

std::vector<Grid<float>> read_sampled_channels(const std::string& path,
                                               const std::vector<std::string>& channels, int step) {
  const std::vector<PartHeader> parts = read_headers(path);
  std::vector<Grid<float>> out(channels.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const Imf::Channel* found =
          out[c].empty() ? find_channel(path, parts[p], channels[c]) : nullptr;
      if (found == nullptr) continue;
      check_memory(path, parts[p].width, parts[p].height,
                   4.0 * static_cast<double>(parts[p].width) * 64.0);
      out[c] = sample_channel(path, p, parts[p], channels[c], found->type == Imf::UINT,
                              std::max(1, step));
    }
  return out;
}

Grid<std::uint32_t> read_id_channel(const std::string& path, const std::string& channel) {
  return read_one<std::uint32_t>(path, channel, true);
}

void to_halves(const float* from, std::size_t step, std::size_t count, std::uint16_t* to) {
  for (std::size_t i = 0; i < count; ++i, from += step) {
    const float v = std::isfinite(*from) ? std::clamp(*from, -static_cast<float>(HALF_MAX),
                                                      static_cast<float>(HALF_MAX))
                                         : *from;
    to[i] = half(v).bits();
  }
}

void from_halves(const std::uint16_t* from, std::size_t count, float* to, std::size_t step) {
  for (std::size_t i = 0; i < count; ++i, to += step) {
    half value;
    value.setBits(from[i]);
    *to = static_cast<float>(value);
  }
}

}  // namespace belvedere
