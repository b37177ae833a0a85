#include "terrain/io/raster_thinned.h"

#include <algorithm>

#include "terrain/io/height_doubts.h"
#include "terrain/io/raster_file.h"

namespace belvedere {

std::optional<Raster<float>> read_thinned(const RasterSource& source, int longest,
                                          Progress& progress) {
  const RasterFile file(source);
  const CellAffine& a = file.affine();
  if (!a.axis_aligned() || a.x_column <= 0.0 || a.y_row >= 0.0) return std::nullopt;
  const int factor = std::max(1, (std::max(file.width(), file.height()) + longest - 1) / longest);
  const int width = std::max(1, file.width() / factor);
  const int height = std::max(1, file.height() / factor);
  Raster<float> out;
  out.cells = file.read_values({0, 0, file.width(), file.height()}, width, height);
  note_dropped_cells(file, progress);
  out.crs = file.required_crs();
  out.transform = {a.x0, a.y0, a.x_column * file.width() / width,
                   -a.y_row * file.height() / height};
  return out;
}

}  // namespace belvedere
