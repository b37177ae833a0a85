#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/guidance_buffers.h"
#include "renderer/image/exr/exr_writer.h"

namespace belvedere {

// Masks by name in OpenEXR as compositing programs read them: Cryptomatte 1.2 (Psyop), whose
// channels LAYER00.r, .g, .b, .a hold the two names that cover most of a pixel, each as an id and
// its share of the pixel.

// MurmurHash3_x86_32 with seed 0 (A. Appleby).
std::uint32_t murmur_hash3(std::string_view text);
// The id of a name: its hash as the bits of a float. A hash that would be zero, subnormal, infinite
// or no number gets another exponent.
float cryptomatte_id(std::string_view name);
// The attributes of a layer: its name, how ids are made, and a manifest of all names.
FileNotes cryptomatte_notes(const std::string& layer, const std::vector<std::string>& names);

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
