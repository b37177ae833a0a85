#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/image/image_io.h"

namespace belvedere {

// Guidance buffers as one multi-part tiled OpenEXR: parts, channels and types as in the table of
// base/guidance_buffers.h. A part holds channels that are used together, so that a reader unpacks
// no more than it needs. The header's note "legend" has a line `id name rrggbb` for each class.

// Writes rows from top to bottom, streamed: besides the given rows, memory holds some packed tiles
// of one part.
class GuidanceWriter {
 public:
  // notes: camera, CRS, origin, sun, resolved scene, versions, hashes; the legend is added here.
  GuidanceWriter(const std::string& path, int width, int height, const FileNotes& notes);
  // The rows [first, first + rows) of `part`, at y0 in the picture. Bands as in
  // ExrWriter::write_rows. The non-empty grids of the first call determine the channels of the
  // file; Error(bug) where a later call lacks one.
  void write_rows(const GuidanceBuffers& part, int first, int rows, int y0);
  void finish();
  // The same in two steps, for files that appear together: complete() writes the rest and checks
  // it, commit() replaces the older file.
  void complete();
  void commit();

 private:
  std::string path_;
  int width_;
  int height_;
  FileNotes notes_;
  std::optional<ExrWriter> writer_;              // made with the first rows
  std::vector<std::vector<std::size_t>> parts_;  // for each part of the file its channels, as
                                                 // indices in the list of all file channels
};

void write_guidance(const std::string& path, const GuidanceBuffers& guidance,
                    const FileNotes& notes);
// Reads the channels of the file; absent ones stay empty grids. Directions are normalized again, as
// half is not exact. Error(input): no guidance at all, parts of different size, a vector without
// one of its components, an unknown class id.
GuidanceBuffers read_guidance(const std::string& path);

}  // namespace belvedere
