#include "renderer/mist/mist_sight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/trace/guidance_rays.h"

namespace belvedere {
namespace {

constexpr double shortest_m =
    50.0;  // length of the first octave; each is twice as long as the one before
constexpr int octave_count = 13;       // up to 200 km
constexpr double length_units = 46.0;  // of the heaps that are seen as heaps; swells are longer
constexpr double sigma_share =
    0.2;  // deviation of the noise's blur, relative to the length of its heaps
constexpr double height_share = 0.055;    // of a heap, relative to its length
constexpr double roundness = 0.05;        // of the creases between heaps: 0 sharp
constexpr double mean_heap = 0.84;        // of √(n² + roundness), n normal
constexpr double highest_heap = 2.2;      // clipped there, so that the surface is bounded
constexpr double octaves_together = 6.5;  // max sum of the octaves, in heights of heaps
constexpr double busy_steps =
    2.6;  // how much longer than heaps the calm and busy areas are, in octaves

// Height of an octave whose heaps are 2^steps as long as the visible heaps: swells are long and
// flat.
double height_of(double steps) {
  const double weight = smoothstep(-2.2, -0.9, steps) * (1.0 - smoothstep(1.5, 2.5, steps));
  return weight <= 0.0 ? 0.0 : weight * exact::exp2(steps > 0.0 ? 0.5 * steps : steps);
}

}  // namespace

MistBillows::MistBillows(std::uint64_t seed, double strength, double highest_m)
    : strength_(strength),
      highest_m_(highest_m),
      reach_m_(strength * highest_m * octaves_together) {
  if (flat()) return;
  for (int k = 0; k < octave_count; ++k)
    octaves_.emplace_back(stream_seed(seed, Stream::mist_billows, static_cast<std::uint64_t>(k)),
                          sigma_share * std::ldexp(shortest_m, k));
}

double MistBillows::length_m(double metres_per_unit) { return length_units * metres_per_unit; }

// Noise of deviation about 1 whose patches are 2^steps as long as heaps: a mixture of two octaves.
double MistBillows::patches(glm::dvec2 position, double octave) {
  const double below = std::floor(octave);
  const double share = octave - below;
  const auto of = [&](double k) {
    const auto number = static_cast<std::size_t>(std::clamp(k, 0.0, octave_count - 1.0));
    return static_cast<double>(octaves_[number](position.y, -position.x));
  };
  return ((1.0 - share) * of(below) + share * of(below + 1.0)) /
         std::sqrt((1.0 - share) * (1.0 - share) + share * share);
}

double MistBillows::height_m(glm::dvec2 position, double metres_per_unit) {
  if (flat()) return 0.0;
  const double longest_m = length_m(metres_per_unit);
  const double tallest_m = std::min(height_share * longest_m, highest_m_);
  const double octave = exact::log2(longest_m / shortest_m);
  // Heaps gather in groups; between them the sea is calm.
  const double busy = std::clamp(0.60 + 0.45 * patches(position, octave + busy_steps), 0.10, 1.2);
  double sum = 0.0;
  for (int k = std::max(0, static_cast<int>(octave) - 2); k < octave_count; ++k) {
    const double steps = k - octave;
    if (steps >= 2.5) break;
    const double height = height_of(steps);
    if (height <= 0.0) continue;
    const double n = octaves_[static_cast<std::size_t>(k)](position.x, position.y);
    const double heap = std::min(std::sqrt(n * n + roundness), highest_heap) - mean_heap;
    sum += (steps < 1.0 ? busy : 1.0 - (1.0 - busy) * std::max(0.0, 2.0 - steps)) * height * heap;
  }
  return strength_ * tallest_m * sum;
}

namespace {

constexpr double log_50 = 3.912023005428146;

// Integral of the density from the surface down, in metres of full density.
double sum_below(const MistProfile& profile, double below_m) {
  if (below_m <= 0.0) return 0.0;
  if (below_m < profile.edge_m) return below_m * below_m / (2.0 * profile.edge_m);
  return below_m - 0.5 * profile.edge_m;
}

}  // namespace

MistProfile make_mist_profile(double visibility_m, double edge_m) {
  return {log_50 / visibility_m, edge_m};
}

double extinction_at(const MistProfile& profile, double below_m) {
  if (below_m <= 0.0) return 0.0;
  return profile.full_per_m * (below_m < profile.edge_m ? below_m / profile.edge_m : 1.0);
}

double optical_depth(const MistProfile& profile, double length_m, double below_from_m,
                     double below_to_m) {
  const double change = below_to_m - below_from_m;
  // For a level path the quotient would be of two small differences.
  if (std::abs(change) < 1e-3)
    return length_m * extinction_at(profile, 0.5 * (below_from_m + below_to_m));
  return length_m * profile.full_per_m *
         (sum_below(profile, below_to_m) - sum_below(profile, below_from_m)) / change;
}

namespace {

constexpr int tile_px = 64;
constexpr int looks =
    24;  // initial samples along a line of sight to find where it is low enough for mist
constexpr double opaque = 6.0;  // optical depth behind which nothing is visible
constexpr int max_steps = 400;
constexpr double steps_a_heap = 8.0;  // along a line of sight per length of a heap
constexpr double sea_heap_m = 50.0;  // approximate upper limit of the heaps of a sea; at a shore no
                                     // surface sinks or rises much more at a shore
constexpr double valley_edge = 0.5;  // max softness of their edges, relative to the mist's height
constexpr double valley_heap =
    0.22;  // limit of the heaps in valleys, relative to the mist's height
constexpr double shadow_reach_m = 60000.0;
constexpr double shadow_radius = 0.045;  // radius of the sun for soft shadows in mist, rad
constexpr int shadow_rays = 8;
constexpr double flattening =
    45.0;  // metres per unit of the sheet at which half of the light on heaps remains
constexpr double nothing = 1e-4;  // an invisible share

// One layer, for one thread.
struct Layer {
  Layer(const MistParameters& parameters, const MistAir& air, std::size_t number)
      : kind(parameters.kind),
        bed(parameters, air.ground, air.rim_fade_m,
            stream_seed(air.seed, Stream::mist_layers, number)),
        billows(stream_seed(air.seed, Stream::mist_layers, number), parameters.billows,
                parameters.kind == MistKind::sea ? sea_heap_m : valley_heap * parameters.height_m),
        profile(
            make_mist_profile(parameters.visibility_m,
                              parameters.kind == MistKind::valley
                                  ? std::min(parameters.edge_m, valley_edge * parameters.height_m)
                                  : parameters.edge_m)),
        valley_step_m(std::clamp(0.9 * parameters.height_m, 60.0, 250.0)) {}
  MistKind kind;
  MistBed bed;
  MistBillows billows;
  MistProfile profile;
  double valley_step_m;

  double highest_m() const { return bed.highest_m() + (billows.flat() ? 0.0 : billows.reach_m()); }
};

// A line of sight, by the distance from its origin.
struct SightLine {
  SightLine(const MistView& view, glm::dvec2 pixel)
      : deformation(view.deformation), ray(view.camera.ray(pixel)) {
    const Ray left = view.camera.ray({pixel.x - 0.5, pixel.y});
    const Ray right = view.camera.ray({pixel.x + 0.5, pixel.y});
    apart = (right.origin - left.origin) * view.pixels_per_unit;
    spread = (right.direction - left.direction) * view.pixels_per_unit;
  }
  glm::dvec3 drawn(double t) const { return ray.origin + ray.direction * t; }
  // The undeformed position there; where it cannot be found, the drawn one.
  glm::dvec3 position(double t) const {
    const glm::dvec3 at = drawn(t);
    return undeform(deformation, at).value_or(at);
  }
  // Metres of ground in a unit of the sheet.
  double metres_per_unit(double t) const { return std::max(1e-3, glm::length(apart + spread * t)); }

  const Deformation& deformation;
  Ray ray;
  glm::dvec3 apart, spread;
};

// The first position on the line, to a metre, that is below `highest_m`; nothing if there is none
// before `end_m`.
std::optional<double> find_entry(const SightLine& line, double end_m, double highest_m) {
  double above = 0.0;
  for (int k = 0; k <= looks; ++k) {
    double below = end_m * k / looks;
    if (line.position(below).z >= highest_m) {
      above = below;
      continue;
    }
    if (k == 0) return 0.0;
    while (below - above > 1.0) {
      const double centre = 0.5 * (above + below);
      (line.position(centre).z >= highest_m ? above : below) = centre;
    }
    return above;
  }
  return std::nullopt;
}

// The part of one layer along a line of sight.
struct Met {
  double share = 0.0;
  double depth_m = 0.0;
  glm::dvec2 position{0.0};
  double altitude_m = 0.0;
  double metres_per_unit = 1.0;
};

struct Place {
  double below_m;  // the surface, < 0 above
  double cover;
};
Place position_of(Layer& layer, const SightLine& line, double t, double metres_per_unit) {
  const glm::dvec3 at = line.position(t);
  const MistBed::Column column = layer.bed.at(glm::dvec2(at));
  const double below = column.top_m - at.z;
  // Heaps are evaluated only where they matter.
  if (layer.billows.flat() || below < -layer.billows.reach_m()) return {below, column.cover};
  return {below + layer.billows.height_m(glm::dvec2(at), metres_per_unit), column.cover};
}

double step_of(const Layer& layer, double below_m, double metres_per_unit, double span_m) {
  const double own = layer.kind == MistKind::valley ? layer.valley_step_m
                     : layer.billows.flat()         ? span_m / looks
                                            : MistBillows::length_m(metres_per_unit) / steps_a_heap;
  // High above the layer large steps miss nothing: a line sinks no faster than its length.
  const double reach_m = layer.billows.flat() ? 0.0 : layer.billows.reach_m();
  return std::max({own, span_m / max_steps, 0.6 * (-below_m - reach_m)});
}

Met march(Layer& layer, const SightLine& line, double end_m) {
  Met met;
  const std::optional<double> entry = find_entry(line, end_m, layer.highest_m());
  if (!entry || *entry >= end_m) return met;
  const double span_m = end_m - *entry;
  double t = *entry;
  double metres = line.metres_per_unit(t);
  Place at = position_of(layer, line, t, metres);
  double depth = 0.0;
  double mean = 0.0;
  while (t < end_m && depth < opaque) {
    const double next = std::min(end_m, t + step_of(layer, at.below_m, metres, span_m));
    metres = line.metres_per_unit(next);
    const Place there = position_of(layer, line, next, metres);
    const double more = 0.5 * (at.cover + there.cover) *
                        optical_depth(layer.profile, next - t, at.below_m, there.below_m);
    if (more > 0.0) {
      const double weight = exact::exp(-depth) - exact::exp(-depth - more);
      mean += weight * 0.5 * (t + next);
      met.share += weight;
      depth += more;
    }
    t = next;
    at = there;
  }
  if (met.share <= nothing) return {};
  met.depth_m = mean / met.share;
  const glm::dvec3 position = line.position(met.depth_m);
  met.position = glm::dvec2(position);
  met.altitude_m = position.z;
  met.metres_per_unit = line.metres_per_unit(met.depth_m);
  // Nearly opaque counts as opaque.
  met.share = std::min(1.0, met.share / (1.0 - exact::exp(-opaque)));
  return met;
}

// Light on the heaps around a position: the sun on their slopes, crests over hollows, and the shade
// of nearer heaps.
double light_on_heaps(Layer& layer, const Met& met, glm::dvec3 sun) {
  constexpr double even = 0.60;  // of a level surface
  if (layer.billows.flat()) return even;
  const double length = MistBillows::length_m(met.metres_per_unit);
  const auto height = [&](double east, double north) {
    return layer.billows.height_m(met.position + glm::dvec2(east, north), met.metres_per_unit);
  };
  const double step = length / 16.0;
  constexpr double relief = 2.4;  // painters exaggerate the modelling of clouds
  const double east = height(step, 0.0) - height(-step, 0.0);
  const double north = height(0.0, step) - height(0.0, -step);
  const glm::dvec3 normal = glm::normalize(
      glm::dvec3(-relief * east / (2.0 * step), -relief * north / (2.0 * step), 1.0));
  const double here = height(0.0, 0.0);
  const double tall = 0.18 * layer.billows.reach_m();
  double light = even + 0.80 * (glm::dot(normal, sun) - sun.z) + 0.16 * here / tall;
  const double level = std::sqrt(sun.x * sun.x + sun.y * sun.y);
  if (level > 0.05) {
    double over = 0.0;
    for (const double share : {0.16, 0.36, 0.7}) {
      const double away = share * length;
      over = std::max(over, height(away * sun.x / level, away * sun.y / level) - here -
                                0.5 * away * sun.z / level);
    }
    light -= 0.30 * smoothstep(0.0, tall, over);
  }
  // Towards the horizon heaps merge into an even light.
  const double far = met.metres_per_unit / flattening;
  return even + (unit(light) - even) / (1.0 + far * far);
}

// Share of the sun visible from a position in the air. The rays of one position form their own
// bundle.
double sun_seen(const MistView& view, const std::vector<glm::dvec2>& disc, glm::dvec3 position) {
  const glm::dvec3 sun = view.sun_direction;
  if (view.tracer == nullptr || sun.z <= 0.0) return 1.0;
  const glm::dvec3 aside = glm::normalize(glm::cross(
      sun, std::abs(sun.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0)));
  const glm::dvec3 upwards = glm::cross(aside, sun);
  std::array<Ray, shadow_rays> rays;
  std::array<std::uint8_t, shadow_rays> blocked{};
  for (std::size_t k = 0; k < rays.size(); ++k)
    rays[k] = {position,
               glm::normalize(sun + shadow_radius * (disc[k].x * aside + disc[k].y * upwards))};
  view.tracer->occluded(rays, shadow_reach_m, blocked);
  return 1.0 - static_cast<double>(std::count(blocked.begin(), blocked.end(), std::uint8_t{1})) /
                   shadow_rays;
}

// Working data of one thread.
class Looker {
 public:
  Looker(const MistAir& air, const MistView& view, const std::vector<glm::dvec2>& disc)
      : air_(air), view_(view), disc_(disc) {
    layers_.reserve(air.layers.size());
    for (std::size_t k = 0; k < air.layers.size(); ++k) layers_.emplace_back(air.layers[k], air, k);
    for (const LeeCloud& cloud : air.clouds) edges_.emplace_back(cloud);
    if (view.sun_direction.z > 0.0) sun_ = view.sun_direction;
  }

  struct Seen {
    float share = 0.F, light = 0.F, altitude_m = 0.F;
    double depth_m = std::numeric_limits<double>::infinity();
  };
  Seen look(glm::dvec2 pixel, float ground_m) {
    const SightLine line(view_, pixel);
    const double end_m = std::isinf(ground_m) ? air_.farthest_m : static_cast<double>(ground_m);
    found_.clear();
    for (Layer& layer : layers_) {
      const Met met = march(layer, line, end_m);
      if (met.share <= nothing) continue;
      const double lit = sun_seen(view_, disc_, line.drawn(met.depth_m));
      const double light = light_on_heaps(layer, met, sun_) * (0.40 + 0.60 * lit);
      found_.push_back({static_cast<float>(met.share), static_cast<float>(light),
                        static_cast<float>(met.altitude_m), met.depth_m});
    }
    for (std::size_t k = 0; k < air_.clouds.size(); ++k) {
      const LeeSight sight =
          see_lee_cloud(air_.clouds[k], edges_[k], line.ray, pixel, ground_m, sun_);
      if (sight.share > static_cast<float>(nothing))
        found_.push_back({sight.share, sight.light, static_cast<float>(air_.clouds[k].altitude_m),
                          sight.depth_m});
    }
    return joined();
  }

 private:
  // Far to near, each over what is behind it.
  Seen joined() {
    if (found_.empty()) return {};
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Seen& a, const Seen& b) { return a.depth_m > b.depth_m; });
    Seen sum{};
    sum.depth_m = 0.0;
    double weights = 0.0;
    for (const Seen& one : found_) {
      weights = weights * (1.0 - static_cast<double>(one.share)) + static_cast<double>(one.share);
      const auto mix = static_cast<float>(static_cast<double>(one.share) / weights);
      sum.light += (one.light - sum.light) * mix;
      sum.altitude_m += (one.altitude_m - sum.altitude_m) * mix;
      sum.depth_m += (one.depth_m - sum.depth_m) * static_cast<double>(mix);
    }
    sum.share = static_cast<float>(weights);
    return sum;
  }

  const MistAir& air_;
  const MistView& view_;
  const std::vector<glm::dvec2>& disc_;
  glm::dvec3 sun_{0.0, 0.0, 1.0};
  std::vector<Layer> layers_;
  std::vector<LeeEdges> edges_;
  std::vector<Seen> found_;
};

}  // namespace

MistSight see_mist(const MistAir& air, const MistView& view, const Grid<float>& depth_m,
                   glm::ivec2 origin_px) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  MistSight sight{Grid<float>(width, height, 0.F),
                  Grid<float>(width, height, std::numeric_limits<float>::infinity()),
                  Grid<float>(width, height, 0.F), Grid<float>(width, height, 0.F)};
  if (air.empty()) return sight;
  const std::vector<glm::dvec2> disc = disc_positions(shadow_rays);
  parallel_tiles(width, height, tile_px, [&](PixelRect tile) {
    Looker looker(air, view, disc);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::size_t i = depth_m.index(x, y);
        const Looker::Seen seen =
            looker.look({origin_px.x + x + 0.5, origin_px.y + y + 0.5}, depth_m[i]);
        sight.share[i] = seen.share;
        sight.depth_m[i] = static_cast<float>(seen.depth_m);
        sight.light[i] = seen.light;
        sight.altitude_m[i] = seen.altitude_m;
      }
  });
  return sight;
}

}  // namespace belvedere
