#include "terrain/io/dem.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/io/crs.h"
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

double Dem::blur_cells(double sigma_m) const {
  const double cells = sigma_m / cell_m();
  if (halved == 0) return cells;
  return std::sqrt(std::max(0.0, cells * cells - 0.3 * (1.0 - std::ldexp(1.0, -2 * halved))));
}

namespace {

std::size_t count_voids(const Grid<float>& altitude_m) {
  return static_cast<std::size_t>(std::count_if(altitude_m.begin(), altitude_m.end(),
                                                [](float z) { return !std::isfinite(z); }));
}

// Half the size: the mean of the known cells among 2 × 2, void if there are none.
Grid<float> halve(const Grid<float>& fine) {
  Grid<float> coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  parallel_rows(coarse.height(), [&](int y) {
    for (int x = 0; x < coarse.width(); ++x) {
      double sum = 0.0;
      int known = 0;
      for (int v = 2 * y; v < std::min(2 * y + 2, fine.height()); ++v)
        for (int u = 2 * x; u < std::min(2 * x + 2, fine.width()); ++u)
          if (!std::isnan(fine(u, v))) {
            sum += fine(u, v);
            ++known;
          }
      coarse(x, y) = known > 0 ? static_cast<float>(sum / known) : NAN;
    }
  });
  return coarse;
}

// A fine cell's value in a coarser grid whose cells cover 2 × 2 of its own: bilinear.
float from_coarse(const Grid<float>& coarse, int x, int y) {
  const int cx = x / 2;
  const int cy = y / 2;
  const int nx = std::clamp(cx + (x % 2 == 0 ? -1 : 1), 0, coarse.width() - 1);
  const int ny = std::clamp(cy + (y % 2 == 0 ? -1 : 1), 0, coarse.height() - 1);
  return 0.5625F * coarse(cx, cy) + 0.1875F * (coarse(nx, cy) + coarse(cx, ny)) +
         0.0625F * coarse(nx, ny);
}

// A membrane stretched over the voids from their borders: continuous there, and between the lowest
// and highest altitude of the border inside. Coarse to fine, as the first pass of a multigrid
// solver.
void fill_voids(Grid<float>& z) {
  std::vector<std::size_t> voids;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (std::isnan(z[i])) voids.push_back(i);
  if (voids.empty()) return;
  Grid<float> coarse = halve(z);
  fill_voids(coarse);
  const auto width = static_cast<std::size_t>(z.width());
  for (const std::size_t i : voids)
    z[i] = from_coarse(coarse, static_cast<int>(i % width), static_cast<int>(i / width));
  relax_voids(z, voids);
}

}  // namespace

void relax_voids(Grid<float>& z, const std::vector<std::size_t>& voids) {
  constexpr int rounds = 24;
  std::vector<float> next(voids.size());
  const auto width = static_cast<std::size_t>(z.width());
  for (int round = 0; round < rounds; ++round) {
    parallel_ranges(voids.size(), std::size_t{4096}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const auto x = static_cast<int>(voids[i] % width);
        const auto y = static_cast<int>(voids[i] / width);
        // Reflecting borders: at the edge of the raster the fill is level.
        const float sum =
            z.clamped(x - 1, y) + z.clamped(x + 1, y) + z.clamped(x, y - 1) + z.clamped(x, y + 1);
        next[i] = 0.2F * (sum + z[voids[i]]);
      }
    });
    for (std::size_t i = 0; i < voids.size(); ++i) z[voids[i]] = next[i];
  }
}

Dem make_dem(Raster<float> raster) {
  if (raster.cells.empty()) throw Error(ErrorKind::input, "terrain", "has no cells");
  Dem dem;
  dem.filled = Grid<std::uint8_t>(raster.cells.width(), raster.cells.height(), 0);
  std::size_t voids = 0;
  for (std::size_t i = 0; i < raster.cells.size(); ++i) {
    if (std::isfinite(raster.cells[i])) continue;
    raster.cells[i] = NAN;
    dem.filled[i] = 1;
    ++voids;
  }
  if (voids == raster.cells.size()) throw Error(ErrorKind::input, "terrain", "has only void cells");
  dem.altitude_m = std::move(raster.cells);
  fill_voids(dem.altitude_m);
  dem.transform = raster.transform;
  dem.crs = std::move(raster.crs);
  return dem;
}

Dem read_dem(const DemParameters& parameters, Progress& progress) {
  const double cell_m = parameters.cell_m;
  if (cell_m != 0.0 && !(cell_m >= 0.1 && cell_m <= 10000.0))
    throw Error(ErrorKind::usage, "cell_m", fmt::format("{}", cell_m), "0.1…10000 m, or 0");
  const double max = parameters.max_void_share;
  if (!(max >= 0.0 && max <= 1.0))
    throw Error(ErrorKind::usage, "max_void_share", fmt::format("{}", max), "0…1");
  const RasterFrame frame =
      choose_frame(parameters.sources, parameters.crs, cell_m, parameters.extent);
  const std::vector<RasterSource> sources = check_height_sources(parameters.sources, progress);
  // Altitudes, the mask of filled cells, and a third of both for the coarser levels of the fill.
  check_memory(fmt::format("terrain of {} × {} cells", frame.width, frame.height),
               8.0 * frame.width * frame.height);
  Raster<float> raster = warp_rasters(sources, frame, progress);
  const std::size_t voids = count_voids(raster.cells);
  const double share = static_cast<double>(voids) / static_cast<double>(raster.cells.size());
  const std::string where = parameters.sources.size() == 1
                                ? parameters.sources[0].path
                                : fmt::format("{} and {} more", parameters.sources[0].path,
                                              parameters.sources.size() - 1);
  if (share > max || voids == raster.cells.size()) {
    throw Error(ErrorKind::input, where,
                fmt::format("{:.1f} % of the terrain is void ({} of {} cells)", 100.0 * share,
                            voids, raster.cells.size()),
                fmt::format("at most {:.1f} % (`max_void_share`); use an `extent` within the data, "
                            "or another source for the gaps",
                            100.0 * max));
  }
  if (voids > 0)
    progress.note(fmt::format("{}: {} void cells ({:.2f} %) filled by interpolation", where, voids,
                              100.0 * share));
  Dem dem = make_dem(std::move(raster));
  const auto [low, high] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  note_height_range(where, *low, *high, progress);
  return dem;
}

Dem read_own_dem(const RasterSource& source, Progress& progress) {
  Dem dem = make_dem(read_raster(check_height_sources({source}, progress)[0], progress));
  const auto [low, high] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  note_height_range(source.path, *low, *high, progress);
  return dem;
}

}  // namespace belvedere
