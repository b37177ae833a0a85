#include "renderer/mist/mist_bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr double cell_m = 120.0;  // of the wide cells, approximately
constexpr double floor_reach_m =
    700.0;  // a floor is the lowest ground within this distance, continued under the slopes …
constexpr double floor_sigma_m = 450.0;    // … and smoothed
constexpr double around_sigma_m = 5000.0;  // surroundings that a floor lies below
constexpr double broad_m = 2600.0;         // deviation of the noise that forms banks …
constexpr double narrow_m = 700.0;         // … and that frays them
constexpr double sea_hollow_m = 170.0;     // how far the surface of a torn sea sinks
constexpr std::uint64_t narrow_part = 1;

// Blocks of `times` cells in each direction: their lowest value, or their mean.
template <class Join>
Grid<float> join_blocks(const Grid<float>& values, int times, float begin, Join&& join, bool mean) {
  Grid<float> out((values.width() + times - 1) / times, (values.height() + times - 1) / times);
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      float sum = begin;
      int count = 0;
      for (int v = y * times; v < std::min(values.height(), (y + 1) * times); ++v)
        for (int u = x * times; u < std::min(values.width(), (x + 1) * times); ++u, ++count)
          sum = join(sum, values(u, v));
      out(x, y) = mean ? sum / static_cast<float>(count) : sum;
    }
  });
  return out;
}
Grid<float> lowest_of(const Grid<float>& values, int times) {
  return join_blocks(
      values, times, std::numeric_limits<float>::max(),
      [](float a, float b) { return std::min(a, b); }, false);
}
Grid<float> mean_of(const Grid<float>& values, int times) {
  return join_blocks(
      values, times, 0.0F, [](float a, float b) { return a + b; }, true);
}

double value_at(const Grid<float>& grid, const GeoTransform& transform, glm::dvec2 position) {
  const glm::dvec2 cell = transform.to_cell(position.x, position.y);
  return sample_bilinear(grid, std::clamp(cell.x, 0.0, grid.width() - 1.0),
                         std::clamp(cell.y, 0.0, grid.height() - 1.0));
}

// 0…1: flat, and lower than the surroundings.
Grid<float> find_level(const Grid<float>& floor_m, const Grid<float>& around_m, double wide_m) {
  Grid<float> level(floor_m.width(), floor_m.height());
  parallel_rows(level.height(), [&](int y) {
    for (int x = 0; x < level.width(); ++x) {
      const float east = floor_m.clamped(x + 1, y) - floor_m.clamped(x - 1, y);
      const float south = floor_m.clamped(x, y + 1) - floor_m.clamped(x, y - 1);
      const float rise = std::sqrt(east * east + south * south) / static_cast<float>(2.0 * wide_m);
      const float below = around_m(x, y) - floor_m(x, y);
      level(x, y) = (1.0F - smoothstep(0.05F, 0.17F, rise)) * smoothstep(-60.0F, 140.0F, below);
    }
  });
  return level;
}

}  // namespace

double MistGround::floor_at(glm::dvec2 position) const {
  return value_at(floor_m, transform, position);
}
double MistGround::level_at(glm::dvec2 position) const {
  return value_at(level, transform, position);
}
double MistGround::rim_at(glm::dvec2 position) const {
  return value_at(rim_m, transform, position);
}

MistGround make_mist_ground(const Grid<float>& altitude_m, const Grid<float>& rim_m,
                            const GeoTransform& transform, bool floors) {
  const int times = std::max(1, static_cast<int>(std::lround(cell_m / transform.cell_x)));
  MistGround ground;
  ground.transform = {transform.origin_x, transform.origin_y, transform.cell_x * times,
                      transform.cell_y * times};
  ground.rim_m = mean_of(rim_m, times);
  if (!floors) return ground;
  const double wide_m = ground.transform.cell_x;
  const Grid<float> lowest = lowest_of(altitude_m, times);
  ground.floor_m = gaussian_blur(
      window_minimum(lowest, std::max(1, static_cast<int>(std::lround(floor_reach_m / wide_m)))),
      floor_sigma_m / wide_m);
  ground.level = find_level(
      ground.floor_m, gaussian_blur(mean_of(altitude_m, times), around_sigma_m / wide_m), wide_m);
  return ground;
}

MistBed::MistBed(const MistParameters& parameters, const MistGround& ground, double rim_fade_m,
                 std::uint64_t seed)
    : parameters_(parameters),
      ground_(ground),
      rim_fade_m_(rim_fade_m),
      highest_m_(parameters.to_m),
      broad_(stream_seed(seed, Stream::mist_patches), broad_m),
      narrow_(stream_seed(seed, Stream::mist_patches, narrow_part), narrow_m) {
  if (parameters.kind != MistKind::valley) return;
  highest_m_ = -std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < ground.floor_m.size(); ++i)
    if (ground.level[i] > 0.0F)
      highest_m_ =
          std::max(highest_m_, static_cast<double>(ground.floor_m[i]) + parameters.height_m);
}

MistBed::Column MistBed::at(glm::dvec2 position) {
  const MistParameters& p = parameters_;
  Column column{p.to_m, 1.0};
  if (rim_fade_m_ > 0.0) column.cover *= smoothstep(0.0, rim_fade_m_, ground_.rim_at(position));
  if (p.position && p.radius_m > 0.0) {
    const glm::dvec2 from = position - *p.position;
    column.cover *= 1.0 - smoothstep(0.75 * p.radius_m, p.radius_m,
                                     std::sqrt(from.x * from.x + from.y * from.y));
  }
  if (column.cover <= 0.0 && p.kind == MistKind::sea) return column;
  // Above 0 in banks, below in gaps.
  const double bank = p.patches > 0.0
                          ? 0.8 * broad_(position.x, position.y) +
                                0.45 * narrow_(position.x, position.y) + 1.9 - 3.0 * p.patches
                          : 1.0;
  if (p.kind == MistKind::sea) {
    column.top_m -= sea_hollow_m * p.patches * std::max(0.0, 1.0 - bank);
    column.cover *= smoothstep(-0.7, 0.5, bank);
    return column;
  }
  const double full = smoothstep(-0.5, 0.9, bank);
  column.top_m = ground_.floor_at(position) + p.height_m * (0.25 + 0.75 * full);
  column.cover *= ground_.level_at(position) * full;
  return column;
}

namespace {

constexpr int puff_count = 64;
constexpr double flatness = 0.7;    // height of a puff relative to its width
constexpr double puff_reach = 1.6;  // in radii: a puff has no effect beyond this, whatever its edge
constexpr double broad_edges =
    0.030;  // deviations of the edge noises, in shares of the cloud's length
constexpr double narrow_edges = 0.010;

// Random numbers of one puff in the order of the draws.
class Draws {
 public:
  Draws(std::uint64_t seed, int puff) : seed_(stream_seed(seed, Stream::lee_clouds)), puff_(puff) {}
  double uniform() { return random_uniform(seed_, puff_, 0, draw_++); }
  double between(double low, double high) { return low + (high - low) * uniform(); }

 private:
  std::uint64_t seed_;
  int puff_;
  std::uint64_t draw_ = 0;
};

// Position of a puff: along the wind from the summit, across it, above it, and its size, in shares
// of the cloud's length.
struct PuffPlan {
  double along, across, above, radius, opacity;
};

// The cloud begins at the summit's lee side, widens and is torn into shreds at its end.
PuffPlan plan_puff(std::uint64_t seed, int k) {
  Draws draws(seed, k);
  const double jitter = draws.uniform();
  const double s = (k + jitter) / puff_count;
  const double swell = 0.045 + 0.115 * std::sqrt(s) * (1.0 - 0.55 * s);
  const double radius = swell * draws.between(0.55, 1.25) * (1.0 - 0.35 * s * s);
  const double across = 0.8 * swell * draws.between(-1.0, 1.0);
  const double lift = draws.between(-0.55, 0.75);
  const double thin = draws.between(0.7, 1.0);
  return {-0.03 + s, across, 0.01 + 0.075 * s + 0.75 * swell * lift, radius,
          thin * (1.0 - 0.8 * s * s)};
}

}  // namespace

std::optional<LeeCloud> make_lee_cloud(const MistParameters& parameters, double ground_m,
                                       const Deformation& deformation, const Camera& camera,
                                       std::uint64_t seed) {
  const glm::dvec2 summit = parameters.position.value_or(glm::dvec2(0.0));
  const exact::Turn from = exact::turn(to_radians(parameters.wind_from_deg));
  const glm::dvec2 wind{-from.sine, -from.cosine};
  const glm::dvec2 aside{-wind.y, wind.x};
  const glm::dvec3 top = deformation.point({summit, ground_m});
  const std::optional<glm::dvec2> there = camera.project(top);
  if (!there) return std::nullopt;
  LeeCloud cloud;
  cloud.altitude_m = ground_m;
  cloud.seed = seed;
  const Ray ray = camera.ray(*there);
  const glm::dvec3 right = glm::normalize(glm::cross(ray.direction, glm::dvec3(0.0, 0.0, 1.0)));
  const std::optional<glm::dvec2> beside = camera.project(top + right * (0.1 * parameters.size_m));
  if (!beside) return std::nullopt;
  cloud.length_px = std::max(1e-3, 10.0 * glm::length(*beside - *there));
  cloud.from_px = *there;
  cloud.to_px = *there;
  for (int k = 0; k < puff_count; ++k) {
    const PuffPlan plan = plan_puff(seed, k);
    const glm::dvec2 position =
        summit + parameters.size_m * (plan.along * wind + plan.across * aside);
    const glm::dvec3 centre = deformation.point({position, ground_m}) +
                              glm::dvec3(0.0, 0.0, plan.above * parameters.size_m);
    const std::optional<glm::dvec2> at = camera.project(centre);
    if (!at) continue;
    cloud.puffs.push_back(
        {centre, plan.radius * parameters.size_m, static_cast<float>(plan.opacity)});
    // A puff nearer than the summit is larger in the picture: at most twice as large.
    const glm::dvec2 reach(2.0 * puff_reach * plan.radius * cloud.length_px);
    cloud.from_px = glm::min(cloud.from_px, *at - reach);
    cloud.to_px = glm::max(cloud.to_px, *at + reach);
  }
  std::stable_sort(cloud.puffs.begin(), cloud.puffs.end(), [&](const LeePuff& a, const LeePuff& b) {
    return glm::dot(a.centre, ray.direction) > glm::dot(b.centre, ray.direction);
  });
  return cloud;
}

LeeEdges::LeeEdges(const LeeCloud& cloud)
    : per_px_(1.0 / cloud.length_px),
      noises_{GroundNoise(stream_seed(cloud.seed, Stream::lee_clouds, 1), broad_edges),
              GroundNoise(stream_seed(cloud.seed, Stream::lee_clouds, 2), broad_edges),
              GroundNoise(stream_seed(cloud.seed, Stream::lee_clouds, 3), narrow_edges),
              GroundNoise(stream_seed(cloud.seed, Stream::lee_clouds, 4), narrow_edges)} {}

glm::vec2 LeeEdges::at(glm::dvec2 pixel) {
  const double u = pixel.x * per_px_;
  const double v = pixel.y * per_px_;
  const glm::vec2 broad(noises_[0](u, v), noises_[1](u, v));
  const glm::vec2 narrow(noises_[2](u, v), noises_[3](u, v));
  return 0.17F * broad + 0.09F * narrow;
}

LeeSight see_lee_cloud(const LeeCloud& cloud, LeeEdges& edges, const Ray& ray, glm::dvec2 pixel,
                       double depth_m, glm::dvec3 towards_sun) {
  LeeSight sight;
  if (pixel.x < cloud.from_px.x || pixel.y < cloud.from_px.y || pixel.x > cloud.to_px.x ||
      pixel.y > cloud.to_px.y)
    return sight;
  const glm::dvec3 right = glm::normalize(glm::cross(ray.direction, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(right, ray.direction);
  const glm::vec2 light(static_cast<float>(glm::dot(towards_sun, right)),
                        static_cast<float>(glm::dot(towards_sun, up)));
  const auto facing = static_cast<float>(-glm::dot(towards_sun, ray.direction));
  const glm::vec2 wobble = edges.at(pixel);
  double depth = 0.0;
  float weight = 0.F;
  for (const LeePuff& puff : cloud.puffs) {
    const glm::dvec3 to = puff.centre - ray.origin;
    const double along = glm::dot(to, ray.direction);
    const glm::dvec3 off = ray.direction * along - to;
    const glm::vec2 offset =
        glm::vec2(static_cast<float>(glm::dot(off, right) / puff.radius_m),
                  static_cast<float>(glm::dot(off, up) / (flatness * puff.radius_m))) +
        wobble;
    const float distance = glm::length(offset);
    if (along <= 0.0 || distance >= 1.25F) continue;
    // Ground cuts into a puff over its own thickness.
    const double before = (depth_m - along) / puff.radius_m;
    const float seen = before > 0.6 ? 1.F : smoothstep(-0.6F, 0.6F, static_cast<float>(before));
    const float cover = (1.F - smoothstep(0.40F, 1.25F, distance)) * seen * puff.opacity;
    if (cover <= 0.F) continue;
    const float round = std::sqrt(std::max(0.F, 1.F - 0.64F * distance * distance));
    const float lit =
        unit(0.50F + 0.46F * glm::dot(offset, light) + 0.26F * facing * round + 0.16F * offset.y);
    sight.light += (lit - sight.light) * (sight.share > 0.F ? cover : 1.F);
    sight.share += cover * (1.F - sight.share);
    depth += static_cast<double>(cover) * along;
    weight += cover;
  }
  if (weight > 0.F) sight.depth_m = depth / static_cast<double>(weight);
  return sight;
}

}  // namespace belvedere
