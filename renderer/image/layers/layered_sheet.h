#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Encoded sRGB, not premultiplied, and opacity, 0…65535 each.
using LayerPixel = std::array<std::uint16_t, 4>;
// Provides rows [y0, y1) of a layer, may be called repeatedly.
using LayerRows = std::function<Grid<LayerPixel>(int y0, int y1)>;

struct LayerSource {
  std::string name;   // of files in an archive: letters, digits, _
  std::string title;  // shown to users, UTF-8
  bool hidden = false;
  LayerRows rows;
};
// A picture in layers of its size, from the bottom up, all in normal mode.
struct LayeredSheet {
  int width = 0;
  int height = 0;
  double dots_per_inch = 0.0;  // 0: not stated
  std::vector<LayerSource> layers;
  LayerRows merged;               // their composite, opaque
  double large_from_bytes = 2e9;  // from which a PSD is written in its large form
};
// Writes one, layer after layer and row by row. Writes to a temporary name and renames it when
// complete. Error(output).
using WriteLayers = void (*)(const std::string& path, const LayeredSheet& sheet,
                             Progress& progress);

}  // namespace belvedere
