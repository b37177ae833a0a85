#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/grid.h"

// Shared by the files of the formats.

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

namespace image_io {

// In ImageInfo::notes: Exif orientation 2…8 of a picture that readers turn upright.
inline constexpr const char* orientation_note = "Orientation";
// The same for a TIFF of CIE L*a*b*, which is read in sRGB.
inline constexpr const char* lab_note = "CIE Lab";
// The page of a TIFF that is read, where it is not the only one or not the first.
inline constexpr const char* page_note = "Page";

// The first bytes of a file, at most 16, which identify its format. Error(input) where it cannot be
// opened.
std::string first_bytes(const std::string& path);
// For a file that read_grey refuses.
Error no_grey_picture(const std::string& path);
[[noreturn]] void throw_damaged(const std::string& path, const std::string& reason);
// Error(limit) where `bytes`, needed to read this width × height picture, are over
// memory_budget_bytes().
void check_memory(const std::string& path, std::int64_t width, std::int64_t height, double bytes);

// Colours under full transparency are not seen, and differ by the program that wrote them.
void blacken_transparent(Grid<glm::vec3>& picture, const Grid<float>& alpha);

// Notes as one text for formats that have a single description: a first line that marks it, then
// `key: value` lines with \n and \\ for line feed and backslash. Text without that first line gives
// one note, "ImageDescription".
std::string join_notes(const FileNotes& notes);
FileNotes split_notes(const std::string& text);

// Rows [first, first + rows) of a picture as whole numbers 0…`highest`, rounded; a row of `out` has
// room for row_pixels ≥ width pixels, of which those beyond the picture are not changed.
template <class Number>
void quantize_rows(const Grid<glm::vec3>& encoded, int first, int rows, int row_pixels,
                   Number* out);

}  // namespace image_io

}  // namespace belvedere
