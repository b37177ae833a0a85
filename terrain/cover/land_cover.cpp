#include "terrain/cover/land_cover.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/io/crs.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {
namespace {

// bspline_weights, but rounded in a different order, which pixels on the border of two classes
// depend on.
std::array<double, 4> class_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (4.0 + t * t * (3.0 * t - 6.0)) / 6.0,
          (4.0 + s * s * (3.0 * s - 6.0)) / 6.0, t * t * t / 6.0};
}

// True if the 2 × 2 cells around a position, of which (x, y) is the first, are of one class. They
// have at least 25/36 of the weights, 5/6 along each axis, so that class is the largest whatever
// surrounds them. This is the common case and makes lookups cheap.
bool is_uniform(const Grid<LandCoverClass>& cells, int x, int y) {
  const LandCoverClass* above = cells.row(y) + x;
  const LandCoverClass* below = cells.row(y + 1) + x;
  return above[0] == above[1] && above[0] == below[0] && above[0] == below[1];
}

// Codes to classes. Unknown codes are counted for a single message.
Grid<LandCoverClass> classify(const Grid<std::int32_t>& codes, const Legend& legend,
                              const LandCoverParameters& parameters, Progress& progress) {
  Grid<LandCoverClass> classes(codes.width(), codes.height(), LandCoverClass::sky);
  std::map<std::int32_t, std::size_t> unknown;
  std::int32_t last_code = -1;
  LandCoverClass last_class = LandCoverClass::sky;  // neighbours are usually equal
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::int32_t code = codes[i];
    if (code < 0) continue;
    if (code != last_code) {
      last_code = code;
      const auto found = legend.entries.find(code);
      const bool nothing = found == legend.entries.end() && legend.nodata.contains(code);
      const bool odd = found == legend.entries.end() && !nothing;
      last_class = nothing ? LandCoverClass::sky
                   : odd   ? parameters.unknown.value_or(LandCoverClass::sky)
                           : found->second.painted_as;
      if (odd) unknown.try_emplace(code, 0);
    }
    classes[i] = last_class;
    if (!unknown.empty())
      if (const auto count = unknown.find(code); count != unknown.end()) ++count->second;
  }
  if (unknown.empty()) return classes;
  std::string list;
  for (const auto& [code, count] : unknown)
    list += fmt::format("{}{} ({} cells)", list.empty() ? "" : ", ", code, count);
  const std::string where = parameters.sources[0].path;
  if (!parameters.unknown) {
    throw Error(
        ErrorKind::input, where,
        fmt::format("codes missing from the legend {}: {}", legend.name, list),
        "codes of the legend; use another legend, or set `unknown` to the class to paint them as");
  }
  progress.note(fmt::format("{}: painted as {}, because they are missing from the legend {}: {}",
                            where, class_name(*parameters.unknown), legend.name, list));
  return classes;
}

// Unknown cells take the scene's class for them, or that of the nearest known cell.
void fill_unknown(Grid<LandCoverClass>& classes, const LandCoverParameters& parameters,
                  Progress& progress) {
  Grid<std::uint8_t> known(classes.width(), classes.height(), 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    known[i] = classes[i] != LandCoverClass::sky ? 1 : 0;
    count += known[i];
  }
  if (count == classes.size()) return;
  const std::string where = parameters.sources[0].path;
  const double share =
      100.0 * static_cast<double>(classes.size() - count) / static_cast<double>(classes.size());
  if (count == 0 && !parameters.nodata)
    throw Error(ErrorKind::input, where, "has no land cover within the scene's terrain");
  progress.note(fmt::format("{}: no land cover on {:.1f} % of the terrain: {}", where, share,
                            parameters.nodata
                                ? fmt::format("painted as {}", class_name(*parameters.nodata))
                                : "filled from the nearest cells"));
  if (parameters.nodata) {
    for (LandCoverClass& c : classes)
      if (c == LandCoverClass::sky) c = *parameters.nodata;
    return;
  }
  const Grid<std::int32_t> nearest = nearest_marked(known);
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (known[i] == 0) classes[i] = classes[static_cast<std::size_t>(nearest[i])];
}

std::string describe_position(const std::string& crs, glm::dvec2 position) {
  const glm::dvec2 at = transform_point(crs, "EPSG:4326", position);
  return fmt::format("{:.2f}° {} {:.2f}° {}", std::abs(at.y), at.y < 0.0 ? "S" : "N",
                     std::abs(at.x), at.x < 0.0 ? "W" : "E");
}

// Land cover of another region is the error of a file, which is named with both positions.
void require_overlap(const std::vector<RasterSource>& sources, const RasterFrame& terrain,
                     const std::array<double, 4>& extent) {
  const RasterFrame all = choose_frame(sources, terrain.crs, 0.0, std::nullopt);
  const GeoTransform& t = all.transform;
  const double east = t.origin_x + t.cell_x * all.width;
  const double south = t.origin_y - t.cell_y * all.height;
  if (extent[0] < east && extent[2] > t.origin_x && extent[1] < t.origin_y && extent[3] > south)
    return;
  throw Error(ErrorKind::input, sources[0].path,
              fmt::format("the land cover lies elsewhere, around {}; the terrain around {}",
                          describe_position(terrain.crs, t.to_crs(.5 * all.width, .5 * all.height)),
                          describe_position(terrain.crs, {.5 * (extent[0] + extent[2]),
                                                          .5 * (extent[1] + extent[3])})),
              "land cover of the same region; if it is, its coordinate system is wrong (`crs`)");
}

// Bodies of water (cells connected by sides) that touch a known lake become the nearest land.
void clear_inferred_water(Grid<LandCoverClass>& cells, const Grid<std::uint8_t>& lake) {
  Grid<std::uint8_t> inferred(cells.width(), cells.height(), 0);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (lake[i] == 0 || cells[i] != LandCoverClass::water) continue;
    inferred[i] = 1;
    open.push_back(static_cast<std::int32_t>(i));
  }
  if (open.empty()) return;
  flood(inferred, std::move(open),
        [&](int x, int y) { return cells(x, y) == LandCoverClass::water; });
  Grid<std::uint8_t> land(cells.width(), cells.height(), 0);
  bool any = false;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    land[i] = cells[i] != LandCoverClass::water ? 1 : 0;
    any = any || land[i] != 0;
  }
  if (!any) return;
  const Grid<std::int32_t> nearest = nearest_marked(land);
  Grid<LandCoverClass> out = cells;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (inferred[i] != 0) out[i] = cells[static_cast<std::size_t>(nearest[i])];
  cells = std::move(out);
}

// Cells of a map, unless another map lies over it.
void lay_over(LandCover& cover, const MapCover& ground) {
  Grid<LandCoverClass>& cells = cover.classes.cells;
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      const glm::dvec2 position = cover.classes.transform.to_crs(x, y);
      const LandCoverClass known = ground.at(position);
      if (known == LandCoverClass::sky ||
          (cover.map != nullptr && cover.map->at(position) != LandCoverClass::sky))
        continue;
      cells(x, y) = known;
    }
  });
}

}  // namespace

float GroundRelief::depth_at(double x, double y) const {
  if (lake_depth_m.empty()) return 0.F;
  const glm::dvec2 cell = transform.to_cell(x, y);
  return sample_bilinear(lake_depth_m, cell.x, cell.y);
}

LandCoverClass LandCover::at(double x, double y) const {
  const LandCoverClass known = laid_at({x, y});
  return known != LandCoverClass::sky ? known : cell_at(x, y);
}

LandCoverClass LandCover::laid_at(glm::dvec2 position) const {
  const LandCoverClass known = map != nullptr ? map->at(position) : LandCoverClass::sky;
  return known == LandCoverClass::sky && inferred != nullptr ? inferred->at(position) : known;
}

LandCoverClass LandCover::cell_at(double x, double y) const {
  const Grid<LandCoverClass>& cells = below.empty() ? classes.cells : below;
  const glm::dvec2 position = classes.transform.to_cell(x, y);
  // From two cells beyond the edge on, all 16 cells are edge cells; the clamp also keeps far
  // positions within an int.
  const double column = std::clamp(position.x, -2.0, cells.width() + 1.0);
  const double row = std::clamp(position.y, -2.0, cells.height() + 1.0);
  const double left = std::floor(column);
  const double above = std::floor(row);
  const int x0 = static_cast<int>(left) - 1;
  const int y0 = static_cast<int>(above) - 1;
  const bool inside = x0 >= 0 && y0 >= 0 && x0 + 4 <= cells.width() && y0 + 4 <= cells.height();
  if (inside && is_uniform(cells, x0 + 1, y0 + 1)) return cells(x0 + 1, y0 + 1);
  const std::array<double, 4> across = class_weights(column - left);
  const std::array<double, 4> down = class_weights(row - above);
  std::array<double, land_cover_class_count> membership{};
  std::uint64_t present = 0;  // a bit for each class among the 16
  static_assert(land_cover_class_count <= 64);
  for (int j = 0; j < 4; ++j) {
    const LandCoverClass* line = cells.row(std::clamp(y0 + j, 0, cells.height() - 1));
    for (int i = 0; i < 4; ++i) {
      const auto c = static_cast<std::size_t>(
          line[inside ? x0 + i : std::clamp(x0 + i, 0, cells.width() - 1)]);
      membership[c] += across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)];
      present |= std::uint64_t{1} << c;
    }
  }
  // Ties take the first of the largest. Sums of the same weights in different orders differ in
  // their last bits, which must not decide.
  constexpr double tie = 1e-12;
  std::size_t best = 0;
  for (std::uint64_t left_over = present & ~std::uint64_t{1}; left_over != 0;
       left_over &= left_over - 1) {
    const auto c = static_cast<std::size_t>(std::countr_zero(left_over));
    if (membership[c] > membership[best] + tie) best = c;
  }
  return static_cast<LandCoverClass>(best);
}

void lay_map(LandCover& cover, std::shared_ptr<const MapCover> map, const MapCover* own) {
  const MapCover& ground = own != nullptr ? *own : *map;
  const GeoTransform& transform = cover.classes.transform;
  Grid<LandCoverClass>& cells = cover.classes.cells;
  Grid<std::uint8_t> lake(cells.width(), cells.height(), 0);
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x)
      lake(x, y) = ground.is_still(transform.to_crs(x, y)) ? 1 : 0;
  });
  clear_inferred_water(cells, lake);
  if (cover.below.empty()) cover.below = cells;
  lay_over(cover, ground);
  cover.map = std::move(map);
}

void lay_inferred(LandCover& cover, std::shared_ptr<const MapCover> inferred, const MapCover* own) {
  if (cover.below.empty()) cover.below = cover.classes.cells;
  if (cover.inferred == nullptr) lay_over(cover, own != nullptr ? *own : *inferred);
  cover.inferred = std::move(inferred);
}

LandCover read_land_cover(const LandCoverParameters& parameters, const RasterFrame& frame,
                          Progress& progress) {
  if (parameters.sources.empty())
    throw Error(ErrorKind::usage, "land_cover", "no raster given", "at least one raster");
  const Legend legend = read_legend(parameters.legend, parameters.folders);
  // At the sources' own resolution, over the frame.
  const GeoTransform& t = frame.transform;
  const std::array<double, 4> extent = {t.origin_x, t.origin_y - t.cell_y * frame.height,
                                        t.origin_x + t.cell_x * frame.width, t.origin_y};
  require_overlap(parameters.sources, frame, extent);
  RasterFrame own = choose_frame(parameters.sources, frame.crs, 0.0, extent);
  if (own.transform.cell_x < parameters.finest_cell_m)
    own = choose_frame(parameters.sources, frame.crs, parameters.finest_cell_m, extent);
  const Raster<std::int32_t> codes = warp_codes(parameters.sources, own, progress);
  LandCover cover;
  cover.classes.cells = classify(codes.cells, legend, parameters, progress);
  cover.classes.transform = codes.transform;
  cover.classes.crs = codes.crs;
  fill_unknown(cover.classes.cells, parameters, progress);
  return cover;
}

Raster<GroundColour> read_ground_image(const std::string& path, const RasterFrame& frame,
                                       bool must_overlap, Progress& progress) {
  RasterSource source;
  source.path = path;
  source.unit_to_m = 1.0;  // colours: no conversion
  const RasterInfo info = read_raster_info(source);
  if (info.bands < 3)
    throw Error(ErrorKind::input, path,
                fmt::format("has {} band{}", info.bands, info.bands == 1 ? "" : "s"),
                "3 bands: red, green and blue");
  Raster<GroundColour> colours{
      Grid<GroundColour>(frame.width, frame.height, GroundColour(0, 0, 0, 255)), frame.transform,
      frame.crs};
  for (int band = 0; band < 3; ++band) {
    source.band = band + 1;
    const Grid<float> values = warp_rasters({source}, frame, progress).cells;
    for (std::size_t i = 0; i < values.size(); ++i) {
      GroundColour& colour = colours.cells[i];
      if (!std::isfinite(values[i])) {
        colour = GroundColour(0);
        continue;
      }
      if (values[i] < 0.F || values[i] > 255.F)
        throw Error(ErrorKind::input, path, fmt::format("contains the value {}", values[i]),
                    "8-bit values, 0…255");
      if (colour.a != 0) colour[band] = static_cast<std::uint8_t>(values[i] + 0.5F);
    }
  }
  const bool any = std::any_of(colours.cells.begin(), colours.cells.end(),
                               [](const GroundColour& colour) { return colour.a != 0; });
  if (must_overlap && !any)
    throw Error(ErrorKind::input, path, "does not cover the terrain",
                "an orthophoto of the terrain");
  return colours;
}

}  // namespace belvedere
