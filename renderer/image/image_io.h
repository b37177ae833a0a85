#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/image.h"
#include "base/parallel.h"

namespace belvedere {

// Everything the program says in a file's header: provenance and what readers need. Keys as in OpenEXR (but not the
// names of its own attributes, such as channels, name, type, version, view), values as text.
using FileNotes = std::map<std::string, std::string>;

// The type of a channel's values in a file. The program writes OpenEXR with the first three; uint8 and uint16 are what PNG, TIFF and
// JPEG hold.
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
};

// Which file knows which library: image_io.cpp OpenImageIO (reads PNG, TIFF, JPEG, writes PNG), image_io_exr*.cpp OpenEXR,
// image_io_tiff.cpp libtiff, image_io_palette.cpp libpng. OpenEXR and TIFF are written without OpenImageIO, because it can write the parts
// of a file only one after the other, each whole, and because bytes of its TIFF files depend on the date, on the number of threads and on
// memory that was never set.

// Writes a multi-part tiled OpenEXR file (tiles of 64 × 64, ZIP) piece by piece, so that memory does not grow with the picture: it keeps
// one band of one part. Channels of a part may have different types. Goes to a temporary name, is reopened and checked, then
// renamed by finish(); without finish() the temporary file is removed. Same values, same bytes. Throws Error(output).
class ExrWriter {
 public:
  ExrWriter(const std::string& path, int width, int height, const std::vector<PartSpec>& parts, const FileNotes& notes);
  ~ExrWriter();
  ExrWriter(ExrWriter&&) noexcept;
  ExrWriter& operator=(ExrWriter&&) noexcept;
  // Rows y0 … y0 + rows of one part, pixel-interleaved in the part's channel order: float for half and float32 channels, the bits of a
  // uint32 for uint32 channels. y0 must be a multiple of band_rows, rows as well but at the bottom. Each part in order, top to bottom;
  // the parts in any order. Half values beyond ±65504 are cut to that, infinities stay.
  void write_rows(std::size_t part, int y0, int rows, const std::vector<float>& interleaved);
  // Error(output) where the file cannot be completed, Error(bug) where rows are missing.
  void finish();

  static constexpr int band_rows = 64;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What a file holds, without reading its pixels.
struct ImageInfo {
  int width = 0;
  int height = 0;
  std::string format;           // "openexr", "tiff", "png" …
  std::vector<PartSpec> parts;  // OpenEXR lists channels by name, in the order of the alphabet
  FileNotes notes;
  double dots_per_inch = 0.0;  // 0: not stated
  std::vector<std::uint8_t> icc_profile;
};
// PNG, TIFF, JPEG or OpenEXR, known by their first bytes whatever the name. Error(input) for anything else or a damaged header.
ImageInfo read_image_info(const std::string& path);
// One channel of any part of an OpenEXR file by name; half and float32 as float. Error(input) if absent, of the other kind or damaged,
// Error(limit) over memory_budget_bytes() (base/memory_limit.h).
Grid<float> read_channel(const std::string& path, const std::string& channel);
// Several at once, so that a part is unpacked only once; an absent one gives an empty grid.
std::vector<Grid<float>> read_channels(const std::string& path, const std::vector<std::string>& channels);
Grid<std::uint32_t> read_id_channel(const std::string& path, const std::string& channel);

// A picture from PNG, TIFF, JPEG or OpenEXR (channels R G B or Y), as it stands in the file: values 0…1 for integer formats. Colours are
// not converted, and not multiplied by alpha. Grey becomes RGB, palettes are looked up, alpha is dropped (`alpha` gets it where asked for;
// 1 where the file has none). Size checked before allocating: Error(limit). Error(input): missing, another format, CMYK, cut off.
Grid<glm::vec3> read_picture(const std::string& path, Grid<float>* alpha = nullptr);
// A grey image of 16 bits or fewer (PNG, TIFF) as numbers, unscaled: label masks, altitude guides. A palette PNG gives its indices.
// Error(input) for colour pictures and what read_picture refuses.
Grid<std::uint16_t> read_grey(const std::string& path);

struct PictureFileOptions {
  double dots_per_inch = 0.0;             // 0: not stated
  std::vector<std::uint8_t> icc_profile;  // embedded as it is; empty: none
  FileNotes notes;
  std::uint64_t big_tiff_from_bytes = std::uint64_t{2} << 30;  // uncompressed size from which a TIFF is a BigTIFF
};
// Encoded RGB 0…1 as 16-bit tiled TIFF (deflate with predictor) or 8-bit PNG (marked as sRGB where it has no profile). Values are cut to
// 0…1 and rounded to the nearest step, no dither; NaN is 0. Temporary file, every pixel read back and compared, rename. Same values, same
// bytes. Error(output).
void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);
void write_png8(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);
// Scene-linear picture as half EXR, primaries of sRGB in the header.
void write_exr(const std::string& path, const Image& linear, const FileNotes& notes);

// Error(output) unless a file could be created in the folder (made where it is missing).
void check_output_folder(const std::string& folder);

}  // namespace belvedere
