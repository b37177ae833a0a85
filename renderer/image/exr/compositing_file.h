#pragma once

#include <string>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/image/exr/exr_writer.h"

namespace belvedere {

// Rows of a picture for compositing programs, all of one size.
struct CompositingRows {
  const GuidanceBuffers& guidance;     // the channels named by compositing_channels
  const Image& picture;                // scene-linear
  const Grid<MattePixel>& of_feature;  // ids from 1 count the names of features
};
// The channels that the file is made of, as --channels names them.
const std::vector<std::string>& compositing_channels();

// Writes guidance as Blender names its passes, in one part: ViewLayer.Combined (the picture),
// Depth (m; 1e10 in the sky), Position (m), Normal (both 0 in the sky), Shadow, AO (sky view),
// IndexMA (class), and Cryptomatte layers ViewLayer.CryptoLandCover and ViewLayer.CryptoFeature.
// Rows from top to bottom; the same bytes for the same values.
class CompositingWriter {
 public:
  CompositingWriter(const std::string& path, int width, int height,
                    const std::vector<std::string>& features, FileNotes notes);
  // Bands as in ExrWriter::write_rows.
  void write_rows(const CompositingRows& rows, int y0);
  void complete() { writer_.complete(); }
  void commit() { writer_.commit(); }

 private:
  std::vector<float> feature_ids_;  // of MattePixel::id
  ExrWriter writer_;
};

}  // namespace belvedere
