#include "renderer/register/pair_proposals.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {
namespace {

double distance_between(glm::dvec2 a, glm::dvec2 b) { return exact::hypot(a.x - b.x, a.y - b.y); }

// Altitudes without the voids that were filled.
Grid<float> measured_altitudes(const Dem& dem) {
  Grid<float> out = dem.altitude_m;
  for (std::size_t i = 0; i < dem.filled.size(); ++i)
    if (dem.filled[i] != 0) out[i] = std::numeric_limits<float>::quiet_NaN();
  return out;
}

}  // namespace

std::optional<double> measured_altitude_m(const Dem& dem, glm::dvec2 position) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  if (!(cell.x >= 0.0 && cell.y >= 0.0 && cell.x <= dem.width() - 1.0 &&
        cell.y <= dem.height() - 1.0))
    return std::nullopt;
  const int x = static_cast<int>(std::lround(cell.x)), y = static_cast<int>(std::lround(cell.y));
  if (!dem.filled.empty() && dem.filled(x, y) != 0) return std::nullopt;
  return static_cast<double>(sample_bilinear(dem.altitude_m, cell.x, cell.y));
}

std::vector<KnownPlace> known_places(const Dem& dem, std::span<const NamedPlace> named,
                                     const KnownPlacesParameters& parameters) {
  std::vector<KnownPlace> out;
  for (const Summit& summit :
       find_summits(measured_altitudes(dem), {parameters.min_prominence_m, parameters.max_summits}))
    out.push_back({{},
                   dem.transform.to_crs(summit.x, summit.y),
                   static_cast<double>(summit.altitude_m),
                   static_cast<double>(summit.prominence_m)});
  const std::size_t summits = out.size();
  for (const NamedPlace& place : named) {
    const std::optional<double> altitude = measured_altitude_m(dem, place.position);
    if (!altitude) continue;
    const std::optional<std::size_t> summit =
        place.summit
            ? nearest_place(std::span(out).first(summits), place.position, parameters.near_by_m)
            : std::nullopt;
    if (summit && out[*summit].name.empty())
      out[*summit].name = place.name;
    else
      out.push_back({place.name, place.position, *altitude, 0.0});
  }
  return out;
}

std::optional<std::size_t> nearest_place(std::span<const KnownPlace> places, glm::dvec2 position,
                                         double radius_m) {
  std::optional<std::size_t> best;
  double nearest = radius_m;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double distance = distance_between(places[i].position, position);
    if (distance < nearest || (!best && distance == nearest)) nearest = distance, best = i;
  }
  return best;
}

ProposedPixel propose_pixel(const Registration& registration, const DisplacementField& field,
                            const KnownPlace& place) {
  ProposedPixel out;
  out.pixel = registered_pixel(registration, field, place.position, place.altitude_m);
  out.sigma_px =
      exact::hypot(registration.sigma_px,
                   registered_sigma_px(registration, field, place.position, place.altitude_m));
  return out;
}

bool is_seen(const RegisteredView& view, const KnownPlace& place) {
  const auto at = view.map().to_image(glm::dvec3(place.position, place.altitude_m));
  if (!at || !at->in_picture) return false;
  // Pixels around are tried too: a summit's own ground may cover its top, more so on a coarser DEM.
  constexpr double nearer = 0.97;  // ratio of distances
  constexpr int around_px = 1;
  for (int dy = -around_px; dy <= around_px; ++dy)
    for (int dx = -around_px; dx <= around_px; ++dx) {
      const auto shown = view.map().to_geo(at->pixel + glm::dvec2(dx, dy));
      if (shown && shown->distance_m > nearer * at->distance_m) return true;
    }
  return false;
}

std::vector<ProposedPlace> propose_places(std::span<const KnownPlace> places,
                                          std::span<const ProposedPixel> pixels,
                                          const std::vector<bool>& seen, glm::dvec2 pixel,
                                          double scale) {
  constexpr double min_px = 12.0, max_px = 60.0, sigmas = 3.0, named_m = 300.0, min_m = 10.0;
  std::vector<std::pair<double, ProposedPlace>> found;  // minus ln of the likelihood
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double off = distance_between(pixels[i].pixel, pixel);
    const double sigma = pixels[i].sigma_px;
    if (!seen[i] || off > std::clamp(sigmas * sigma, min_px * scale, max_px * scale)) continue;
    const double stands_out =
        std::max(places[i].prominence_m, places[i].name.empty() ? min_m : named_m);
    found.push_back(
        {0.5 * square(off / sigma) + 2.0 * exact::log(sigma) - exact::log(stands_out), {i, off}});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ProposedPlace> out(found.size());
  std::transform(found.begin(), found.end(), out.begin(),
                 [](const auto& each) { return each.second; });
  return out;
}

namespace {

// Between the pixels of two rows: what is seen above it is farther away, or sky.
struct Jump {
  int y = 0;  // of the lower pixel
  bool skyline = false;
};

std::vector<Jump> jumps_of_column(const RegisteredGround& ground, int x, float min_jump) {
  std::vector<Jump> out;
  for (int y = 1; y < ground.distance_m.height(); ++y) {
    const float above = ground.distance_m(x, y - 1);
    const float below = ground.distance_m(x, y);
    if (std::isnan(below)) continue;
    const bool skyline = std::isnan(above);
    if (skyline || above > min_jump * below) out.push_back({y, skyline});
  }
  return out;
}

// A line that may go on in the next column.
struct OpenLine {
  SeenLine line;
  int last_y = 0;
};

// The open line of that kind that ends nearest to the jump, if none of the column's other jumps
// took it.
std::optional<std::size_t> nearest_end(const std::vector<OpenLine>& open,
                                       const std::vector<bool>& taken, const Jump& jump,
                                       int max_step_px) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const int step = std::abs(open[i].last_y - jump.y);
    if (taken[i] || open[i].line.skyline != jump.skyline || step > max_step_px) continue;
    if (!best || step < std::abs(open[*best].last_y - jump.y)) best = i;
  }
  return best;
}

}  // namespace

std::vector<SeenLine> seen_lines(const RegisteredGround& ground,
                                 const SeenLinesParameters& parameters) {
  std::vector<SeenLine> out;
  std::vector<OpenLine> open;
  const auto end = [&](SeenLine line) {
    if (static_cast<int>(line.points.size()) >= parameters.min_length_px)
      out.push_back(std::move(line));
  };
  for (int x = 0; x < ground.distance_m.width(); ++x) {
    std::vector<bool> taken(open.size(), false);
    std::vector<OpenLine> begun;
    for (const Jump& jump : jumps_of_column(ground, x, parameters.min_jump)) {
      const glm::vec2 point(static_cast<float>(x) + 0.5F, static_cast<float>(jump.y));
      const std::optional<std::size_t> found =
          nearest_end(open, taken, jump, parameters.max_step_px);
      if (!found) {
        begun.push_back({{jump.skyline, {point}}, jump.y});
        continue;
      }
      taken[*found] = true;
      open[*found].line.points.push_back(point);
      open[*found].last_y = jump.y;
    }
    std::vector<OpenLine> next;
    for (std::size_t i = 0; i < open.size(); ++i)
      taken[i] ? next.push_back(std::move(open[i])) : end(std::move(open[i].line));
    for (OpenLine& line : begun) next.push_back(std::move(line));
    open = std::move(next);
  }
  for (OpenLine& line : open) end(std::move(line.line));
  return out;
}

}  // namespace belvedere
