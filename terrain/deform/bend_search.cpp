#include "terrain/deform/bend_search.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/io/block_means.h"
#include "terrain/io/surface_raster.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {
namespace {

constexpr double max_cells = 2e6;

// The inclinations of a candidate in tenths of a degree, from the nearest to the farthest point;
// the last is 0.
using Inclinations = std::vector<int>;

class Search {
 public:
  Search(const ValleySight& sight, const BendSearchParameters& parameters)
      : sight_(sight),
        parameters_(parameters),
        spacing_m_((sight.farthest_m() - sight.nearest_m()) / (parameters.points - 1)),
        steepest_(static_cast<int>(std::floor(parameters.max_inclination_deg * 10.0 + 1e-9))),
        largest_step_(static_cast<int>(
            std::floor(parameters.max_bending_deg_per_10km * spacing_m_ / 1000.0 + 1e-9))) {}

  BendCurve curve(const Inclinations& inclinations) const {
    BendCurve out;
    for (std::size_t i = 0; i < inclinations.size(); ++i)
      out.points.push_back(
          {std::round((sight_.nearest_m() + spacing_m_ * static_cast<double>(i)) / 100.0) * 100.0,
           std::nullopt, inclinations[i] / 10.0});
    return out;
  }

  struct Candidate {
    Inclinations inclinations;
    double score = -1.0;
  };

  Candidate judge(const Inclinations& inclinations) {
    ++tried_;
    const BendProfile bend(curve(inclinations));
    const BendDistortion distortion =
        measure_distortion(bend, sight_.nearest_m(), sight_.farthest_m());
    // The interpolated curve may bend slightly faster between its points than from point to point.
    if (distortion.bending_deg_per_10km > parameters_.max_bending_deg_per_10km * 1.0001)
      return {inclinations, -1.0};
    constexpr double share_per_degree = 1e-3;
    return {inclinations, sight_.visible_share(bend) - share_per_degree * distortion.mean_deg};
  }

  bool allowed(const Inclinations& c) const {
    for (std::size_t i = 0; i + 1 < c.size(); ++i)
      if (c[i] < c[i + 1] || c[i] - c[i + 1] > largest_step_) return false;
    return c.front() <= steepest_ && c.back() == 0;
  }

  // All curves on a lattice of `levels` inclinations.
  void lattice(int levels, std::size_t point, Inclinations& c, std::vector<Candidate>& out) {
    if (point == 0) {
      if (allowed(c)) out.push_back(judge(c));
      return;
    }
    for (int level = 0; level <= levels; ++level) {
      c[point - 1] = steepest_ * level / levels;
      if (c[point - 1] < c[point]) continue;
      lattice(levels, point - 1, c, out);
    }
  }

  // Hill climbing: one or several points up or down together, with steps that halve.
  Candidate climb(Candidate best, int first_step) {
    for (int step = first_step; step >= 1; step /= 2) {
      for (bool better = true; better;) {
        better = false;
        const Inclinations from = best.inclinations;
        for (std::size_t first = 0; first + 1 < from.size(); ++first) {
          for (std::size_t last = first; last + 1 < from.size(); ++last) {
            for (const int sign : {1, -1}) {
              Inclinations next = from;
              for (std::size_t i = first; i <= last; ++i) next[i] += sign * step;
              if (!allowed(next)) continue;
              const Candidate candidate = judge(next);
              if (candidate.score > best.score + 1e-9) {
                best = candidate;
                better = true;
              }
            }
          }
        }
      }
    }
    return best;
  }

  int tried() const { return tried_; }
  int steepest() const { return steepest_; }

 private:
  const ValleySight& sight_;
  BendSearchParameters parameters_;
  double spacing_m_;
  int steepest_;
  int largest_step_;
  int tried_ = 0;
};

}  // namespace

ValleySight::ValleySight(const Grid<float>& altitude_m, const GeoTransform& transform,
                         const Deformation& deformation, double eye_m, std::vector<SightLine> lines)
    : lines_(std::move(lines)), eye_m_(eye_m) {
  const int factor = std::max(
      1,
      static_cast<int>(std::ceil(std::sqrt(static_cast<double>(altitude_m.size()) / max_cells))));
  const Grid<float> thin = block_means(altitude_m, factor);
  const GeoTransform cells{transform.origin_x, transform.origin_y, transform.cell_x * factor,
                           transform.cell_y * factor};
  const double cell_m = 0.5 * (cells.cell_x + cells.cell_y);
  // Floors are found in the deformed landscape, so that they move with the mountains around them.
  const Grid<float> rearranged =
      raster_of_moved(thin, cells, [&](glm::dvec3 p) { return deformation.rearranged(p); });
  const Grid<std::uint8_t> floor = find_valley_floor(rearranged, cell_m);

  const glm::dvec2 viewer = deformation.viewer_xy();
  double farthest = 0.0;
  for (const int x : {0, thin.width() - 1})
    for (const int y : {0, thin.height() - 1}) {
      const glm::dvec2 corner = cells.to_crs(x, y);
      farthest = std::max(farthest, exact::hypot(corner.x - viewer.x, corner.y - viewer.y));
    }
  step_m_ = cell_m;
  const int steps = static_cast<int>(farthest / step_m_) + 1;
  samples_ = Grid<Sample>(steps, static_cast<int>(lines_.size()),
                          Sample{std::numeric_limits<float>::quiet_NaN(), false});
  const BendProfile own_bend(deformation.parameters().bend);
  for (int k = 0; k < steps; ++k)
    curvature_drop_m_.push_back(deformation.drop_m((k + 0.5) * step_m_) -
                                own_bend.drop_m((k + 0.5) * step_m_));
  parallel_rows(samples_.height(), [&](int row) {
    const double azimuth = to_radians(lines_[static_cast<std::size_t>(row)].azimuth_deg);
    for (int k = 0; k < steps; ++k) {
      const double distance = (k + 0.5) * step_m_;
      const glm::dvec2 at = cells.to_cell(viewer.x + distance * exact::sin(azimuth),
                                          viewer.y + distance * exact::cos(azimuth));
      if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= thin.width() - 1.0 &&
            at.y <= thin.height() - 1.0))
        continue;
      const double z = static_cast<double>(sample_bilinear(rearranged, at.x, at.y));
      const double base = deformation.parameters().exaggeration_base_m;
      samples_(k, row) = {
          static_cast<float>(base + (z - base) * deformation.exaggeration(distance)),
          floor(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y))) != 0};
    }
  });
  // The visible ground starts where the unbent ground enters the picture at its lower edge (nearer
  // ground is below the frame). The horizon is the distance within which all but a twentieth of the
  // ground lies: a bend need not include a far corner of the terrain.
  constexpr double beyond_horizon = 0.05;
  nearest_m_ = farthest;
  std::vector<double> ground(static_cast<std::size_t>(steps), 0.0);
  double all_ground = 0.0;
  for (int row = 0; row < samples_.height(); ++row) {
    for (int k = 0; k < steps; ++k) {
      const double distance = (k + 0.5) * step_m_;
      if (std::isnan(samples_(k, row).height_m)) continue;
      ground[static_cast<std::size_t>(k)] += distance;
      all_ground += distance;
      const double height = static_cast<double>(samples_(k, row).height_m) -
                            curvature_drop_m_[static_cast<std::size_t>(k)];
      if ((height - eye_m_) / distance >= lines_[static_cast<std::size_t>(row)].lowest)
        nearest_m_ = std::min(nearest_m_, distance);
    }
  }
  double nearer = 0.0;
  for (int k = 0; k < steps && nearer < (1.0 - beyond_horizon) * all_ground; ++k) {
    nearer += ground[static_cast<std::size_t>(k)];
    farthest_m_ = (k + 0.5) * step_m_;
  }
  nearest_m_ = std::min(nearest_m_, farthest_m_);
  const double angle = lines_.size() > 1
                           ? to_radians(std::abs(lines_[1].azimuth_deg - lines_[0].azimuth_deg))
                           : to_radians(1.0);
  for (int row = 0; row < samples_.height(); ++row) {
    for (int k = 0; k < steps; ++k) {
      const double distance = (k + 0.5) * step_m_;
      Sample& sample = samples_(k, row);
      sample.floor = sample.floor && distance >= nearest_m_;
      if (sample.floor) floor_m2_ += distance * step_m_ * angle;
    }
  }
}

double ValleySight::visible_share(const BendProfile& bend) const {
  std::vector<double> drop(static_cast<std::size_t>(samples_.width()));
  for (std::size_t k = 0; k < drop.size(); ++k)
    drop[k] = bend.drop_m((static_cast<double>(k) + 0.5) * step_m_) + curvature_drop_m_[k];
  // By line, then added in order: the same sum for any number of threads. Areas are proportional to
  // the distance.
  std::vector<double> seen(lines_.size(), 0.0);
  std::vector<double> all(lines_.size(), 0.0);
  parallel_rows(samples_.height(), [&](int row) {
    const auto line = static_cast<std::size_t>(row);
    const Sample* samples = samples_.row(row);
    double steepest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < drop.size(); ++k) {
      if (std::isnan(samples[k].height_m)) continue;
      const double distance = (static_cast<double>(k) + 0.5) * step_m_;
      const double sight = (static_cast<double>(samples[k].height_m) - drop[k] - eye_m_) / distance;
      const bool visible = sight >= steepest;
      if (visible) steepest = sight;
      if (!samples[k].floor) continue;
      all[line] += distance;
      if (visible && sight >= lines_[line].lowest && sight <= lines_[line].highest)
        seen[line] += distance;
    }
  });
  double sum_seen = 0.0;
  double sum_all = 0.0;
  for (std::size_t line = 0; line < lines_.size(); ++line) {
    sum_seen += seen[line];
    sum_all += all[line];
  }
  return sum_all > 0.0 ? sum_seen / sum_all : 0.0;
}

BendDistortion measure_distortion(const BendProfile& bend, double from_m, double to_m) {
  constexpr int steps = 400;
  constexpr double ten_km = 10000.0;
  const double step_m = (to_m - from_m) / steps;
  BendDistortion out;
  double before = 0.0;
  for (int k = 0; k <= steps; ++k) {
    const double inclination = to_degrees(exact::atan(bend.slope(from_m + step_m * k)));
    out.largest_deg = std::max(out.largest_deg, std::abs(inclination));
    out.mean_deg += std::abs(inclination) / (steps + 1);
    if (k > 0 && step_m > 0.0)
      out.bending_deg_per_10km =
          std::max(out.bending_deg_per_10km, std::abs(inclination - before) / step_m * ten_km);
    before = inclination;
  }
  return out;
}

BendFound search_bend(const ValleySight& sight, const BendSearchParameters& parameters,
                      Progress& progress) {
  const auto check = [](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw Error(ErrorKind::usage, name, fmt::format("{}", value),
                  fmt::format("{} to {}", low, high));
  };
  check("--max-distortion", parameters.max_inclination_deg, 1.0, 60.0);
  check("--max-bending", parameters.max_bending_deg_per_10km, 0.1, 60.0);
  check("control points", parameters.points, 3, 8);
  if (!(sight.floor_km2() > 0.0))
    throw Error(ErrorKind::usage, "bend search", "the view contains no valley floor",
                "a view of flat ground between mountains");
  progress.begin("searching for the bend", 0.0);
  Search search(sight, parameters);
  std::vector<Search::Candidate> candidates;
  Inclinations start(static_cast<std::size_t>(parameters.points), 0);
  // About the same number of curves for any number of points.
  const int levels = parameters.points <= 4 ? 10 : parameters.points == 5 ? 7 : 4;
  search.lattice(levels, start.size() - 1, start, candidates);
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  constexpr std::size_t climbers = 3;
  Search::Candidate best = candidates.front();
  for (std::size_t i = 0; i < std::min(climbers, candidates.size()); ++i) {
    const Search::Candidate top =
        search.climb(candidates[i], std::max(1, search.steepest() / (2 * levels)));
    if (top.score > best.score) best = top;
  }
  BendFound found;
  found.curve = search.curve(best.inclinations);
  const BendProfile bend(found.curve);
  found.visible_share = sight.visible_share(bend);
  found.distortion = measure_distortion(bend, sight.nearest_m(), sight.farthest_m());
  found.tried = search.tried();
  return found;
}

}  // namespace belvedere
