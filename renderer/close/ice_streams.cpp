#include "renderer/close/ice_streams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

// Lengths in units of the sheet.
constexpr double flow_sigma = 20.0;  // of the slope that ice follows: not every hump
constexpr double band_sigma = 10.0;  // of bands across …
constexpr double low_sigma = 4.2;    // … and up and down the sheet, where ice is foreshortened
constexpr float step_units = 6.0F;
constexpr int steps = 11;     // to each side
constexpr float gain = 2.2F;  // a mean along the flow deviates less than its noise

bool flows(LandCoverClass id) {
  return id == LandCoverClass::glacier || id == LandCoverClass::snow;
}

// The way that ice takes on the sheet, not normalized.
std::array<Grid<float>, 2> smooth_flow(const SpurGround& ground, PixelRect region) {
  const WideView& wide = ground.wide;
  std::array<Grid<float>, 2> flow;
  for (int k = 0; k < 2; ++k) {
    Grid<float> part(wide.seen.width(), wide.seen.height(), 0.0F);
    for (std::size_t i = 0; i < part.size(); ++i) {
      const glm::vec3 n = wide.seen.normal[i];
      // Steep ground leads; the sides of a valley cancel each other.
      if (!wide.seen.is_sky(i))
        part[i] = wide.seen.fall_line[i][k] * std::sqrt(std::sqrt(n.x * n.x + n.y * n.y));
    }
    flow[static_cast<std::size_t>(k)] = blur_on_surface(
        part, wide.seen.depth_m, flow_sigma * ground.pixels_per_unit / wide.factor, region);
  }
  return flow;
}

int walk_px(double wide_pixels_per_unit) {
  return static_cast<int>(
             std::ceil(static_cast<double>(step_units) * steps * wide_pixels_per_unit)) +
         1;
}

}  // namespace

Grid<float> ice_streams(const SpurGround& ground, PixelRect wanted) {
  const WideView& wide = ground.wide;
  const double scale = ground.pixels_per_unit / wide.factor;  // wide pixels in a unit
  const PixelRect held{0, 0, wide.seen.width(), wide.seen.height()};
  const PixelRect region = intersection(held, grown(wanted, walk_px(scale)));
  const std::array<Grid<float>, 2> flow = smooth_flow(ground, region);
  Grid<float> bands(wide.seen.width(), wide.seen.height(), 0.0F);
  const Grid<float> noise =
      make_image_noise(stream_seed(ground.seed, Stream::close_calm, 21),
                       wide.origin_px + glm::ivec2(region.x0, region.y0), region.width(),
                       region.height(), scale, band_sigma, low_sigma);
  const auto step_px = static_cast<float>(static_cast<double>(step_units) * scale);
  parallel_rows(wanted.height(), [&](int row) {
    const int y = wanted.y0 + row;
    for (int x = wanted.x0; x < wanted.x1; ++x) {
      const std::size_t own = wide.seen.depth_m.index(x, y);
      if (wide.seen.is_sky(own) || !flows(wide.seen.land_cover[own])) continue;
      float sum = 0.0F;
      float weights = 0.0F;
      for (const float side : {-1.0F, 1.0F}) {
        glm::vec2 at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
        float depth_m = wide.seen.depth_m[own];
        for (int k = 0; k <= steps; ++k) {
          const glm::ivec2 pixel(static_cast<int>(std::floor(at.x)),
                                 static_cast<int>(std::floor(at.y)));
          if (pixel.x < region.x0 || pixel.y < region.y0 || pixel.x >= region.x1 ||
              pixel.y >= region.y1)
            break;
          const std::size_t i = wide.seen.depth_m.index(pixel.x, pixel.y);
          if (wide.seen.is_sky(i) || !same_surface(wide.seen.depth_m[i], depth_m)) break;
          depth_m = wide.seen.depth_m[i];
          const float weight = 1.0F - static_cast<float>(k) / static_cast<float>(steps + 1);
          if (k > 0 || side < 0.0F) {
            sum += weight * noise(pixel.x - region.x0, pixel.y - region.y0);
            weights += weight;
          }
          const glm::vec2 way(flow[0][i], flow[1][i]);
          const float length = std::sqrt(glm::dot(way, way));
          if (!(length > 1e-4F)) break;
          at += way * (side * step_px / length);
        }
      }
      const float band = std::clamp(gain * sum / std::max(weights, 1.0F), -2.0F, 2.0F);
      // Bands have edges.
      bands(x, y) = band / std::sqrt(0.35F + band * band);
    }
  });
  return bands;
}

int ice_streams_reach(double pixels_per_unit, int factor) {
  const double scale = pixels_per_unit / factor;
  return walk_px(scale) + surface_reach_px(flow_sigma * scale);
}

}  // namespace belvedere
