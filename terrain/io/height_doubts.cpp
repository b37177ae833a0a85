#include "terrain/io/height_doubts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/statistics.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/http_access.h"

namespace belvedere {
namespace {

std::string doubt_of_position(const RasterFile& file) {
  if (file.crs().empty()) return {};
  const std::string doubt = doubt_of_place(file.crs(), centre_of(file));
  return doubt.empty() ? doubt
                       : fmt::format("{}: lies at {}; check its coordinate system (`crs`)",
                                     file.source().path, doubt);
}

// Refuses a band of colours: a picture of the terrain instead of a DEM.
void refuse_colours(const RasterFile& file) {
  const BandMeaning meaning = file.meaning();
  if (!meaning.palette && !meaning.colour) return;
  throw Error(
      ErrorKind::input, file.source().path,
      meaning.palette ? fmt::format("band {} contains indices of a colour palette, not heights",
                                    file.source().band)
                      : fmt::format("is a colour picture (band {} of {} is {}), not heights",
                                    file.source().band, file.bands(), meaning.name),
      fmt::format("the elevation model itself, with heights as numbers; {}", encoding_advice));
}

// Mean side of a cell on the ground, m.
double cell_on_ground_m(const RasterFile& file) {
  constexpr double degree_m = 111000.0;
  const double side = std::sqrt(std::abs(file.affine().determinant()));
  return !file.crs().empty() && crs_traits(file.crs()).geographic ? side * degree_m : side;
}

// A coast rises by less than 45° over its first cell, except where it is a cliff.
double max_coast_step_m(const RasterFile& file) {
  return std::clamp(cell_on_ground_m(file), 20.0, 300.0);
}

// Steeper than 79° on all sides, and higher than nearly every tower.
double min_spike_m(const RasterFile& file) { return std::max(5.0 * cell_on_ground_m(file), 150.0); }

// The median of |altitude| of the cells beside one of exactly 0, m; 0 if there are few. Of all rows
// of a small file, else of some pairs of rows.
double step_beside_zero(const RasterFile& file) {
  constexpr int all_rows = 2048, pairs = 24;
  constexpr std::size_t min_steps = 8;
  const bool all = file.height() <= all_rows;
  if (!all && is_address(file.source().path)) return 0.0;  // too much to fetch
  const int step = all ? 1 : file.height() / pairs;
  std::vector<float> beside;
  const auto add = [&](float a, float b) {
    if ((a == 0.F) != (b == 0.F) && !std::isnan(a) && !std::isnan(b))
      beside.push_back(std::abs(a + b));
  };
  for (int y = 0; y + 1 < file.height(); y += step) {
    const Grid<float> rows = file.read_values({0, y, file.width(), 2});
    for (int x = 0; x < file.width(); ++x) {
      add(rows(x, 0), rows(x, 1));
      if (x > 0) add(rows(x - 1, 0), rows(x, 0));
    }
  }
  return beside.size() < min_steps ? 0.0 : static_cast<double>(middle_value(std::move(beside)));
}

}  // namespace

std::vector<RasterSource> check_height_sources(const std::vector<RasterSource>& sources,
                                               Progress& progress) {
  std::vector<RasterSource> checked = sources;
  for (RasterSource& source : checked) {
    const RasterFile file(source);
    refuse_colours(file);
    if (file.meaning().bytes)
      progress.note(
          fmt::format("{}: has 8 bits, so heights are limited to 0…255; check that it is not a "
                      "shaded relief or another picture",
                      source.path));
    if (const double feet = file.undeclared_foot_m(); feet > 0.0)
      progress.note(fmt::format(
          "{}: its coordinate system is in feet, but its heights have no unit and are read as "
          "metres; if they are feet too, set `unit = \"{}\"`",
          source.path, feet == 0.3048 ? "ft" : "us-ft"));
    if (const std::string doubt = doubt_of_position(file); !doubt.empty()) progress.note(doubt);
    if (const double step_m = source.nodata ? 0.0 : step_beside_zero(file);
        step_m > max_coast_step_m(file)) {
      progress.note(fmt::format(
          "{}: cells of 0 are taken as void, because the ground beside them is {:.0f} m "
          "away from 0; if they are sea, set `nodata` to a value that the file lacks",
          source.path, step_m));
      source.nodata = 0.0;
    }
    if (source.max_spike_m == 0.0) source.max_spike_m = min_spike_m(file);
  }
  return checked;
}

void note_dropped_cells(const RasterFile& file, Progress& progress) {
  for (const float value : file.undeclared_voids())
    progress.note(
        file.wrapped_nodata() && value == static_cast<float>(*file.wrapped_nodata())
            ? fmt::format("{}: cells of {:.0f} are taken as void, because its nodata value {:.0f} "
                          "is outside the range of its cells and becomes that number in them",
                          file.source().path, *file.wrapped_nodata(), file.nodata().value_or(0.0))
            : fmt::format("{}: cells of {:.0f} are taken as void, though its header does not say "
                          "so (`nodata`)",
                          file.source().path, value));
  if (const RasterFile::Spikes spikes = file.spikes(); spikes.count > 0)
    progress.note(fmt::format(
        "{}: {}{} single cells are taken as void, because they differ from all around them by more "
        "than {:.0f} m; the first is {:.0f} m at column {}, row {}",
        file.source().path, spikes.more ? "at least " : "", spikes.count, file.source().max_spike_m,
        spikes.first_m, spikes.first_x, spikes.first_y));
}

void note_height_range(const std::string& where, float lowest_m, float highest_m,
                       Progress& progress) {
  if (highest_m > highest_ground_m)
    progress.note(
        fmt::format("{}: altitudes from {:.0f} to {:.0f} m exceed the highest mountain; check "
                    "whether the unit is feet (`unit`), or set `highest_m` or `nodata`",
                    where, lowest_m, highest_m));
  if (lowest_m < lowest_ground_m)
    progress.note(
        fmt::format("{}: altitudes from {:.0f} to {:.0f} m are below the deepest sea; set "
                    "`lowest_m`, or `nodata` to the value of cells without a height",
                    where, lowest_m, highest_m));
}

}  // namespace belvedere
