#include "renderer/paint/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/noise.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

// What clouds are measured in: the height of the sky, but no more than a narrow picture can carry.
double cloud_scale_px(const SkyParameters& p) { return std::min(p.horizon_px, 0.09 * p.picture_size.x); }

// Random numbers in the order they are drawn, a pure function of seed and cell. One draw a statement: C++ leaves open which of two
// arguments comes first.
class Draws {
 public:
  Draws(std::uint64_t seed, std::int64_t cell) : seed_(seed), cell_(cell) {}
  double uniform() { return random_uniform(seed_, cell_, draw_++, 1); }
  double between(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::uint64_t seed_;
  std::int64_t cell_;
  std::int64_t draw_ = 0;
};

// The outline of a heap: arches of different height and width beside each other; u is -1…1 over the width, the value 0…1.
struct Outline {
  struct Arch {
    double middle, half_width, height;
  };
  std::vector<Arch> arches;

  double operator()(double u) const {
    double top = 0.0;
    for (const Arch& a : arches) {
      const double side = (u - a.middle) / a.half_width;
      top = std::max(top, a.height * std::sqrt(std::max(0.0, 1.0 - side * side)));
    }
    return top;
  }
};

Outline make_outline(Draws& draws) {
  Outline outline;
  const double main_middle = draws.between(-0.45, 0.45);
  const double main_half_width = draws.between(0.35, 0.75);
  outline.arches.push_back({main_middle, main_half_width, 1.0});
  const int more = static_cast<int>(draws.between(1.0, 4.0));
  for (int k = 0; k < more; ++k) {
    const double middle = draws.between(-0.8, 0.8);
    const double half_width = draws.between(0.15, 0.5);
    outline.arches.push_back({middle, half_width, draws.between(0.2, 0.75)});
  }
  outline.arches.push_back({0.0, 1.0, draws.between(0.12, 0.3)});  // what joins them
  return outline;
}

// One cloud. `heaped`: 0 a bank drawn out by the wind … 1 a cumulus.
Cloud make_cloud(const SkyParameters& p, Draws& draws, glm::dvec2 middle_px, double width_px, double heaped, double opacity) {
  const double height_px = width_px * (0.05 + (0.10 + 0.20 * heaped) * draws.between(0.6, 1.2));
  const Outline outline = make_outline(draws);
  const int count = 14 + static_cast<int>(12.0 * draws.uniform());
  const double base_px = middle_px.y;
  Cloud cloud{static_cast<float>(base_px), {}, {}, static_cast<float>(opacity), 0, {}};
  const auto add = [&](double u, double rise, glm::dvec2 radius) {
    cloud.heads.push_back({glm::vec2(glm::dvec2(middle_px.x + 0.5 * width_px * u, base_px - rise)), glm::vec2(radius)});
  };
  for (int k = 0; k < count; ++k) {
    const double u = -1.0 + 2.0 * (k + draws.uniform()) / count;
    const double arch = outline(u);
    const double radius = height_px * (0.10 + 0.30 * arch) * draws.between(0.7, 1.3);
    const double stretch = (3.2 - 1.9 * heaped) * draws.between(0.8, 1.3);
    add(u, std::max(0.0, arch * height_px - radius) * draws.between(0.2, 1.0), {radius * stretch, radius});
  }
  // Skirts, drawn out level beyond the heap.
  const int skirts = 2 + static_cast<int>(3.0 * draws.uniform());
  for (int k = 0; k < skirts; ++k) {
    const double u = draws.between(-1.1, 1.1);
    const double length = width_px * draws.between(0.12, 0.34) * (1.3 - 0.6 * heaped);
    const double thickness = length * draws.between(0.05, 0.10);
    const double rise = height_px * draws.between(0.02, 0.22);
    add(u, rise, {length, thickness});
  }
  std::stable_sort(cloud.heads.begin(), cloud.heads.end(), [](const CloudHead& a, const CloudHead& b) { return a.centre.y < b.centre.y; });
  cloud.from = glm::vec2(1e9F);
  cloud.to = glm::vec2(-1e9F);
  for (const CloudHead& head : cloud.heads) {
    cloud.from = glm::min(cloud.from, head.centre - 1.6F * head.radius);
    cloud.to = glm::max(cloud.to, head.centre + 1.6F * head.radius);
  }
  cloud.to.y = static_cast<float>(base_px + 0.35 * height_px);
  const double size = width_px / cloud_scale_px(p);
  cloud.grain = size > 1.0 ? 0 : size > 0.5 ? 1 : size > 0.25 ? 2 : 3;
  return cloud;
}

// How large a cloud is drawn whose base stands so high above the horizon (in heights of the sky): the lower, the farther. Cloud scales.
double size_at(double elevation) { return 0.22 + 1.9 * elevation; }

// A bank: clouds of one kind along a level line, large in the middle, farther and smaller to both sides.
void add_bank(std::vector<Cloud>& clouds, const SkyParameters& p, Draws& draws, double middle_px, double elevation) {
  const double scale_px = cloud_scale_px(p);
  const double heaped = draws.between(-0.15, 1.0);
  const double half_px = scale_px * size_at(elevation) * draws.between(0.6, 1.9);
  const int count = 3 + static_cast<int>(5.0 * draws.uniform());
  const double lead = draws.between(-0.6, 0.6);  // where in the bank its largest cloud stands
  for (int k = 0; k < count; ++k) {
    const double t = -1.0 + 2.0 * (k + draws.uniform()) / count;
    const double aside = std::min(1.0, std::abs(t - lead));
    const double height = elevation * (1.0 - 0.35 * aside) * draws.between(0.9, 1.1);
    const double width_px = scale_px * size_at(height) * (1.0 - 0.62 * aside) * draws.between(0.55, 1.25);
    const double kind = std::clamp(heaped + draws.between(-0.25, 0.25) - 0.3 * aside, 0.0, 1.0);
    const double opacity = (0.55 + 0.45 * std::min(1.0, height / 0.2)) * (0.62 + 0.38 * kind) * (1.0 - 0.35 * aside);
    clouds.push_back(make_cloud(p, draws, {middle_px + half_px * t, p.horizon_px * (1.0 - height)}, width_px, kind, opacity));
  }
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
    const float cover = 1.0F - smoothstep(0.45F, 1.25F, distance);
    const float lit = std::clamp(0.52F + 0.55F * glm::dot(offset, towards_light), 0.0F, 1.0F);
    // The foot of the heap lies in its own shade.
    const float raised = smoothstep(-0.05F, 0.75F, (cloud.base_px - place.y) / height);
    const float light = std::clamp(lit * 0.62F + raised * 0.62F - 0.12F, 0.0F, 1.0F);
    const glm::vec3 colour = glm::mix(palette.cloud_shade, palette.cloud_light, light);
    layer.colour = layer.alpha + cover > 0.0F ? glm::mix(layer.colour, colour, layer.alpha == 0.0F ? 1.0F : cover) : colour;
    layer.alpha = layer.alpha + cover * (1.0F - layer.alpha);
  }
  // The flat base: it ends in a soft line.
  layer.alpha *= smoothstep(-0.10F, 0.12F, (cloud.base_px - place.y) / height - 0.02F * wobble.x) * cloud.opacity;
  return layer;
}

// Fields of noise that veils are made of; one set a thread.
struct VeilNoises {
  explicit VeilNoises(std::uint64_t seed)
      : streaks(stream_seed(seed, Stream::cloud_veils, 0), 1.0),
        threads(stream_seed(seed, Stream::cloud_veils, 1), 1.0),
        waver(stream_seed(seed, Stream::cloud_veils, 2), 1.0),
        patches(stream_seed(seed, Stream::cloud_veils, 3), 1.0) {}
  GroundNoise streaks, threads, waver, patches;
};

// A thin veil at a place: long level streaks in a few places, ever narrower towards the horizon; 0…1.
float veil_at(const SkyParameters& p, double x_px, double elevation, VeilNoises& noises) {
  if (elevation < 0.05) return 0.0F;
  const double x = x_px / cloud_scale_px(p);
  const double bend = 0.020 * noises.waver(x * 0.35, elevation * 3.0);
  const double rise = exact::log(0.12 + elevation + bend);  // a layer seen from below: equal steps are ever thinner
  const float broad = noises.streaks(x / 0.9, rise / 0.11);
  const float fine = noises.threads(x / 0.4, rise / 0.035);
  const float where = noises.patches(x / 1.5, rise / 0.40);
  const float density = 0.40F * broad + 0.18F * fine + 0.80F * where - 0.48F + 0.5F * static_cast<float>(p.clouds - 1.0);
  return 0.42F * smoothstep(0.0F, 1.5F, density) * smoothstep(0.05F, 0.30F, static_cast<float>(elevation));
}

// How the edges of clouds billow: two sizes of bulges, in shares of a head's radius.
struct EdgeNoises {
  EdgeNoises(std::uint64_t seed, int grain)
      : wobble_x(edge_seed(seed, grain, 0), std::ldexp(0.030, -grain)),
        wobble_y(edge_seed(seed, grain, 1), std::ldexp(0.030, -grain)),
        ripple_x(edge_seed(seed, grain, 2), std::ldexp(0.010, -grain)),
        ripple_y(edge_seed(seed, grain, 3), std::ldexp(0.010, -grain)) {}
  // Place in cloud scales.
  glm::vec2 at(double u, double w) {
    const glm::vec2 wobble(wobble_x(u, w), wobble_y(u, w));
    const glm::vec2 ripple(ripple_x(u, w), ripple_y(u, w));
    return 0.16F * wobble + 0.07F * ripple;
  }
  static std::uint64_t edge_seed(std::uint64_t seed, int grain, int field) {
    return stream_seed(seed, Stream::cloud_edges, static_cast<std::uint64_t>(4 * grain + field));
  }
  GroundNoise wobble_x, wobble_y, ripple_x, ripple_y;
};

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

glm::vec3 air_beyond(const Palette& palette, double place) {
  const glm::vec3 sky = sky_gradient(palette, place);
  return glm::mix(sky, palette.haze_far, 0.6F * smoothstep(1.0F, 1.7F, static_cast<float>(place)));
}

std::vector<Cloud> make_clouds(const SkyParameters& p) {
  std::vector<Cloud> clouds;
  if (p.clouds <= 0.0) return clouds;
  const double scale_px = cloud_scale_px(p);
  // Few banks high up, more and smaller ones towards the horizon. Each stretch of the sky has a bank or none.
  struct Band {
    double lowest, highest;  // of bases above the horizon, heights of the sky
    double stretch;          // cloud scales
    double share;            // of stretches with a bank
  };
  constexpr std::array<Band, 3> bands = {{{0.05, 0.12, 1.3, 0.72}, {0.14, 0.30, 2.6, 0.70}, {0.32, 0.62, 4.2, 0.78}}};
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const Band& band = bands[b];
    const double cell_px = band.stretch * scale_px;
    // Where stretches begin differs by seed, or every sky would have its gaps in the same places.
    const std::uint64_t seed = stream_seed(p.seed, Stream::cloud_banks, b);
    const double shift = random_uniform(seed, -9, 0);
    const auto last = static_cast<std::int64_t>(p.picture_size.x / cell_px) + 2;
    for (std::int64_t cell = -2; cell <= last; ++cell) {
      Draws draws(seed, cell);
      if (draws.uniform() > band.share + 0.4 * (p.clouds - 1.0)) continue;
      const double middle_px = (static_cast<double>(cell) + shift + draws.between(0.1, 0.9)) * cell_px;
      add_bank(clouds, p, draws, middle_px, draws.between(band.lowest, band.highest));
    }
  }
  std::stable_sort(clouds.begin(), clouds.end(), [](const Cloud& a, const Cloud& b) { return a.base_px > b.base_px; });
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
    VeilNoises veil_noises(p.seed);
    GroundNoise bands(stream_seed(p.seed, Stream::sky_bands), 1.0);
    std::vector<EdgeNoises> edges;
    for (int grain = 0; grain < 4; ++grain) edges.emplace_back(p.seed, grain);
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
      glm::vec3 colour = air_beyond(palette, place);
      const float veil = p.clouds > 0.0 ? veil_at(p, column_px, 1.0 - v, veil_noises) : 0.0F;
      colour = glm::mix(colour, palette.cloud_light, veil);
      if (!near_row.empty()) {
        const glm::vec2 at(static_cast<float>(column_px), static_cast<float>(row_px));
        for (const Cloud* cloud : near_row) {
          if (at.x < cloud->from.x || at.x > cloud->to.x) continue;
          const glm::vec2 wobble = edges[static_cast<std::size_t>(cloud->grain)].at(u, w);
          const Layer layer = cloud_at(*cloud, at, wobble, palette, towards_light);
          // Low clouds stand far away, in the air of the horizon.
          const float air = 0.45F * smoothstep(0.55F, 1.0F, static_cast<float>(v));
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
