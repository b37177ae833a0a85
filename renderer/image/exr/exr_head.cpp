#include "renderer/image/exr/exr_head.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescriptionAttribute.h>
#include <ImfVersion.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "base/error.h"

namespace belvedere {
namespace {

constexpr std::size_t longest_name = 31;

// What the library writes, in memory.
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

}  // namespace

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

}  // namespace belvedere
