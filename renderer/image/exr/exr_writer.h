#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/image.h"
#include "renderer/image/image_file.h"

namespace belvedere {

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

// Scene-linear picture as half EXR, primaries of sRGB in the header.
void write_exr(const std::string& path, const Image& linear, const FileNotes& notes);

}  // namespace belvedere
