#pragma once

#include <memory>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// The result of warp_rasters for a frame, window by window, equal to the bit for any window: for
// frames that are larger than memory. The files stay open; not thread-safe. Throws as warp_rasters
// does.
class RasterWindows {
 public:
  RasterWindows(const std::vector<RasterSource>& sources, const RasterFrame& frame);
  ~RasterWindows();
  RasterWindows(const RasterWindows&) = delete;
  RasterWindows& operator=(const RasterWindows&) = delete;

  const RasterFrame& frame() const { return frame_; }
  // Values in metres, voids NaN. The window must lie inside the frame.
  Grid<float> read(const PixelRect& window);
  // Notes on the cells that were taken as void so far though no header says so.
  void note_dropped(Progress& progress) const;

 private:
  struct State;
  RasterFrame frame_;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
