#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Types shared by picture files of all formats.

// The notes in a file's header: provenance and data for readers. Keys as in OpenEXR (but not the
// names of its own attributes, such as channels, name, type, version, view), values as text.
using FileNotes = std::map<std::string, std::string>;

// The type of a channel's values in a file. The program writes OpenEXR with the first three; uint8
// and uint16 are what PNG, TIFF and JPEG hold.
enum class ChannelType { half, float32, uint32, uint8, uint16 };
struct ChannelSpec {
  std::string name;  // "Z", "P.X", "landcover.id" …
  ChannelType type = ChannelType::float32;
  bool operator==(const ChannelSpec&) const = default;
};

// One part of a multi-part file.
struct PartSpec {
  std::string name;
  std::vector<ChannelSpec> channels;
  FileNotes notes = {};  // of this part alone
};

// Properties of a file, without reading its pixels.
struct ImageInfo {
  int width = 0;
  int height = 0;
  std::string format;           // "openexr", "tiff", "png" …
  std::vector<PartSpec> parts;  // OpenEXR lists channels alphabetically
  FileNotes notes;
  double dots_per_inch = 0.0;  // 0: not stated
  std::vector<std::uint8_t> icc_profile;
};

// Receives rows of a picture that is read from top to bottom, first row `y0`.
using UsePictureRows = std::function<void(int y0, const Grid<glm::vec3>& rows)>;

struct PictureFileOptions {
  double dots_per_inch = 0.0;             // 0: not stated
  std::vector<std::uint8_t> icc_profile;  // embedded unchanged; empty: none
  FileNotes notes;
  std::uint64_t big_tiff_from_bytes = std::uint64_t{2}
                                      << 30;  // uncompressed size from which a TIFF is a BigTIFF
};

}  // namespace belvedere
