#include "terrain/deform/fold.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/parallel.h"

namespace belvedere {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// Distance of a position from a handle's disc; 0 inside.
double distance_from(const DeformHandle& handle, glm::dvec2 position) {
  const double distance = glm::length(position - handle.centre);
  return handle.radius_m > 0.0 ? distance / handle.radius_m : distance * 1e-9;
}

}  // namespace

std::vector<Fold> find_folds(const Grid<float>& altitude_m, const GeoTransform& transform,
                             const Deformation& deformation) {
  if (!deformation.moves_in_plan() || altitude_m.width() < 2 || altitude_m.height() < 2) return {};
  const auto moved = [&](int x, int y) {
    const glm::dvec3 position = deformation.rearranged({transform.to_crs(x, y), altitude_m(x, y)});
    return glm::dvec2(position);
  };
  // Cells within the radius of some handle, and one more on each side; all if there is a field.
  const bool everywhere = !deformation.field().is_identity();
  const glm::dvec2 low = everywhere ? glm::dvec2(-1e9) : deformation.handles().lowest();
  const glm::dvec2 high = everywhere ? glm::dvec2(1e9) : deformation.handles().highest();
  const auto cell_of = [](double at, int count) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count - 1)));
  };
  const glm::dvec2 first = transform.to_cell(low.x, high.y);
  const glm::dvec2 last = transform.to_cell(high.x, low.y);
  const int x0 = cell_of(first.x - 1.0, altitude_m.width());
  const int y0 = cell_of(first.y - 1.0, altitude_m.height());
  const int x1 = cell_of(last.x + 1.0, altitude_m.width() - 1);
  const int y1 = cell_of(last.y + 1.0, altitude_m.height() - 1);
  if (y1 < y0 || x1 < x0) return {};

  std::vector<std::vector<Fold>> rows(static_cast<std::size_t>(y1 - y0 + 1));
  parallel_rows(static_cast<int>(rows.size()), [&](int row) {
    const int y = y0 + row;
    glm::dvec2 nw = moved(x0, y);
    glm::dvec2 sw = moved(x0, y + 1);
    for (int x = x0; x <= x1; ++x) {
      const glm::dvec2 ne = moved(x + 1, y);
      const glm::dvec2 se = moved(x + 1, y + 1);
      const auto add = [&](bool south_east, double at, glm::dvec2 sum) {
        rows[static_cast<std::size_t>(row)].push_back(
            {x, y, south_east, transform.to_crs(x + at, y + at), sum / 3.0});
      };
      // North is up in plan: (nw, sw, ne) and (se, ne, sw) run counter-clockwise as long as nothing
      // is folded.
      if (!(cross(sw - nw, ne - nw) > 0.0)) add(false, 1.0 / 3.0, nw + sw + ne);
      if (!(cross(ne - se, sw - se) > 0.0)) add(true, 2.0 / 3.0, se + ne + sw);
      nw = ne;
      sw = se;
    }
  });
  std::vector<Fold> folds;
  for (const std::vector<Fold>& row : rows) folds.insert(folds.end(), row.begin(), row.end());
  return folds;
}

std::vector<FoldSummary> summarize_folds(const std::vector<Fold>& folds,
                                         const DeformParameters& deform) {
  const std::vector<DeformHandle>& handles = deform.handles;
  const double limit = deform.field.places.empty() ? std::numeric_limits<double>::infinity() : 1.0;
  // The last is for folds that lie in no handle.
  std::vector<std::vector<const Fold*>> of_handle(handles.size() + 1);
  for (const Fold& fold : folds) {
    std::size_t nearest = handles.size();
    double nearest_distance = limit;
    for (std::size_t i = 0; i < handles.size(); ++i) {
      const double distance = distance_from(handles[i], fold.position);
      if (distance <= nearest_distance) nearest = i, nearest_distance = distance;
    }
    of_handle[nearest].push_back(&fold);
  }
  std::vector<FoldSummary> summaries;
  for (std::size_t i = 0; i < of_handle.size(); ++i) {
    if (of_handle[i].empty()) continue;
    glm::dvec2 mean(0.0);
    for (const Fold* fold : of_handle[i])
      mean += fold->position / static_cast<double>(of_handle[i].size());
    // The mean of a ring of folds has no fold itself.
    const Fold* centre = *std::min_element(
        of_handle[i].begin(), of_handle[i].end(), [&](const Fold* a, const Fold* b) {
          return glm::length(a->position - mean) < glm::length(b->position - mean);
        });
    summaries.push_back({i < handles.size() ? std::optional(i) : std::nullopt, of_handle[i].size(),
                         centre->position});
  }
  return summaries;
}

}  // namespace belvedere
