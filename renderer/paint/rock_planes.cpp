#include "renderer/paint/rock_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/random.h"
#include "base/random_streams.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

struct PlaneSize {
  double cell_units;  // mean distance of neighbouring planes
  float strength;
};
constexpr std::array<PlaneSize, 3> plane_sizes = {{{84.0, 0.50F}, {38.0, 0.56F}, {16.0, 0.38F}}};
constexpr float drawn_out = 0.62F;  // length along the fall line counts this much: planes are 1.6 times as long as wide
constexpr double warp_units = 2.2;  // how far edges waver
constexpr double warp_sigma_units = 5.0;

// The tilt of the plane that a place belongs to: the cell point that is nearest when lengths along `fall` count less.
float tilt_at(std::uint64_t seed, glm::dvec2 place, glm::vec2 fall) {
  const auto cell_x = static_cast<std::int64_t>(std::floor(place.x));
  const auto cell_y = static_cast<std::int64_t>(std::floor(place.y));
  float nearest = 1e9F;
  float tilt = 0.0F;
  for (std::int64_t y = cell_y - 1; y <= cell_y + 1; ++y)
    for (std::int64_t x = cell_x - 1; x <= cell_x + 1; ++x) {
      const std::uint64_t bits = random_bits(seed, x, y);
      const glm::dvec2 point(static_cast<double>(x) + static_cast<double>(bits & 0xffffU) / 65536.0,
                             static_cast<double>(y) + static_cast<double>((bits >> 16) & 0xffffU) / 65536.0);
      const glm::vec2 offset(place - point);
      const float along = glm::dot(offset, fall);
      const float across = offset.x * fall.y - offset.y * fall.x;
      const float distance = along * along * drawn_out * drawn_out + across * across;
      if (distance >= nearest) continue;
      nearest = distance;
      tilt = static_cast<float>((bits >> 32) & 0xffffU) / 32768.0F - 1.0F;
    }
  // Planes are light or dark rather than middling.
  return tilt * (1.5F - 0.5F * tilt * tilt);
}

}  // namespace

Grid<float> make_rock_planes(const GuidanceBuffers& guidance, const Grid<std::uint8_t>& marked, const PlaneParameters& parameters,
                             glm::ivec2 origin_px) {
  const int width = guidance.width();
  const int height = guidance.height();
  const double ppu = parameters.pixels_per_unit;
  const auto make_warp = [&](std::uint64_t axis) {
    const std::uint64_t seed = stream_seed(parameters.seed, Stream::rock_plane_edges, axis);
    return make_image_noise(seed, origin_px, width, height, ppu, warp_sigma_units, warp_sigma_units);
  };
  const Grid<float> warp_x = make_warp(0);
  const Grid<float> warp_y = make_warp(1);
  Grid<float> planes(width, height, 0.0F);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (marked(x, y) == 0) continue;
      glm::vec2 fall = guidance.fall_line(x, y);
      const float length = glm::length(fall);
      fall = length > 1e-3F ? fall / length : glm::vec2(0.0F, 1.0F);
      const glm::dvec2 place((origin_px.x + x + 0.5) / ppu + warp_units * warp_x(x, y),
                             (origin_px.y + y + 0.5) / ppu + warp_units * warp_y(x, y));
      float light = 0.0F;
      for (std::size_t k = 0; k < plane_sizes.size(); ++k)
        light += plane_sizes[k].strength *
                 tilt_at(stream_seed(parameters.seed, Stream::rock_plane_tilts, k), place / plane_sizes[k].cell_units, fall);
      planes(x, y) = parameters.sun_side < 0.0 ? -light : light;
    }
  });
  return planes;
}

}  // namespace belvedere
