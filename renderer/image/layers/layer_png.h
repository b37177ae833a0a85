#pragma once

#include <string>

#include "renderer/image/layers/layered_sheet.h"

namespace belvedere {

// RGBA with 16 bits per channel, or with `opaque` RGB, row by row. Error(output).
void write_layer_png(const std::string& path, int width, int height, double dots_per_inch,
                     bool opaque, const LayerRows& rows, Progress& progress);
// The same with 8 bits, reduced by a whole factor to at most `longest_px` per side.
void write_thumbnail_png(const std::string& path, int width, int height, int longest_px,
                         const LayerRows& rows);
inline constexpr int layer_band_rows = 64;  // number of rows per request

}  // namespace belvedere
