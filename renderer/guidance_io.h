#pragma once

#include <memory>
#include <string>

#include "renderer/base/guidance_buffers.h"
#include "renderer/image_io.h"

namespace belvedere {

// Guidance buffers as one multi-part tiled EXR (design section 3: names, types, meanings). Rows top to bottom, streamed.
class GuidanceWriter {
 public:
  // notes: camera, CRS, origin, sun, resolved scene, versions, hashes; the legend is added here.
  GuidanceWriter(const std::string& path, int width, int height, const FileNotes& notes);
  // The rows [first, first + rows) of `part`, which stand at y0 in the picture. Bands as in ExrWriter::write_rows.
  void write_rows(const GuidanceBuffers& part, int first, int rows, int y0);
  void finish();

 private:
  ExrWriter writer_;
};

void write_guidance(const std::string& path, const GuidanceBuffers& guidance, const FileNotes& notes);
// Reads what the file has; absent channels stay empty grids.
GuidanceBuffers read_guidance(const std::string& path);

}  // namespace belvedere
