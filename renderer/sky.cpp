#include "renderer/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/base/noise.h"
#include "renderer/base/parallel.h"
#include "renderer/base/random.h"
#include "renderer/picture_noise.h"

namespace belvedere {
namespace {

float smooth_step(float from, float to, float value) {
  const float t = std::clamp((value - from) / (to - from), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

// What clouds are measured in: the height of the sky, but no more than a narrow picture can carry.
double cloud_scale_px(const SkyParameters& p) { return std::min(p.horizon_px, 0.09 * p.picture_size.x); }

// A row of cumulus, seen from below the layer: the farther, the lower, the smaller and the denser.
struct CloudRow {
  double base;   // height of the flat base above the horizon, in heights of the sky
  double width;  // of a cloud, in cloud scales
  double opacity;
};
constexpr std::array<CloudRow, 5> cloud_rows = {
    {{0.04, 0.40, 0.45}, {0.10, 0.62, 0.70}, {0.19, 0.95, 0.90}, {0.32, 1.40, 1.00}, {0.47, 1.90, 1.00}}};

// One cloud over a flat base: heads under an arch, larger in the middle, the near ones low.
Cloud make_cloud(const SkyParameters& p, std::uint64_t seed, std::int64_t cell, double middle_px, double base_px, double width_px,
                 double opacity) {
  std::int64_t draw = 0;
  const auto uniform = [&] { return random_uniform(seed, cell, draw++, 1); };
  const double height_px = width_px * (0.20 + 0.16 * uniform());
  const double peak = -0.45 + 0.9 * uniform();  // where the heap is highest
  const int count = 16 + static_cast<int>(16.0 * uniform());
  Cloud cloud{static_cast<float>(base_px), {}, {}, static_cast<float>(opacity), {}};
  for (int k = 0; k < count; ++k) {
    const double u = -1.0 + 2.0 * (k + uniform()) / count;
    const double side = u < peak ? (peak - u) / (1.0 + peak) : (u - peak) / (1.0 - peak);
    const double arch = std::sqrt(std::max(0.0, 1.0 - side * side)) * (0.55 + 0.45 * uniform());
    const double radius = height_px * (0.16 + 0.30 * arch) * (0.75 + 0.5 * uniform());
    const double rise = std::max(0.0, arch * height_px - radius) * (0.25 + 0.75 * uniform());
    cloud.heads.push_back(
        {{static_cast<float>(middle_px + 0.5 * width_px * u), static_cast<float>(base_px - rise)}, static_cast<float>(radius)});
  }
  std::stable_sort(cloud.heads.begin(), cloud.heads.end(), [](const CloudHead& a, const CloudHead& b) { return a.centre.y < b.centre.y; });
  cloud.from = glm::vec2(1e9F);
  cloud.to = glm::vec2(-1e9F);
  for (const CloudHead& head : cloud.heads) {
    cloud.from = glm::min(cloud.from, head.centre - 1.5F * head.radius);
    cloud.to = glm::max(cloud.to, head.centre + 1.5F * head.radius);
  }
  cloud.to.y = static_cast<float>(base_px + 0.05 * cloud_scale_px(p));
  return cloud;
}

struct Layer {
  glm::vec3 colour{0.0F};
  float alpha = 0.0F;
};

// What a cloud shows at a place: its heads over each other, each lit from above and from the sun's side.
Layer cloud_at(const Cloud& cloud, glm::vec2 place, glm::vec2 wobble, const Palette& palette, glm::vec2 towards_light) {
  Layer layer;
  const float height = cloud.base_px - cloud.from.y;
  for (const CloudHead& head : cloud.heads) {
    const glm::vec2 offset = (place - head.centre) / head.radius + wobble;
    const float distance = glm::length(offset);
    if (distance >= 1.25F) continue;
    const float cover = 1.0F - smooth_step(0.55F, 1.25F, distance);
    const float lit = std::clamp(0.52F + 0.55F * glm::dot(offset, towards_light), 0.0F, 1.0F);
    // The foot of the heap lies in its own shade.
    const float raised = smooth_step(-0.05F, 0.75F, (cloud.base_px - place.y) / height);
    const float light = std::clamp(lit * 0.52F + raised * 0.52F, 0.0F, 1.0F);
    const glm::vec3 colour = glm::mix(palette.cloud_shade, palette.cloud_light, light);
    layer.colour = layer.alpha + cover > 0.0F ? glm::mix(layer.colour, colour, layer.alpha == 0.0F ? 1.0F : cover) : colour;
    layer.alpha = layer.alpha + cover * (1.0F - layer.alpha);
  }
  // The flat base: it ends in a soft line.
  layer.alpha *= smooth_step(-0.10F, 0.12F, (cloud.base_px - place.y) / height - 0.02F * wobble.x) * cloud.opacity;
  return layer;
}

// Fields of noise that the cirrus is made of; one set a thread.
struct CirrusNoises {
  explicit CirrusNoises(std::uint64_t seed) : streaks(seed, 1.0), threads(seed + 1, 1.0), waver(seed + 2, 1.0), patches(seed + 3, 1.0) {}
  GroundNoise streaks, threads, waver, patches;
};

// Cirrus at a place: long thin veils that fan out from a vanishing point on the horizon, far beyond the side of the picture; 0…1.
float cirrus_at(const SkyParameters& p, double x_px, double elevation, CirrusNoises& noises) {
  if (elevation < 0.12) return 0.0F;
  const double scale_px = cloud_scale_px(p);
  const double width = p.picture_size.x / scale_px;
  const double x = x_px / scale_px;
  const double rise = elevation * p.horizon_px / scale_px;
  const double distance = p.sun_image_x < 0.0 ? x + 0.6 * width : 1.6 * width - x;
  // In the fan: the angle above the horizon, and the logarithm of the distance along a ray.
  const double bend = 0.09 * noises.waver(x * 0.55, rise * 1.3);
  const double angle = (rise + bend) * 1.1 * width / distance;
  const double along = std::log(distance / width) * width;
  const float broad = noises.streaks(angle / 0.055, along / 0.75);
  const float fine = noises.threads(angle / 0.018, along / 0.55);
  const float where = noises.patches(x / 1.6, rise / 0.34);
  const float density = 0.42F * broad + 0.20F * fine + 0.62F * where - 0.62F + 0.4F * static_cast<float>(p.clouds - 1.0);
  return 0.55F * smooth_step(0.0F, 1.25F, density) * smooth_step(0.12F, 0.40F, static_cast<float>(elevation));
}

double median_or(std::vector<double> values, double fallback) {
  if (values.empty()) return fallback;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

glm::vec3 sky_gradient(const Palette& palette, double place) {
  const auto& stops = palette.sky;
  if (place <= stops.front().first) return stops.front().second;
  for (std::size_t i = 1; i < stops.size(); ++i)
    if (place < stops[i].first) {
      const auto share = static_cast<float>((place - stops[i - 1].first) / (stops[i].first - stops[i - 1].first));
      return glm::mix(stops[i - 1].second, stops[i].second, share);
    }
  return stops.back().second;
}

std::vector<Cloud> make_clouds(const SkyParameters& p) {
  std::vector<Cloud> clouds;
  const double sky_px = p.horizon_px;
  const double scale_px = cloud_scale_px(p);
  for (std::size_t r = 0; r < cloud_rows.size(); ++r) {
    const CloudRow& row = cloud_rows[r];
    const std::uint64_t seed = p.seed + 100 + r;
    const double cell_px = row.width * scale_px * 0.8;
    const auto last = static_cast<std::int64_t>(p.picture_size.x / cell_px) + 2;
    for (std::int64_t cell = -2; cell <= last; ++cell) {
      const double middle_px = (static_cast<double>(cell) + random_uniform(seed, cell, 0)) * cell_px;
      // Clouds keep together in banks.
      const double bank = gaussian_noise(p.seed + 90, middle_px / scale_px + 17.0 * static_cast<double>(r), static_cast<double>(r), 1.7);
      if (0.22 + 0.42 * bank + 0.35 * (p.clouds - 1.0) < random_uniform(seed, cell, 1)) continue;
      const double width_px = row.width * scale_px * (0.55 + 0.75 * random_uniform(seed, cell, 2));
      const double base_px = sky_px * (1.0 - row.base * (0.92 + 0.16 * random_uniform(seed, cell, 3)));
      if (p.clouds > 0.0) clouds.push_back(make_cloud(p, seed, cell, middle_px, base_px, width_px, row.opacity));
    }
  }
  return clouds;
}

Grid<glm::vec3> make_sky(const Grid<float>& depth_m, const Palette& palette, const SkyParameters& p, glm::ivec2 origin_px) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  Grid<glm::vec3> sky(width, height, glm::vec3(0.0F));
  const std::vector<Cloud> clouds = make_clouds(p);
  const double scale_px = cloud_scale_px(p);
  const glm::vec2 towards_light = glm::normalize(glm::vec2(p.sun_image_x < 0.0 ? -0.55F : 0.55F, -0.85F));
  parallel_rows(height, [&](int y) {
    CirrusNoises cirrus_noises(p.seed + 70);
    GroundNoise bands(p.seed + 83, 1.0);
    GroundNoise wobble_x(p.seed + 84, 0.030), wobble_y(p.seed + 85, 0.030), ripple_x(p.seed + 86, 0.010), ripple_y(p.seed + 87, 0.010);
    const double row_px = origin_px.y + y + 0.5;
    std::vector<const Cloud*> near_row;
    for (const Cloud& cloud : clouds)
      if (row_px >= cloud.from.y && row_px <= cloud.to.y) near_row.push_back(&cloud);
    for (int x = 0; x < width; ++x) {
      if (!std::isinf(depth_m(x, y))) continue;
      const double column_px = origin_px.x + x + 0.5;
      const double u = column_px / scale_px;  // of cloud edges
      const double w = row_px / scale_px;
      const double v = row_px / p.horizon_px;  // 0 top … 1 horizon
      // Long soft bands keep the gradient from looking ruled.
      const double place = v + 0.03 * bands(u * 0.9, v * 11.0) * std::clamp(2.0 * (1.0 - v), 0.0, 1.0);
      glm::vec3 colour = sky_gradient(palette, place);
      const float cirrus = p.clouds > 0.0 ? cirrus_at(p, column_px, 1.0 - v, cirrus_noises) : 0.0F;
      colour = glm::mix(colour, palette.cloud_light, cirrus);
      if (!near_row.empty()) {
        const glm::vec2 wobble = 0.16F * glm::vec2(wobble_x(u, w), wobble_y(u, w)) + 0.07F * glm::vec2(ripple_x(u, w), ripple_y(u, w));
        const glm::vec2 at(static_cast<float>(column_px), static_cast<float>(row_px));
        for (const Cloud* cloud : near_row) {
          if (at.x < cloud->from.x || at.x > cloud->to.x) continue;
          const Layer layer = cloud_at(*cloud, at, wobble, palette, towards_light);
          // Low clouds stand far away, in the air of the horizon.
          const float air = 0.45F * smooth_step(0.55F, 1.0F, static_cast<float>(v));
          colour = glm::mix(colour, glm::mix(layer.colour, sky_gradient(palette, 1.0), air), 0.88F * layer.alpha);
        }
      }
      sky(x, y) = glm::clamp(colour, 0.0F, 1.0F);
    }
  });
  return sky;
}

double skyline_row_px(const GuidanceBuffers& guidance, double fallback_px) {
  std::vector<double> rows;
  for (int x = 0; x < guidance.width(); ++x)
    for (int y = 0; y < guidance.height(); ++y)
      if (!guidance.is_sky(guidance.depth_m.index(x, y))) {
        rows.push_back(y);
        break;
      }
  return median_or(std::move(rows), fallback_px);
}

double skyline_row_px(const Camera& camera, const Tracer& tracer, double fallback_px) {
  constexpr int columns = 64;
  constexpr int steps = 96;
  const glm::dvec2 size(camera.size());
  std::vector<double> rows;
  for (int column = 0; column < columns; ++column) {
    const double x = (column + 0.5) * size.x / columns;
    const auto hits_at = [&](double y) {
      const Ray ray = camera.ray({x, y});
      Hit hit;
      tracer.intersect({&ray, 1}, {&hit, 1});
      return hit.found;
    };
    double sky = 0.0;
    double ground = -1.0;
    for (int step = 0; step < steps && ground < 0.0; ++step) {
      const double y = (step + 0.5) * size.y / steps;
      (hits_at(y) ? ground : sky) = y;
    }
    if (ground < 0.0) continue;
    while (ground - sky > 1.0) {
      const double middle = 0.5 * (sky + ground);
      (hits_at(middle) ? ground : sky) = middle;
    }
    rows.push_back(sky);
  }
  return median_or(std::move(rows), fallback_px);
}

}  // namespace belvedere
