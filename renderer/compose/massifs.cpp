#include "renderer/compose/massifs.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include "base/filter.h"
#include "base/math.h"

namespace belvedere {
namespace {

// Shares of the region's side.
constexpr double summit_reach = 0.02;
constexpr double apart = 0.14;
constexpr double off_the_rim = 0.05;
constexpr double body_smooth = 0.03;
constexpr double river_reach = 0.07;  // of a canyon whose direction is computed

struct Place {
  int x = 0, y = 0;
  double rank = 0.0;
};

glm::dvec2 centre(const CoarseGround& ground, int x, int y) {
  return ground.transform.to_crs(x, y);
}

int cells_in(const CoarseGround& ground, double share) {
  return std::max(1, static_cast<int>(std::lround(share * ground.side_m / ground.cell_m)));
}

// The best positions that lie apart from each other, best first; of equal ones the first in the
// rows of the grid.
std::vector<Place> best_apart(const CoarseGround& ground, std::vector<Place> positions,
                              std::size_t count) {
  std::stable_sort(positions.begin(), positions.end(),
                   [](const Place& a, const Place& b) { return a.rank > b.rank; });
  std::vector<Place> out;
  for (const Place& position : positions) {
    const bool free = std::all_of(out.begin(), out.end(), [&](const Place& other) {
      return glm::distance(centre(ground, position.x, position.y),
                           centre(ground, other.x, other.y)) > apart * ground.side_m;
    });
    if (free) out.push_back(position);
    if (out.size() == count) break;
  }
  return out;
}

Grid<float> field(const CoarseGround& ground,
                  const std::function<float(const GroundCell&)>& value) {
  Grid<float> out(ground.cells.width(), ground.cells.height());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = value(ground.cells[i]);
  return out;
}

// Where a grid is highest within the radius of a summit.
std::vector<Place> peaks(const CoarseGround& ground, const Grid<float>& height,
                         const Grid<float>& rank) {
  const Grid<float> highest = window_maximum(height, cells_in(ground, summit_reach));
  std::vector<Place> out;
  for (int y = 0; y < height.height(); ++y)
    for (int x = 0; x < height.width(); ++x)
      if (height(x, y) == highest(x, y) && ground.cells(x, y).known && rank(x, y) > 0.F)
        out.push_back({x, y, static_cast<double>(rank(x, y))});
  return out;
}

Grid<float> summit_rank(const CoarseGround& ground) {
  const Grid<float> stands =
      field(ground, [](const GroundCell& c) { return std::max(c.above_m, 0.F); });
  const Grid<float> body = gaussian_blur(stands, body_smooth * ground.side_m / ground.cell_m);
  constexpr float of_body = 0.7F;
  Grid<float> rank(stands.width(), stands.height());
  for (std::size_t i = 0; i < rank.size(); ++i) {
    const double high = (static_cast<double>(ground.cells[i].altitude_m) - ground.low_m) /
                        std::max(1.0, ground.upper_m - ground.low_m);
    rank[i] = static_cast<float>(std::clamp(high, 0.0, 1.2)) * stands[i] + of_body * body[i];
  }
  return rank;
}

// Upwards along the valley: the axis of the deeply cut cells around, turned to where their floor
// rises.
glm::dvec2 centreline(const CoarseGround& ground, int x, int y) {
  const int reach = cells_in(ground, river_reach);
  const float deep = 0.55F * ground.cells(x, y).incision_m;
  double xx = 0.0, xy = 0.0, yy = 0.0, rise_x = 0.0, rise_y = 0.0, weight = 0.0;
  for (int j = -reach; j <= reach; ++j)
    for (int i = -reach; i <= reach; ++i) {
      if (!ground.cells.contains(x + i, y + j) || i * i + j * j > reach * reach) continue;
      const GroundCell& c = ground.cells(x + i, y + j);
      if (c.incision_m < deep) continue;
      const double east = i;
      const double north = -j;
      const double rise = static_cast<double>(c.altitude_m - ground.cells(x, y).altitude_m);
      xx += east * east, xy += east * north, yy += north * north;
      rise_x += east * rise, rise_y += north * rise;
      weight += 1.0;
    }
  if (weight < 3.0) return {0.0, 1.0};
  // Larger eigenvector of the covariance [[xx, xy], [xy, yy]].
  const double mean = 0.5 * (xx + yy);
  const double half = 0.5 * (xx - yy);
  const double larger = mean + std::sqrt(half * half + xy * xy);
  glm::dvec2 axis = std::abs(xy) > 1e-9 ? glm::dvec2(larger - yy, xy)
                    : xx >= yy          ? glm::dvec2(1.0, 0.0)
                                        : glm::dvec2(0.0, 1.0);
  axis = axis / std::sqrt(axis.x * axis.x + axis.y * axis.y);
  return axis.x * rise_x + axis.y * rise_y >= 0.0 ? axis : -axis;
}

void normalize_ranks(std::vector<Anchor>& anchors) {
  double best = 0.0;
  for (const Anchor& a : anchors) best = std::max(best, a.rank);
  for (Anchor& a : anchors) a.rank = best > 0.0 ? a.rank / best : 1.0;
}

std::vector<Anchor> to_anchors(const CoarseGround& ground, const std::vector<Place>& positions,
                               AnchorKind kind, const std::function<double(const Place&)>& stands) {
  std::vector<Anchor> out;
  for (const Place& p : positions)
    out.push_back(
        {.kind = kind,
         .position = centre(ground, p.x, p.y),
         .altitude_m = static_cast<double>(ground.cells(p.x, p.y).altitude_m),
         .stands_m = stands(p),
         .rank = p.rank,
         .along = kind == AnchorKind::canyon ? centreline(ground, p.x, p.y) : glm::dvec2(0.0)});
  return out;
}

// The maximum distance of a canyon's walls defines it, so only depth ranks it, smoothed along its
// floor.
std::vector<Anchor> canyons(const CoarseGround& ground) {
  const Grid<float> cut = field(ground, [](const GroundCell& c) { return c.incision_m; });
  const Grid<float> deep = gaussian_blur(cut, 0.006 * ground.side_m / ground.cell_m);
  std::vector<Place> positions = peaks(ground, deep, deep);
  std::erase_if(positions, [&](const Place& p) {
    constexpr double min_depth = 0.16;  // of the relief
    return static_cast<double>(ground.cells(p.x, p.y).rim_m) < 0.10 * ground.side_m ||
           p.rank < min_depth * ground.relief_m;
  });
  return to_anchors(
      ground, best_apart(ground, std::move(positions), 2), AnchorKind::canyon,
      [&](const Place& p) { return static_cast<double>(ground.cells(p.x, p.y).incision_m); });
}

std::vector<Anchor> shores(const CoarseGround& ground) {
  const Grid<float>& relief = ground.local_relief_m(0.05 * ground.side_m);
  std::vector<Place> positions;
  for (int y = 0; y < relief.height(); ++y)
    for (int x = 0; x < relief.width(); ++x) {
      const GroundCell& c = ground.cells(x, y);
      if (!c.water || static_cast<double>(c.rim_m) < 0.08 * ground.side_m) continue;
      constexpr double min_rise = 0.2;  // of the relief
      if (static_cast<double>(relief(x, y)) > min_rise * ground.relief_m)
        positions.push_back({x, y, static_cast<double>(relief(x, y))});
    }
  return to_anchors(ground, best_apart(ground, std::move(positions), 2), AnchorKind::shore,
                    [&](const Place& p) { return static_cast<double>(relief(p.x, p.y)); });
}

}  // namespace

Massifs find_massifs(const CoarseGround& ground) {
  constexpr std::size_t max_summits = 4;
  const Grid<float> altitude = field(ground, [](const GroundCell& c) { return c.altitude_m; });
  const Grid<float> rank = summit_rank(ground);
  const std::vector<Place> all = peaks(ground, altitude, rank);
  std::vector<Place> inner;
  for (const Place& p : all)
    if (static_cast<double>(ground.cells(p.x, p.y).rim_m) > off_the_rim * ground.side_m)
      inner.push_back(p);
  const auto above = [&](const Place& p) {
    return static_cast<double>(ground.cells(p.x, p.y).above_m);
  };
  const auto summits_of = [&](const std::vector<Place>& positions) {
    return to_anchors(ground, best_apart(ground, positions, max_summits), AnchorKind::summit,
                      above);
  };
  Massifs out;
  std::vector<Anchor> summits = summits_of(inner);
  const std::vector<Anchor> everywhere = summits_of(all);
  constexpr double much_better = 1.15;
  if (!everywhere.empty() &&
      (summits.empty() || everywhere[0].rank > much_better * summits[0].rank))
    out.at_the_rim.push_back(everywhere[0]);
  if (summits.size() > 1) {
    std::vector<double> others;
    for (std::size_t i = 1; i < summits.size(); ++i) others.push_back(summits[i].rank);
    std::sort(others.begin(), others.end());
    out.lone = unit((summits[0].rank / others[others.size() / 2] - 1.25) / 0.4);
  } else {
    out.lone = summits.empty() ? 0.0 : 1.0;
  }
  normalize_ranks(summits);
  std::vector<Anchor> deep = canyons(ground);
  normalize_ranks(deep);
  std::vector<Anchor> wet = shores(ground);
  normalize_ranks(wet);
  out.anchors = std::move(summits);
  out.anchors.insert(out.anchors.end(), deep.begin(), deep.end());
  out.anchors.insert(out.anchors.end(), wet.begin(), wet.end());
  return out;
}

std::string describe_anchor(const Anchor& anchor) {
  switch (anchor.kind) {
    case AnchorKind::canyon:
      return fmt::format("a canyon cut {:.0f} m deep", anchor.stands_m);
    case AnchorKind::shore:
      return fmt::format("a shore below land that rises {:.0f} m", anchor.stands_m);
    case AnchorKind::summit:
      break;
  }
  return fmt::format("a summit of {:.0f} m", anchor.altitude_m);
}

}  // namespace belvedere
