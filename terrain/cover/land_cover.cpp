#include "terrain/cover/land_cover.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/cover/map_cover.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere {
namespace {

// bspline_weights, but rounded in an order of their own, which pixels on the border of two classes hang on.
std::array<double, 4> class_weights(double t) {
  const double s = 1.0 - t;
  return {s * s * s / 6.0, (4.0 + t * t * (3.0 * t - 6.0)) / 6.0, (4.0 + s * s * (3.0 * s - 6.0)) / 6.0, t * t * t / 6.0};
}

// True where the 2 × 2 cells around a place, of which (x, y) is the first, are of one class. They hold at least 25/36 of the weights, 5/6
// along each axis: whatever stands around, that class is the largest. So it is nearly everywhere, and this is what a lookup costs there.
bool is_uniform(const Grid<LandCoverClass>& cells, int x, int y) {
  const LandCoverClass* above = cells.row(y) + x;
  const LandCoverClass* below = cells.row(y + 1) + x;
  return above[0] == above[1] && above[0] == below[0] && above[0] == below[1];
}

// Codes to classes. Unknown codes are counted for one message about all of them.
Grid<LandCoverClass> classify(const Grid<std::int32_t>& codes, const Legend& legend, const LandCoverParameters& parameters,
                              Progress& progress) {
  Grid<LandCoverClass> classes(codes.width(), codes.height(), LandCoverClass::sky);
  std::map<std::int32_t, std::size_t> unknown;
  std::int32_t last_code = -1;
  LandCoverClass last_class = LandCoverClass::sky;  // neighbours are mostly alike
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const std::int32_t code = codes[i];
    if (code < 0) continue;
    if (code != last_code) {
      last_code = code;
      const auto found = legend.entries.find(code);
      const bool nothing = found == legend.entries.end() && legend.nodata.contains(code);
      const bool odd = found == legend.entries.end() && !nothing;
      last_class = nothing ? LandCoverClass::sky : odd ? parameters.unknown.value_or(LandCoverClass::sky) : found->second.painted_as;
      if (odd) unknown.try_emplace(code, 0);
    }
    classes[i] = last_class;
    if (!unknown.empty())
      if (const auto count = unknown.find(code); count != unknown.end()) ++count->second;
  }
  if (unknown.empty()) return classes;
  std::string list;
  for (const auto& [code, count] : unknown) list += fmt::format("{}{} ({} cells)", list.empty() ? "" : ", ", code, count);
  const std::string where = parameters.sources[0].path;
  if (!parameters.unknown) {
    throw Error(ErrorKind::input, where, fmt::format("codes that the legend {} lacks: {}", legend.name, list),
                "the legend's codes; another legend, or `unknown`, the class to paint them as");
  }
  progress.note(
      fmt::format("{}: painted as {}, because the legend {} lacks them: {}", where, class_name(*parameters.unknown), legend.name, list));
  return classes;
}

// Cells where nothing is known take the scene's class for them, or that of the nearest known cell.
void fill_unknown(Grid<LandCoverClass>& classes, const LandCoverParameters& parameters, Progress& progress) {
  Grid<std::uint8_t> known(classes.width(), classes.height(), 0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < classes.size(); ++i) {
    known[i] = classes[i] != LandCoverClass::sky ? 1 : 0;
    count += known[i];
  }
  if (count == classes.size()) return;
  const std::string where = parameters.sources[0].path;
  const double share = 100.0 * static_cast<double>(classes.size() - count) / static_cast<double>(classes.size());
  if (count == 0 && !parameters.nodata) throw Error(ErrorKind::input, where, "has no land cover within the scene's terrain");
  progress.note(fmt::format("{}: no land cover on {:.1f} % of the terrain: {}", where, share,
                            parameters.nodata ? fmt::format("painted as {}", class_name(*parameters.nodata)) : "taken from the nearest"));
  if (parameters.nodata) {
    for (LandCoverClass& c : classes)
      if (c == LandCoverClass::sky) c = *parameters.nodata;
    return;
  }
  const Grid<std::int32_t> nearest = nearest_marked(known);
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (known[i] == 0) classes[i] = classes[static_cast<std::size_t>(nearest[i])];
}

// Pieces of water (cells that touch by a side) that reach into a known lake become the nearest land.
void clear_guessed_water(Grid<LandCoverClass>& cells, const Grid<std::uint8_t>& lake) {
  Grid<std::uint8_t> guessed(cells.width(), cells.height(), 0);
  std::vector<std::int32_t> open;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (lake[i] == 0 || cells[i] != LandCoverClass::water) continue;
    guessed[i] = 1;
    open.push_back(static_cast<std::int32_t>(i));
  }
  if (open.empty()) return;
  flood(guessed, std::move(open), [&](int x, int y) { return cells(x, y) == LandCoverClass::water; });
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
    if (guessed[i] != 0) out[i] = cells[static_cast<std::size_t>(nearest[i])];
  cells = std::move(out);
}

// Cells of a map, where no other lies over it.
void lay_over(LandCover& cover, const MapCover& ground) {
  Grid<LandCoverClass>& cells = cover.classes.cells;
  parallel_rows(cells.height(), [&](int y) {
    for (int x = 0; x < cells.width(); ++x) {
      const glm::dvec2 place = cover.classes.transform.to_crs(x, y);
      const LandCoverClass known = ground.at(place);
      if (known == LandCoverClass::sky || (cover.map != nullptr && cover.map->at(place) != LandCoverClass::sky)) continue;
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

LandCoverClass LandCover::laid_at(glm::dvec2 place) const {
  const LandCoverClass known = map != nullptr ? map->at(place) : LandCoverClass::sky;
  return known == LandCoverClass::sky && guessed != nullptr ? guessed->at(place) : known;
}

LandCoverClass LandCover::cell_at(double x, double y) const {
  const Grid<LandCoverClass>& cells = below.empty() ? classes.cells : below;
  const glm::dvec2 place = classes.transform.to_cell(x, y);
  // Two cells beyond the rim all 16 cells are the rim's; also keeps far places within an int.
  const double column = std::clamp(place.x, -2.0, cells.width() + 1.0);
  const double row = std::clamp(place.y, -2.0, cells.height() + 1.0);
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
      const auto c = static_cast<std::size_t>(line[inside ? x0 + i : std::clamp(x0 + i, 0, cells.width() - 1)]);
      membership[c] += across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)];
      present |= std::uint64_t{1} << c;
    }
  }
  // The first of the largest; sums of the same weights in another order differ in their last bits, which are no reason to
  // prefer a class.
  constexpr double tie = 1e-12;
  std::size_t best = 0;
  for (std::uint64_t left_over = present & ~std::uint64_t{1}; left_over != 0; left_over &= left_over - 1) {
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
    for (int x = 0; x < cells.width(); ++x) lake(x, y) = ground.is_still(transform.to_crs(x, y)) ? 1 : 0;
  });
  clear_guessed_water(cells, lake);
  if (cover.below.empty()) cover.below = cells;
  lay_over(cover, ground);
  cover.map = std::move(map);
}

void lay_guessed(LandCover& cover, std::shared_ptr<const MapCover> guessed, const MapCover* own) {
  if (cover.below.empty()) cover.below = cover.classes.cells;
  lay_over(cover, own != nullptr ? *own : *guessed);
  cover.guessed = std::move(guessed);
}

LandCover read_land_cover(const LandCoverParameters& parameters, const RasterFrame& frame, Progress& progress) {
  if (parameters.sources.empty()) throw Error(ErrorKind::usage, "land_cover", "no raster is named", "at least one");
  const Legend legend = read_legend(parameters.legend, parameters.folders);
  // At the sources' own resolution, over the frame.
  const GeoTransform& t = frame.transform;
  const std::array<double, 4> extent = {t.origin_x, t.origin_y - t.cell_y * frame.height, t.origin_x + t.cell_x * frame.width, t.origin_y};
  RasterFrame own = choose_frame(parameters.sources, frame.crs, 0.0, extent);
  if (own.transform.cell_x < parameters.finest_cell_m) own = choose_frame(parameters.sources, frame.crs, parameters.finest_cell_m, extent);
  const Raster<std::int32_t> codes = warp_codes(parameters.sources, own, progress);
  LandCover cover;
  cover.classes.cells = classify(codes.cells, legend, parameters, progress);
  cover.classes.transform = codes.transform;
  cover.classes.crs = codes.crs;
  fill_unknown(cover.classes.cells, parameters, progress);
  return cover;
}

}  // namespace belvedere
