#include "terrain/fetch/tile_plan.h"

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

constexpr int margin_cells = 6;  // around the area, for resampling

int floor_div(int a, int b) { return static_cast<int>(std::floor(static_cast<double>(a) / b)); }

}  // namespace

std::vector<PartPlan> plan_parts(const MapSource& source, const DegreeBox& box, int step) {
  const TileLattice any{source, source.columns.front().count, step};  // rows are the same in all
  const int last_row =
      static_cast<int>(std::lround((source.origin_deg.y + 90.0) / any.height_deg())) +
      (source.on_lines ? 1 : 0);
  const int top =
      std::max(0, static_cast<int>(std::floor(any.row_at(box.north))) - margin_cells * step);
  const int bottom =
      std::min(last_row, static_cast<int>(std::ceil(any.row_at(box.south))) + margin_cells * step);
  std::vector<PartPlan> parts;
  for (int row = top / source.rows; row * source.rows < bottom; ++row) {
    const TileLattice lattice{source, tile_columns(source, row), step};
    const int y0 = lattice.first_from(std::max(top, row * source.rows));
    const int y1 = lattice.first_from(std::min(bottom, (row + 1) * source.rows));
    if (y0 >= y1) continue;
    if (!parts.empty() && parts.back().lattice.columns == lattice.columns) {
      parts.back().y1 = y1;
      continue;
    }
    const int x0 = lattice.first_from(static_cast<int>(std::floor(lattice.column_at(box.west))) -
                                      margin_cells * step);
    const int x1 = lattice.first_from(static_cast<int>(std::ceil(lattice.column_at(box.east))) +
                                      margin_cells * step);
    parts.push_back({lattice, x0, y0, x1, y1});
  }
  return parts;
}

std::vector<TileCells> tiles_of_part(const PartPlan& part) {
  const TileLattice& lattice = part.lattice;
  std::vector<TileCells> tiles;
  const int rows = lattice.source.rows;
  for (int row = floor_div(lattice.source_cell(part.y0), rows);
       row * rows <= lattice.source_cell(part.y1 - 1); ++row)
    for (int column = floor_div(lattice.source_cell(part.x0), lattice.columns);
         column * lattice.columns <= lattice.source_cell(part.x1 - 1); ++column) {
      const TileCells cells{{column, row},
                            std::max(part.x0, lattice.first_from(column * lattice.columns)),
                            std::max(part.y0, lattice.first_from(row * rows)),
                            std::min(part.x1, lattice.first_from((column + 1) * lattice.columns)),
                            std::min(part.y1, lattice.first_from((row + 1) * rows))};
      if (cells.x0 < cells.x1 && cells.y0 < cells.y1 && in_latitudes(lattice.source, cells.tile))
        tiles.push_back(cells);
    }
  return tiles;
}

MapTile tile_at(const PartPlan& plan, int x, int y) {
  return {floor_div(plan.lattice.source_cell(x), plan.lattice.columns),
          floor_div(plan.lattice.source_cell(y), plan.lattice.source.rows)};
}

std::vector<MapTile> tiles_of(const MapSource& source, const DegreeBox& box) {
  std::vector<MapTile> tiles;
  for (const PartPlan& plan : plan_parts(source, box, 1))
    for (const TileCells& cells : tiles_of_part(plan)) tiles.push_back(cells.tile);
  return tiles;
}

}  // namespace belvedere
