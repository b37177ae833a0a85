#include "renderer/trace/guidance_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr double golden_turn = 2.0 * std::numbers::pi * 0.6180339887498949;
constexpr float same_surface = 0.03F;  // depths closer than this are one surface

// Rays gathered from pixels, traced together; answers are returned to (pixel, direction).
class RayBatch {
 public:
  void clear() {
    rays_.clear();
    owners_.clear();
  }
  void add(int pixel, glm::dvec3 start, glm::dvec3 direction) {
    rays_.push_back({start, direction});
    owners_.push_back(pixel);
  }
  // f(pixel, blocked) for each ray.
  template <class F>
  void trace(const Tracer& tracer, double reach_m, F&& f) {
    blocked_.resize(rays_.size());
    tracer.occluded(rays_, reach_m, blocked_);
    for (std::size_t i = 0; i < rays_.size(); ++i) f(owners_[i], blocked_[i] != 0);
  }

 private:
  std::vector<Ray> rays_;
  std::vector<int> owners_;
  std::vector<std::uint8_t> blocked_;
};

// The direction to the sun and the axes of its disc.
struct SunFrame {
  glm::dvec3 sun{0.0, 0.0, 1.0}, side{1.0, 0.0, 0.0}, above{0.0, 1.0, 0.0};

  SunFrame() = default;
  explicit SunFrame(glm::dvec3 direction)
      : sun(glm::normalize(direction)),
        side(glm::normalize(
            glm::cross(sun, std::abs(sun.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)))),
        above(glm::cross(side, sun)) {}
};

// One per thread, so that tracing allocates nothing.
RayBatch& thread_batch() {
  thread_local RayBatch batch;
  batch.clear();
  return batch;
}

}  // namespace

std::vector<glm::dvec2> pixel_sample_positions(int n) {
  const int side = static_cast<int>(std::lround(std::sqrt(n)));
  std::vector<glm::dvec2> positions;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      positions.emplace_back((i + (j + 0.5) / side) / side,
                             (j + (side - 1 - i + 0.5) / side) / side);
    }
  }
  return positions;
}

std::vector<glm::dvec2> disc_positions(int count) {
  std::vector<glm::dvec2> positions;
  for (int k = 0; k < count; ++k) {
    // A single ray goes to the disc's centre: a hard shadow.
    const double radius = count == 1 ? 0.0 : std::sqrt((k + 0.5) / count);
    positions.emplace_back(radius * exact::cos(golden_turn * k),
                           radius * exact::sin(golden_turn * k));
  }
  return positions;
}

std::vector<SkyDirection> sky_directions(int per_pixel) {
  // Vogel's spiral: equal steps in the squared sine of the angle from the zenith, turned by the
  // golden ratio. Each run of 16 along it is distributed over the 16 lanes in Bayer's order, so
  // that neighbours differ most; the offset of 7 from run to run, almost a quarter turn, spreads
  // the directions of one lane as well.
  constexpr std::array<int, 16> bayer = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
  std::vector<SkyDirection> all;
  for (int lane = 0; lane < 16; ++lane) {
    for (int run = 0; run < per_pixel; ++run) {
      const int n = 16 * run + (bayer[static_cast<std::size_t>(lane)] + 7 * run) % 16;
      const double u = (n + 0.5) / (16.0 * per_pixel);
      const double turn = golden_turn * n;
      all.push_back(
          {{exact::cos(turn) * std::sqrt(u), exact::sin(turn) * std::sqrt(u), std::sqrt(1.0 - u)},
           lane});
    }
  }
  // Neighbours in azimuth are traced together: rays of one packet should have similar directions.
  std::stable_sort(all.begin(), all.end(), [](const SkyDirection& a, const SkyDirection& b) {
    return exact::atan2(a.direction.y, a.direction.x) < exact::atan2(b.direction.y, b.direction.x);
  });
  return all;
}

BlockValues trace_sun(const Tracer& tracer, const BlockSurface& block,
                      std::span<const glm::dvec2> positions, std::span<const glm::dvec3> suns,
                      double sun_radius_rad) {
  BlockValues lit{};
  const int count = static_cast<int>(positions.size());
  std::array<SunFrame, trace_block_pixels> frames;
  for (std::size_t i = 0; i < suns.size(); ++i) frames[i] = SunFrame(suns[i]);
  const double spread = exact::tan(sun_radius_rad);
  std::array<glm::dvec2, trace_block_pixels> turn;
  const std::uint64_t turns =
      stream_seed(0, Stream::sun_rays);  // shadows do not depend on the seed of strokes
  for (int i = 0; i < trace_block_pixels; ++i) {
    const glm::ivec2 at = block.corner + block_pixel(i);
    const exact::Turn by = exact::turn(2.0 * std::numbers::pi * random_uniform(turns, at.x, at.y));
    turn[static_cast<std::size_t>(i)] = {by.cosine, by.sine};
  }
  const auto towards = [&](int pixel, int k) {
    const glm::dvec2 t = turn[static_cast<std::size_t>(pixel)];
    const glm::dvec2 p = positions[static_cast<std::size_t>(k)];
    const SunFrame& f = frames[suns.size() == 1 ? 0 : static_cast<std::size_t>(pixel)];
    return glm::normalize(f.sun + f.side * (spread * (p.x * t.x - p.y * t.y)) +
                          f.above * (spread * (p.x * t.y + p.y * t.x)));
  };
  RayBatch& batch = thread_batch();
  // The outermost two positions first. If all 32 rays of a bundle agree there is no penumbra, and
  // the other positions are skipped.
  constexpr int probes = 2;
  for (int bundle = 0; bundle < trace_block_pixels / 16; ++bundle) {
    std::array<int, 16> free{};
    int asked = 0;
    int open = 0;
    const auto trace = [&](int from, int to) {
      batch.clear();
      for (int k = from; k < to; ++k) {
        for (int lane = 0; lane < 16; ++lane) {
          const int i = bundle * 16 + lane;
          const BlockSurface::Pixel& pixel = block.pixels[static_cast<std::size_t>(i)];
          if (!pixel.terrain) continue;
          const glm::dvec3 direction = towards(i, k);
          if (glm::dot(direction, pixel.facet_normal) > 0.0)
            batch.add(lane, pixel.start, direction);
        }
      }
      batch.trace(tracer, 1e9, [&](int lane, bool blocked) {
        ++asked;
        if (blocked) return;
        ++open;
        ++free[static_cast<std::size_t>(lane)];
      });
    };
    const int rest = std::max(count - probes, 0);
    trace(rest, count);
    if (rest > 0) {
      if (asked > 0 && open == asked) {
        for (int lane = 0; lane < 16; ++lane) {
          const int i = bundle * 16 + lane;
          const BlockSurface::Pixel& pixel = block.pixels[static_cast<std::size_t>(i)];
          if (!pixel.terrain) continue;
          for (int k = 0; k < rest; ++k) {
            if (glm::dot(towards(i, k), pixel.facet_normal) > 0.0)
              ++free[static_cast<std::size_t>(lane)];
          }
        }
      } else if (open > 0 || asked == 0) {
        trace(0, rest);
      }
    }
    for (int lane = 0; lane < 16; ++lane) {
      const int i = bundle * 16 + lane;
      lit[static_cast<std::size_t>(i)] =
          static_cast<float>(free[static_cast<std::size_t>(lane)]) / static_cast<float>(count);
    }
  }
  return lit;
}

BlockValues trace_sky(const Tracer& tracer, const BlockSurface& block,
                      std::span<const SkyDirection> directions, double reach_m) {
  BlockValues sky{};
  if (directions.empty()) {
    sky.fill(1.F);
    return sky;
  }
  RayBatch& batch = thread_batch();
  for (const SkyDirection& sky_direction : directions) {
    for (int bundle = 0; bundle < trace_block_pixels / 16; ++bundle) {
      const int i = bundle * 16 + sky_direction.lane;
      const BlockSurface::Pixel& pixel = block.pixels[static_cast<std::size_t>(i)];
      if (pixel.terrain && glm::dot(sky_direction.direction, pixel.facet_normal) > 0.0)
        batch.add(i, pixel.start, sky_direction.direction);
    }
  }
  const float share = 16.F / static_cast<float>(directions.size());
  batch.trace(tracer, reach_m, [&](int i, bool blocked) {
    sky[static_cast<std::size_t>(i)] += blocked ? 0.F : share;
  });
  return sky;
}

Grid<float> mean_of_squares(const Grid<float>& values, const Grid<float>& depth_m) {
  Grid<float> mean(values.width(), values.height());
  constexpr std::array<float, 5> weight = {0.5F, 1.F, 1.F, 1.F, 0.5F};
  parallel_rows(values.height(), [&](int y) {
    for (int x = 0; x < values.width(); ++x) {
      const float depth = depth_m(x, y);
      float sum = 0.F;
      float total = 0.F;
      for (int j = -2; j <= 2; ++j) {
        for (int i = -2; i <= 2; ++i) {
          // Written so that sky (infinite depth) belongs to no surface and stays unchanged.
          if (!values.contains(x + i, y + j) ||
              !(std::abs(depth_m(x + i, y + j) - depth) <= same_surface * depth))
            continue;
          const float w = weight[i + 2] * weight[j + 2];
          sum += w * values(x + i, y + j);
          total += w;
        }
      }
      mean(x, y) = total > 0.F ? sum / total : values(x, y);
    }
  });
  return mean;
}

}  // namespace belvedere
