#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/grid.h"
#include "renderer/base/image.h"
#include "renderer/base/parallel.h"

namespace belvedere {

// Everything the program says in a file's header: provenance and what readers need. Keys as in OpenEXR, values as text.
using FileNotes = std::map<std::string, std::string>;

// Values of one channel in memory while it is read or written. Exactly one grid is filled, by `type`.
enum class ChannelType { half, float32, uint32 };
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

// Writes a multi-part tiled OpenEXR file piece by piece, so that memory does not grow with the picture. Goes to a
// temporary name, is reopened and checked, then renamed by finish(); without finish() the temporary file is removed.
// image_io.cpp is the only file that knows OpenImageIO. Throws Error(output).
class ExrWriter {
 public:
  ExrWriter(const std::string& path, int width, int height, const std::vector<PartSpec>& parts, const FileNotes& notes);
  ~ExrWriter();
  // Rows y0 … y0 + rows of one part, pixel-interleaved in the part's channel order: float for half and float32 channels, the bits of a
  // uint32 for uint32 channels. y0 must be a multiple of the tile height (64), rows as well but at the bottom. In order, top to bottom.
  void write_rows(std::size_t part, int y0, int rows, const std::vector<float>& interleaved);
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// What a file holds, without reading its pixels.
struct ImageInfo {
  int width = 0;
  int height = 0;
  std::string format;               // "openexr", "tiff", "png" …
  std::vector<PartSpec> parts;
  FileNotes notes;
};
ImageInfo read_image_info(const std::string& path);
// One channel of any part by name; half and float32 as float. Error(input) if absent or damaged, Error(limit) over memory_limit_bytes().
Grid<float> read_channel(const std::string& path, const std::string& channel);
Grid<std::uint32_t> read_id_channel(const std::string& path, const std::string& channel);

// A picture from any format, as it stands in the file: values 0…1 for integer formats. Colours are not converted. Grey
// becomes RGB, alpha is dropped (`alpha` gets it where asked for). Size checked before allocating.
Grid<glm::vec3> read_picture(const std::string& path, Grid<float>* alpha = nullptr);
// An 8- or 16-bit grey image as numbers, unscaled: label masks, altitude guides. Palette images by index where the format has one.
Grid<std::uint16_t> read_grey(const std::string& path);

struct PictureFileOptions {
  double dots_per_inch = 0.0;            // 0: not stated
  std::vector<std::uint8_t> icc_profile; // embedded as it is; empty: none
  FileNotes notes;
};
// Encoded RGB 0…1 as 16-bit tiled TIFF (deflate, BigTIFF from 2 GiB) or 8-bit PNG. Temporary file, check, rename. Error(output).
void write_tiff16(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);
void write_png8(const std::string& path, const Grid<glm::vec3>& encoded, const PictureFileOptions& options);
// Scene-linear picture as half EXR.
void write_exr(const std::string& path, const Image& linear, const FileNotes& notes);

// Bytes an image may take in memory: ¾ of the machine's, or BELVEDERE_MEMORY_MIB. Checked from headers before allocating.
std::uint64_t memory_limit_bytes();
// Error(output) unless a file could be created in the folder (made where it is missing).
void check_output_folder(const std::string& folder);

}  // namespace belvedere
