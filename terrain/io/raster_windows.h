#pragma once

#include <memory>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// What warp_rasters makes of a frame, window by window, to the bit wherever a window lies: for frames that are larger than memory. The
// files stay open; for one thread at a time. Throws as warp_rasters does.
class RasterWindows {
 public:
  RasterWindows(const std::vector<RasterSource>& sources, const RasterFrame& frame);
  ~RasterWindows();
  RasterWindows(const RasterWindows&) = delete;
  RasterWindows& operator=(const RasterWindows&) = delete;

  const RasterFrame& frame() const { return frame_; }
  // Values in metres, voids NaN. The window lies inside the frame.
  Grid<float> read(const PixelRect& window);

 private:
  struct State;
  RasterFrame frame_;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
