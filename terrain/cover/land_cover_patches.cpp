#include "terrain/cover/land_cover_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/filter.h"
#include "base/masks/erosion.h"
#include "base/masks/label_blur.h"

namespace belvedere {
namespace {

constexpr int max_rings = 3;  // by which a kept patch may grow

using Cells = Grid<LandCoverClass>;

using Patches = LabelPatches<LandCoverClass>;

// Ring after ring around each small patch of a kept class.
void grow(Cells& cells, const Patches& patches,
          const std::array<bool, land_cover_class_count>& kept, double min_cells) {
  std::vector<std::vector<std::size_t>> small(patches.sizes.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t p = patches.of_cell[i];
    if (kept[static_cast<std::size_t>(patches.labels[p])] &&
        static_cast<double>(patches.sizes[p]) < min_cells)
      small[p].push_back(i);
  }
  const auto width = static_cast<std::size_t>(cells.width());
  for (std::size_t p = 0; p < small.size(); ++p) {
    std::size_t count = small[p].size();
    std::vector<std::size_t> rim = std::move(small[p]);
    for (int ring = 0; ring < max_rings && !rim.empty(); ++ring) {
      std::vector<std::size_t> next;
      for (const std::size_t i : rim) {
        const int x = static_cast<int>(i % width);
        const int y = static_cast<int>(i / width);
        for (const auto& [u, v] : {std::pair{x, y - 1}, {x - 1, y}, {x + 1, y}, {x, y + 1}}) {
          if (static_cast<double>(count) >= min_cells || !cells.contains(u, v) ||
              kept[static_cast<std::size_t>(cells(u, v))])
            continue;
          cells(u, v) = patches.labels[p];
          next.push_back(cells.index(u, v));
          ++count;
        }
      }
      rim = std::move(next);
    }
  }
}

void count_areas(const Cells& cells, const Patches& patches, double cell_m2,
                 std::array<ClassArea, land_cover_class_count>& areas, double ClassArea::*area,
                 int ClassArea::*count) {
  for (const LandCoverClass id : cells) areas[static_cast<std::size_t>(id)].*area += cell_m2;
  for (const LandCoverClass id : patches.labels) ++(areas[static_cast<std::size_t>(id)].*count);
}

}  // namespace

PatchResult remove_small_patches(LandCover cover, const PatchParameters& parameters) {
  PatchResult result{std::move(cover), {}};
  if (!(parameters.smallest_m2 > 0.0)) return result;
  Cells& cells = result.cover.classes.cells;
  const GeoTransform& transform = result.cover.classes.transform;
  const double cell_m2 = transform.cell_x * transform.cell_y;
  const double min_cells = parameters.smallest_m2 / cell_m2;
  std::array<bool, land_cover_class_count> kept{};
  for (const LandCoverClass id : parameters.keep) kept[static_cast<std::size_t>(id)] = true;

  std::array<ClassArea, land_cover_class_count> areas{};
  const auto is_kept = [&](LandCoverClass id) { return kept[static_cast<std::size_t>(id)]; };
  const Patches before = find_patches(cells, is_kept);
  count_areas(cells, before, cell_m2, areas, &ClassArea::before_m2, &ClassArea::patches_before);

  // Cells that keep their own class may also spread; kept classes stay but do not spread into
  // removed patches.
  Grid<std::uint8_t> spreads(cells.width(), cells.height(), 0);
  Grid<std::uint8_t> goes(cells.width(), cells.height(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t p = before.of_cell[i];
    if (kept[static_cast<std::size_t>(cells[i])]) continue;
    (static_cast<double>(before.sizes[p]) < min_cells ? goes : spreads)[i] = 1;
  }
  const Grid<std::int32_t> nearest = nearest_marked(spreads);
  const Cells old = cells;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (goes[i] != 0 && nearest[i] >= 0) cells[i] = old[static_cast<std::size_t>(nearest[i])];
  grow(cells, before, kept, min_cells);

  count_areas(cells, find_patches(cells, is_kept), cell_m2, areas, &ClassArea::after_m2,
              &ClassArea::patches_after);
  for (std::size_t id = 0; id < areas.size(); ++id) {
    areas[id].id = static_cast<LandCoverClass>(id);
    if (areas[id].patches_before + areas[id].patches_after > 0) result.areas.push_back(areas[id]);
  }
  return result;
}

LandCover erode_land_cover(LandCover cover, const CoverErosion& erosion, std::uint64_t seed) {
  if (erosion.empty()) return cover;
  Grid<LandCoverClass>& cells = cover.classes.cells;
  const GeoTransform& position = cover.classes.transform;
  Grid<std::uint8_t> labels(cells.width(), cells.height());
  std::transform(cells.begin(), cells.end(), labels.begin(),
                 [](LandCoverClass id) { return static_cast<std::uint8_t>(id); });
  std::array<bool, 256> opens{};
  for (const LandCoverClassInfo& info : land_cover_classes())
    opens[static_cast<std::size_t>(info.id)] = info.id != LandCoverClass::sky &&
                                               info.id != LandCoverClass::water &&
                                               info.id != LandCoverClass::settlement;
  ErosionParameters parameters;
  parameters.cell = std::sqrt(std::abs(position.cell_x * position.cell_y));
  parameters.step = std::max(cover_erosion_step_m, .5 * parameters.cell);
  parameters.seed = seed;
  parameters.x = position.origin_x + .5 * position.cell_x;
  parameters.y = position.origin_y - .5 * position.cell_y;
  parameters.dx = position.cell_x;
  parameters.dy = -position.cell_y;
  for (const auto& [id, steps] : erosion) {
    if (steps < 1) continue;
    parameters.levels = steps;
    labels = erode(labels, static_cast<std::uint8_t>(id), opens, parameters).labels;
  }
  std::transform(labels.begin(), labels.end(), cells.begin(),
                 [](std::uint8_t label) { return static_cast<LandCoverClass>(label); });
  return cover;
}

}  // namespace belvedere
