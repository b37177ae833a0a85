#include "renderer/paint/sky.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

std::uint64_t deck_seed(const SkyParameters& parameters, std::uint64_t part) {
  return stream_seed(parameters.seed, Stream::front_decks, part);
}

}  // namespace

FrontDeck::FrontDeck(const SkyParameters& parameters, const SkyLook& look)
    : parameters_(parameters),
      look_(look),
      // It approaches from the side away from the light; otherwise the whole sky would be dark.
      side_(parameters.sun_image_x > 0.0 ? -1.0 : 1.0),
      edge_slope_(0.0),
      ragged_(deck_seed(parameters, 0), 1.0),
      torn_(deck_seed(parameters, 1), 1.0),
      folds_(deck_seed(parameters, 2), 1.0),
      fine_(deck_seed(parameters, 3), 1.0) {
  // Where the edge crosses the top of the picture: within its central half.
  const double across =
      0.5 + side_ * (0.05 - 0.30 * random_uniform(deck_seed(parameters, 4), 0, 0));
  const double x_px =
      (across - 0.12 * side_ * (parameters.clouds - 1.0)) * parameters.picture_size.x;
  edge_slope_ = (x_px - look.vanishing_px.x) / look.vanishing_px.y;
}

FrontDeck::Look FrontDeck::at(double x_px, double y_px) {
  const double elevation = 1.0 - y_px / parameters_.horizon_px;
  const double rise_px = look_.vanishing_px.y - y_px;
  if (elevation < 0.03 || rise_px <= 0.0) return {};
  const double along = exact::log(rise_px / cloud_scale_px(parameters_));
  const double ray = (x_px - look_.vanishing_px.x) / rise_px;
  const double beyond = side_ * (ray - edge_slope_);
  const float ragged =
      0.55F * ragged_(ray / 0.55, along / 0.16) + 0.30F * torn_(ray / 0.16, along / 0.07);
  const float density = static_cast<float>(beyond) * 1.1F + ragged;
  Look look;
  look.cover =
      smoothstep(-0.25F, 0.45F, density) * smoothstep(0.03F, 0.16F, static_cast<float>(elevation));
  // Rolls across its direction of movement, and threads along it; bright where it is thin.
  const float rolls =
      0.5F * folds_(ray / 1.3, along / 0.075) + 0.28F * fine_(ray / 0.22, along / 0.16);
  const float thin = 1.0F - smoothstep(0.10F, 1.25F, density);
  look.light = unit(0.30F + 0.24F * rolls + 0.62F * thin);
  return look;
}

namespace {

struct Layer {
  glm::vec3 colour{0.0F};
  float alpha = 0.0F;
};

// Colours that a low sun gives clouds and the sky above the horizon, encoded sRGB.
const glm::vec3 low_sun{1.00F, 0.79F, 0.55F};
const glm::vec3 horizon_glow{1.00F, 0.85F, 0.66F};

// A cloud in front of a low sun: warm and bright along its base and on the sun's side, cool and dim
// above.
glm::vec3 evening_colour(const Palette& palette, float lit, float raised) {
  const glm::vec3 warm = glm::mix(palette.cloud_light, low_sun, 0.75F);
  const glm::vec3 cool =
      glm::mix(palette.cloud_shade, palette.haze_near, 0.55F) * glm::vec3(0.96F, 0.90F, 0.97F);
  return glm::mix(cool, warm, unit(1.10F * (1.0F - raised) + 0.45F * (lit - 0.5F)));
}

// The glow of a low sun above the horizon, strongest on its side; 0…1.
float evening_glow(const SkyParameters& p, double x_px, double elevation) {
  const double sun_px = (0.5 + 0.5 * p.sun_image_x) * p.picture_size.x;
  const double aside = (x_px - sun_px) / p.picture_size.x;
  const auto near = static_cast<float>(1.0 / (1.0 + 5.0 * aside * aside));
  return 0.42F * near * (1.0F - smoothstep(-0.05F, 0.75F, static_cast<float>(elevation)));
}

// The cloud deck of a front, as a layer over the sky.
Layer deck_at(FrontDeck& deck, const Palette& palette, double x_px, double y_px) {
  const FrontDeck::Look look = deck.at(x_px, y_px);
  const glm::vec3 body = glm::mix(palette.cloud_shade, palette.haze_near, 0.5F) * 0.93F;
  return {glm::mix(body, palette.cloud_light, smoothstep(look.light)), 0.90F * look.cover};
}

// Colour of a cloud at a position: overlapping heads, each lit from above and from the sun's side.
Layer cloud_at(const Cloud& cloud, glm::vec2 position, glm::vec2 wobble, const Palette& palette,
               glm::vec2 towards_light) {
  Layer layer;
  const float height = cloud.base_px - cloud.from.y;
  for (const CloudHead& head : cloud.heads) {
    const glm::vec2 offset = (position - head.centre) / head.radius + wobble;
    const float distance = glm::length(offset);
    if (distance >= 1.25F) continue;
    const float cover = 1.0F - smoothstep(0.45F, 1.25F, distance);
    const float lit = std::clamp(0.52F + 0.55F * glm::dot(offset, towards_light), 0.0F, 1.0F);
    // The foot of the heap is in its own shade.
    const float raised = smoothstep(-0.05F, 0.75F, (cloud.base_px - position.y) / height);
    const float light = std::clamp(lit * 0.62F + raised * 0.62F - 0.12F, 0.0F, 1.0F);
    const glm::vec3 colour = cloud.underlit > 0.0F
                                 ? evening_colour(palette, lit, raised)
                                 : glm::mix(palette.cloud_shade, palette.cloud_light, light);
    layer.colour = layer.alpha + cover > 0.0F
                       ? glm::mix(layer.colour, colour, layer.alpha == 0.0F ? 1.0F : cover)
                       : colour;
    layer.alpha = layer.alpha + cover * (1.0F - layer.alpha);
  }
  // The flat base ends in a soft line.
  layer.alpha *=
      smoothstep(-0.10F, 0.12F, (cloud.base_px - position.y) / height - 0.02F * wobble.x) *
      cloud.opacity;
  return layer;
}

// Noise fields of the veils; use one set per thread.
struct VeilNoises {
  explicit VeilNoises(std::uint64_t seed)
      : streaks(stream_seed(seed, Stream::cloud_veils, 0), 1.0),
        threads(stream_seed(seed, Stream::cloud_veils, 1), 1.0),
        waver(stream_seed(seed, Stream::cloud_veils, 2), 1.0),
        patches(stream_seed(seed, Stream::cloud_veils, 3), 1.0) {}
  GroundNoise streaks, threads, waver, patches;
};

// A thin veil at a position: long level streaks in a few areas, narrower towards the horizon; 0…1.
float veil_at(const SkyParameters& p, const SkyLook& look, double x_px, double elevation,
              VeilNoises& noises) {
  if (elevation < 0.05) return 0.0F;
  const double x = x_px / cloud_scale_px(p);
  const double bend = 0.020 * noises.waver(x * 0.35, elevation * 3.0);
  const double rise =
      exact::log(0.12 + elevation + bend);  // a layer seen from below: equal steps get thinner
  const float broad = noises.streaks(x / 0.9, rise / 0.11);
  const float fine = noises.threads(x / 0.4, rise / 0.035);
  const float where = noises.patches(x / 1.5, rise / 0.40);
  const float density = 0.40F * broad + 0.18F * fine + 0.80F * where - 0.48F +
                        0.5F * static_cast<float>(p.clouds - 1.0);
  return 0.42F * static_cast<float>(look.veils) * smoothstep(0.0F, 1.5F, density) *
         smoothstep(0.05F, 0.30F, static_cast<float>(elevation));
}

// High streaks of ice that all start at the vanishing point, broken and bent; 0…1.
float streak_at(const SkyParameters& p, const SkyLook& look, double x_px, double y_px,
                VeilNoises& noises) {
  const double elevation = 1.0 - y_px / p.horizon_px;
  const double rise_px = look.vanishing_px.y - y_px;
  if (elevation < 0.04 || rise_px <= 0.0) return 0.0F;
  const double scale_px = cloud_scale_px(p);
  const double x = x_px / scale_px;
  const double along = exact::log(rise_px / scale_px);
  const double bent = 0.22 * static_cast<double>(noises.waver(x * 0.5, elevation * 2.2));
  const double ray = (x_px - look.vanishing_px.x) / rise_px + bent;
  // Rays crowd together far to the side: equal steps across are equal steps of their logarithm.
  const double across = std::copysign(exact::log(1.0 + std::abs(ray)), ray);
  const float broad = noises.streaks(across / 0.34, along / 0.75);
  const float fine = noises.threads(across / 0.085, along / 0.40);
  const float where = noises.patches(x / 1.1, along / 0.45);
  const float density = 0.50F * broad + 0.34F * fine + 0.70F * where - 0.30F +
                        0.5F * static_cast<float>(p.clouds - 1.0);
  return 0.60F * static_cast<float>(look.veils) * smoothstep(0.0F, 1.7F, density) *
         smoothstep(0.04F, 0.26F, static_cast<float>(elevation));
}

// Shape of cloud edges: two sizes of bulges, in shares of a head's radius.
struct EdgeNoises {
  EdgeNoises(std::uint64_t seed, int grain)
      : wobble_x(edge_seed(seed, grain, 0), std::ldexp(0.030, -grain)),
        wobble_y(edge_seed(seed, grain, 1), std::ldexp(0.030, -grain)),
        ripple_x(edge_seed(seed, grain, 2), std::ldexp(0.010, -grain)),
        ripple_y(edge_seed(seed, grain, 3), std::ldexp(0.010, -grain)) {}
  // Position in cloud scales.
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
  return values.empty() ? fallback : middle_value(std::move(values));
}

}  // namespace

glm::vec3 sky_gradient(const Palette& palette, double position) {
  const auto& stops = palette.sky;
  if (position <= stops.front().first) return stops.front().second;
  for (std::size_t i = 1; i < stops.size(); ++i)
    if (position < stops[i].first) {
      const auto share = static_cast<float>((position - stops[i - 1].first) /
                                            (stops[i].first - stops[i - 1].first));
      return glm::mix(stops[i - 1].second, stops[i].second, share);
    }
  return stops.back().second;
}

glm::vec3 air_beyond(const Palette& palette, double position) {
  const glm::vec3 sky = sky_gradient(palette, position);
  return glm::mix(sky, palette.haze_far,
                  0.6F * smoothstep(1.0F, 1.7F, static_cast<float>(position)));
}

Grid<glm::vec3> make_sky(const Grid<float>& depth_m, const Palette& palette, const SkyParameters& p,
                         glm::ivec2 origin_px) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  Grid<glm::vec3> sky(width, height, glm::vec3(0.0F));
  const std::vector<Cloud> clouds = make_clouds(p);
  const SkyLook look = look_of_sky(p);
  const bool streaky = look.kind == SkyKind::streaks || look.kind == SkyKind::front;
  const double scale_px = cloud_scale_px(p);
  const glm::vec2 towards_light =
      glm::normalize(glm::vec2(p.sun_image_x < 0.0 ? -0.55F : 0.55F, -0.85F));
  parallel_rows(height, [&](int y) {
    VeilNoises veil_noises(p.seed);
    GroundNoise bands(stream_seed(p.seed, Stream::sky_bands), 1.0);
    std::optional<FrontDeck> deck;
    if (look.kind == SkyKind::front && p.clouds > 0.0) deck.emplace(p, look);
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
      // Long soft bands make the gradient look less mechanical.
      const double position =
          v + 0.03 * bands(u * 0.9, v * 11.0) * std::clamp(2.0 * (1.0 - v), 0.0, 1.0);
      glm::vec3 colour = air_beyond(palette, position);
      if (look.kind == SkyKind::evening)
        colour = glm::mix(colour, horizon_glow, evening_glow(p, column_px, 1.0 - v));
      const float veil = p.clouds <= 0.0 ? 0.0F
                         : streaky       ? streak_at(p, look, column_px, row_px, veil_noises)
                                         : veil_at(p, look, column_px, 1.0 - v, veil_noises);
      colour = glm::mix(colour, palette.cloud_light, veil);
      if (deck) {
        const Layer layer = deck_at(*deck, palette, column_px, row_px);
        colour = glm::mix(colour, layer.colour, layer.alpha);
      }
      if (!near_row.empty()) {
        const glm::vec2 at(static_cast<float>(column_px), static_cast<float>(row_px));
        for (const Cloud* cloud : near_row) {
          if (at.x < cloud->from.x || at.x > cloud->to.x) continue;
          const glm::vec2 wobble = edges[static_cast<std::size_t>(cloud->grain)].at(u, w);
          const Layer layer = cloud_at(*cloud, at, wobble, palette, towards_light);
          // Low clouds are far away, in the air of the horizon.
          const float air = 0.45F * smoothstep(0.55F, 1.0F, static_cast<float>(v));
          colour = glm::mix(colour, glm::mix(layer.colour, sky_gradient(palette, 1.0), air),
                            0.88F * layer.alpha);
        }
      }
      sky(x, y) = glm::clamp(colour, 0.0F, 1.0F);
    }
  });
  return sky;
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
      const double centre = 0.5 * (sky + ground);
      (hits_at(centre) ? ground : sky) = centre;
    }
    rows.push_back(sky);
  }
  return median_or(std::move(rows), fallback_px);
}

}  // namespace belvedere
