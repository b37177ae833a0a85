#include "renderer/features/line_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

#include "base/math_exact.h"
#include "base/statistics.h"
#include "renderer/trace/traced_part.h"
#include "terrain/generalize/widen_valleys.h"

namespace belvedere {
namespace {

bool holds(const PixelRect& posts, glm::dvec2 at) {
  return at.x >= posts.x0 && at.y >= posts.y0 && at.x <= posts.x1 - 1 && at.y <= posts.y1 - 1;
}

}  // namespace

GroundSight::GroundSight(const GeoTransform& transform, const DeformedSurface& surface,
                         const Camera& camera, const Tracer& tracer, const Grid<glm::vec2>& goes_to)
    : transform_(transform),
      surface_(surface),
      camera_(camera),
      tracer_(tracer),
      goes_to_(goes_to),
      cell_m_(0.5 * (transform.cell_x + transform.cell_y) /
              std::ldexp(1.0, static_cast<int>(surface.windows.size()))) {}

std::optional<glm::dvec3> GroundSight::ground(glm::dvec2 position) const {
  glm::dvec2 at = drawn_cell(goes_to_, transform_.to_cell(position.x, position.y));
  if (!holds({0, 0, surface_.vertices_m.width(), surface_.vertices_m.height()}, at))
    return std::nullopt;
  const DeformedSurface* finest = &surface_;
  for (const SurfaceWindow& window : surface_.windows) {
    if (!holds(window.replaces, at)) break;
    // Post (x, y) of a part is at post (x / 2, y / 2) of the surface before it.
    at = glm::dvec2(window.part.x0, window.part.y0) +
         2.0 * (at - glm::dvec2(window.replaces.x0, window.replaces.y0));
    finest = &window.surface;
  }
  return finest->origin + on_facet(finest->vertices_m, at);
}

double GroundSight::distance_m(glm::dvec3 point, glm::dvec2 pixel) const {
  const Ray ray = camera_.ray(pixel);
  return glm::dot(point - ray.origin, ray.direction);
}

double GroundSight::metres_per_px(glm::dvec3 point, glm::dvec2 pixel) const {
  // Across the line of sight, horizontal.
  const glm::dvec3 sight = camera_.ray(pixel).direction;
  glm::dvec3 across{sight.y, -sight.x, 0.0};
  const double level = glm::length(across);
  across = level > 1e-6 ? across / level : glm::dvec3(1.0, 0.0, 0.0);
  const double step_m = 1e-3 * std::max(1.0, distance_m(point, pixel));
  const auto beside = camera_.project(point + across * step_m);
  const double px = beside ? glm::length(*beside - pixel) : 0.0;
  return px > 1e-9 ? step_m / px : 1e9;
}

std::vector<double> GroundSight::hidden_by_m(const std::vector<Target>& targets) const {
  std::vector<Ray> rays;
  rays.reserve(targets.size());
  for (const Target& target : targets) rays.push_back(camera_.ray(target.pixel));
  std::vector<Hit> hits(targets.size());
  tracer_.intersect(rays, hits);
  std::vector<double> hidden(targets.size(), 0.0);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    // By rounding, a ground point may appear in front of itself.
    const double rounding_m = 0.1 + 1e-6 * targets[i].distance_m;
    if (hits[i].found && hits[i].distance_m < targets[i].distance_m - rounding_m)
      hidden[i] = targets[i].distance_m - hits[i].distance_m;
  }
  return hidden;
}

double GroundSight::nearest_metres_per_px() const {
  constexpr int columns = 15;
  const glm::ivec2 size = camera_.size();
  // From the lower edge upwards, until half of a row is ground.
  for (int step = 0; step < 16; ++step) {
    const double y = size.y - 0.5 - step * size.y / 16.0;
    std::vector<double> found;
    for (int k = 0; k < columns; ++k) {
      const glm::dvec2 pixel{(k + 0.5) * size.x / columns, y};
      const Ray ray = camera_.ray(pixel);
      Hit hit;
      tracer_.intersect(std::span(&ray, 1), std::span(&hit, 1));
      if (hit.found)
        found.push_back(metres_per_px(ray.origin + ray.direction * hit.distance_m, pixel));
    }
    if (2 * found.size() < columns) continue;
    return middle_value(std::move(found));
  }
  return 1.0;
}

namespace {

constexpr double beside =
    0.1;  // of the picture's size: lines are followed this far beyond its border
constexpr double chord_px = 0.3;  // max deviation of a line from the ground's
constexpr double end_px = 0.5;    // precision of the end of visible parts
constexpr double lift_mm =
    0.1;  // on the sheet: a bump that hides less than this of a line is ignored
constexpr int max_halvings = 24;  // of a segment
constexpr double finest_cells = 1.0 / 16.0;

LineSample sample_at(const GroundSight& sight, glm::dvec2 map) {
  LineSample sample;
  sample.map = map;
  const auto point = sight.ground(map);
  if (!point) return sample;
  sample.on_terrain = true;
  sample.point = *point;
  const auto pixel = sight.pixel(*point);
  if (!pixel || !std::isfinite(pixel->x) || !std::isfinite(pixel->y)) return sample;
  const glm::dvec2 size = sight.size();
  sample.pixel = *pixel;
  sample.projected = true;
  const glm::dvec2 room = beside * size;
  sample.in_picture = pixel->x > -room.x && pixel->y > -room.y && pixel->x < size.x + room.x &&
                      pixel->y < size.y + room.y;
  if (sample.in_picture) sample.distance_m = sight.distance_m(*point, *pixel);
  return sample;
}

// Both far beyond the same border.
bool beyond_one_border(const GroundSight& sight, const LineSample& a, const LineSample& b) {
  const glm::dvec2 size = sight.size();
  const glm::dvec2 low = glm::min(a.pixel, b.pixel);
  const glm::dvec2 high = glm::max(a.pixel, b.pixel);
  return high.x < -beside * size.x || low.x > (1.0 + beside) * size.x || high.y < -beside * size.y;
}

void halve(const GroundSight& sight, const LineSample& a, const LineSample& b, int depth,
           std::vector<LineSample>& out) {
  if (depth >= max_halvings) return;
  const double cells = glm::length(b.map - a.map) / sight.cell_m();
  const bool both = a.projected && b.projected;
  // Terrain may begin, or the line pass the eye, between two positions that are both invisible: the
  // search stops at cell size.
  if (!both && cells <= 1.0) return;
  if (both && beyond_one_border(sight, a, b) && cells <= 64.0) return;
  const double px = both ? glm::length(b.pixel - a.pixel) : 1e9;
  const bool coarse = cells > 0.5 && px > 1.0;
  if (!coarse && (!both || px <= 1.0 || cells <= finest_cells)) return;
  const LineSample centre = sample_at(sight, 0.5 * (a.map + b.map));
  if (!coarse) {
    if (!centre.projected) return;
    const glm::dvec2 way = b.pixel - a.pixel;
    const glm::dvec2 off = centre.pixel - a.pixel;
    if (std::abs(way.x * off.y - way.y * off.x) / px <= chord_px) return;
  }
  halve(sight, a, centre, depth + 1, out);
  out.push_back(centre);
  halve(sight, centre, b, depth + 1, out);
}

}  // namespace

void find_seen(const GroundSight& sight, std::vector<LineSample>& samples, double px_per_mm) {
  std::vector<GroundSight::Target> targets;
  std::vector<std::size_t> asks;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    LineSample& sample = samples[i];
    if (!sample.in_picture) continue;
    // Slightly above the ground: painters ignore the gap behind a smaller bump.
    const double lift_m =
        0.05 + lift_mm * px_per_mm * sight.metres_per_px(sample.point, sample.pixel);
    const glm::dvec3 lifted = sample.point + glm::dvec3(0.0, 0.0, lift_m);
    const auto pixel = sight.pixel(lifted);
    if (!pixel) continue;
    targets.push_back({lifted, *pixel, sight.distance_m(lifted, *pixel)});
    asks.push_back(i);
  }
  const std::vector<double> hidden = sight.hidden_by_m(targets);
  for (std::size_t k = 0; k < asks.size(); ++k) {
    samples[asks[k]].hidden_by_m = hidden[k];
    samples[asks[k]].seen = hidden[k] == 0.0;
  }
}

std::vector<LineSample> sample_line(const GroundSight& sight, const std::vector<glm::dvec2>& line,
                                    double px_per_mm) {
  std::vector<LineSample> samples = {sample_at(sight, line.front())};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const LineSample next = sample_at(sight, line[i]);
    const LineSample before = samples.back();
    halve(sight, before, next, 0, samples);
    samples.push_back(next);
  }
  find_seen(sight, samples, px_per_mm);
  // Ends of visible parts, by bisection.
  std::vector<LineSample> fine;
  fine.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    fine.push_back(samples[i]);
    if (i + 1 == samples.size() || !samples[i].in_picture || !samples[i + 1].in_picture ||
        samples[i].seen == samples[i + 1].seen)
      continue;
    LineSample a = samples[i];
    LineSample b = samples[i + 1];
    std::vector<LineSample> between(1);
    while (glm::length(b.pixel - a.pixel) > end_px && glm::length(b.map - a.map) > 1e-3) {
      between[0] = sample_at(sight, 0.5 * (a.map + b.map));
      if (!between[0].in_picture) break;
      find_seen(sight, between, px_per_mm);
      (between[0].seen == a.seen ? a : b) = between[0];
    }
    if (a.map != samples[i].map) fine.push_back(a);
    if (b.map != samples[i + 1].map) fine.push_back(b);
  }
  return fine;
}

PointLook look_at(const GroundSight& sight, glm::dvec3 point, glm::dvec2 pixel,
                  const FeatureKind& kind, double width_mm, double real_m, double px_per_mm,
                  double foreground_m_per_px) {
  const double m_per_px = sight.metres_per_px(point, pixel);
  PointLook look;
  const double nearer = std::clamp(foreground_m_per_px / m_per_px, 1e-6, 1.0);
  look.share = std::max(kind.min_share, exact::pow(nearer, kind.shrink));
  look.half_px =
      0.5 * std::max({width_mm * px_per_mm * look.share, kind.min_px, real_m / m_per_px});
  look.too_far = kind.coarsest_m > 0.0 && m_per_px * px_per_mm > kind.coarsest_m;
  return look;
}

}  // namespace belvedere
