#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/image_file.h"
#include "renderer/image/rows/picture_rows.h"

namespace belvedere {

// Writes a multi-part tiled OpenEXR file (tiles of 64 × 64, ZIP) piece by piece, so that memory
// does not grow with the picture: it keeps some packed tiles and 8 bytes for each tile of the file.
// Channels of a part may have different types. Writes to a temporary name, reads the file again and
// compares, then renames it in finish(); without finish() the temporary file is removed. Same
// values, same bytes. Throws Error(output).
class ExrWriter {
 public:
  ExrWriter(const std::string& path, int width, int height, const std::vector<PartSpec>& parts,
            const FileNotes& notes);
  ~ExrWriter();
  ExrWriter(ExrWriter&&) noexcept;
  ExrWriter& operator=(ExrWriter&&) noexcept;

  // Writes `count` values of a channel of the part from pixel (x, y) of the picture on to out[0],
  // out[1] …: floats for half and float32 channels, the bits of a uint32 for uint32 channels.
  // Called by several threads at once, for pixels of the rows that are written.
  using Values = std::function<void(std::size_t channel, int x, int y, int count, float* out)>;
  // Rows y0 … y0 + rows of one part. y0 must be a multiple of band_rows, and so must rows except at
  // the bottom. Each part in order, top to bottom; the parts in any order. Half values beyond
  // ±65504 are clamped, infinities stay.
  void write_rows(std::size_t part, int y0, int rows, const Values& values);
  // The same from values that are pixel-interleaved in the part's channel order.
  void write_rows(std::size_t part, int y0, int rows, const std::vector<float>& interleaved);
  // complete() and commit().
  void finish();
  // Flushes the file to disk under its temporary name and reads it again. Error(output) where that
  // fails, Error(bug) where rows are missing.
  void complete();
  void commit();

  static constexpr int band_rows = 64;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Scene-linear picture as half EXR, primaries of sRGB in the header, row by row.
std::unique_ptr<PictureRows> open_exr(const std::string& path, int width, int height,
                                      const FileNotes& notes);
// Maximum memory: a row of tiles.
double exr_writer_bytes(int width, int height);
void write_exr(const std::string& path, const Image& linear, const FileNotes& notes);

}  // namespace belvedere
