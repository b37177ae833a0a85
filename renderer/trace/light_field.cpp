#include "renderer/trace/light_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/masks/polygon.h"
#include "base/math.h"
#include "base/noise.h"
#include "base/random.h"

namespace belvedere {
namespace {

// A cloud's edge: shift by its two sizes of lobes and their widths, in shares of the radius. Noise
// is limited to ±2 deviations.
constexpr double lobe_move = 0.26;
constexpr double lobe_sigma = 0.42;
constexpr double tuft_move = 0.10;
constexpr double tuft_sigma = 0.14;
constexpr double max_noise = 2.0;
// Its shade is slightly uneven too.
constexpr double thin_share = 0.12;

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double squared = glm::dot(along, along);
  const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + along * t));
}

// Distance of a position outside a region, m; 0 inside.
double outside_m(const LightRegion& region, glm::dvec2 p) {
  if (region.rings.empty()) return std::max(0.0, glm::length(p - region.centre) - region.radius_m);
  if (encloses(region.rings, p)) return 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<glm::dvec2>& ring : region.rings)
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      nearest = std::min(nearest, distance_to_segment(p, ring[i], ring[j]));
  return nearest;
}

glm::dvec3 sun_above_horizon(glm::dvec3 sun, const std::string& whose) {
  const double length = glm::length(sun);
  if (!(length > 0.5 && length < 2.0 && sun.z > 0.0))
    throw Error(ErrorKind::usage, whose,
                fmt::format("a sun in the direction {:.3f}, {:.3f}, {:.3f}", sun.x, sun.y, sun.z),
                "a sun above the horizon");
  return sun / length;
}

float side_of(glm::dvec3 sun, glm::dvec2 right) {
  return sun.x * right.x + sun.y * right.y < 0.0 ? -1.0F : 1.0F;
}

float mixed(float a, double b, double share) {
  return static_cast<float>(static_cast<double>(a) + (b - static_cast<double>(a)) * share);
}

}  // namespace

LightField::LightField(glm::dvec3 sun_direction, glm::dvec2 right, std::vector<LightRegion> regions,
                       std::vector<CloudShadow> clouds, std::uint64_t seed)
    : right_(right), regions_(std::move(regions)), clouds_(std::move(clouds)), seed_(seed) {
  sun_above_horizon(sun_direction, "the picture's light");
  picture_.sun = sun_direction;
  picture_.side = side_of(sun_direction, right_);
  for (LightRegion& region : regions_) {
    region.sun_direction = sun_above_horizon(region.sun_direction, "a region of light");
    glm::dvec2 low = region.centre - region.radius_m;
    glm::dvec2 high = region.centre + region.radius_m;
    if (!region.rings.empty()) {
      low = glm::dvec2(std::numeric_limits<double>::infinity());
      high = -low;
      for (const std::vector<glm::dvec2>& ring : region.rings)
        for (const glm::dvec2 p : ring) low = glm::min(low, p), high = glm::max(high, p);
    }
    region_boxes_.push_back({low - region.blend_m, high + region.blend_m});
    sides_.push_back(side_of(region.sun_direction, right_));
  }
  for (const CloudShadow& cloud : clouds_) {
    const double reach =
        cloud.radius_m * (1.0 + max_noise * (lobe_move + tuft_move)) + 0.5 * cloud.blend_m;
    cloud_boxes_.push_back({cloud.centre - reach, cloud.centre + reach});
  }
}

double LightField::weight(const LightRegion& region, glm::dvec2 position_m) {
  const double outside = outside_m(region, position_m);
  if (outside <= 0.0) return 1.0;
  return outside >= region.blend_m ? 0.0 : 1.0 - smoothstep(outside / region.blend_m);
}

double LightField::cloud_share(const CloudShadow& cloud, glm::dvec2 position_m) const {
  // By its own position, so that its shape does not depend on other clouds of the scene.
  const glm::dvec2 at = position_m - cloud.centre;
  const auto whole = [](double m) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::llround(m)));
  };
  const std::uint64_t own =
      mix_bits(mix_bits(seed_ + whole(cloud.centre.x)) + whole(cloud.centre.y));
  const auto noise = [&](std::uint64_t part, double sigma) {
    return std::clamp(gaussian_noise(stream_seed(own, Stream::cloud_shadows, part), at.x, at.y,
                                     sigma * cloud.radius_m),
                      -max_noise, max_noise);
  };
  const double lobes = noise(0, lobe_sigma);
  const double tufts = noise(1, tuft_sigma);
  const double edge_m = cloud.radius_m * (1.0 + lobe_move * lobes + tuft_move * tufts);
  const double inside_m = edge_m - glm::length(at);
  const double covered = cloud.blend_m > 0.0 ? smoothstep(0.5 + inside_m / cloud.blend_m)
                                             : (inside_m >= 0.0 ? 1.0 : 0.0);
  return cloud.strength * covered * (1.0 - thin_share * std::abs(lobes) / max_noise);
}

GroundLight LightField::at(glm::dvec2 position_m) const {
  GroundLight light = picture_;
  bool turned = false;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    if (!region_boxes_[i].has(position_m)) continue;
    const LightRegion& region = regions_[i];
    const double share = weight(region, position_m);
    if (share <= 0.0) continue;
    light.sun = light.sun * (1.0 - share) + region.sun_direction * share;
    light.strength = mixed(light.strength, region.strength, share);
    light.warmth = mixed(light.warmth, region.warmth, share);
    light.side = mixed(light.side, static_cast<double>(sides_[i]), share);
    turned = true;
  }
  // All suns are above the horizon, so their weighted sum is never zero.
  if (turned) light.sun = glm::normalize(light.sun);
  for (std::size_t i = 0; i < clouds_.size(); ++i)
    if (cloud_boxes_[i].has(position_m))
      light.strength *= static_cast<float>(1.0 - cloud_share(clouds_[i], position_m));
  return light;
}

}  // namespace belvedere
