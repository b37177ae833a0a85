#include "texture/statistical/seed_noise.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr float min_disc_px = 1.2F;  // smaller ones cannot be resolved at their level
constexpr float disc_share = .85F;   // of a disc's single value; the rest is white noise
constexpr int discs_a_cell = 2;

float white(std::uint64_t seed, int x, int y) {
  return static_cast<float>(random_uniform(seed, x, y));
}

// The mean of white noise along the field's line through a pixel, `steps` pixels to either side.
float streak(const SeedNoise& noise, std::uint64_t seed, int x, int y, int level, int steps) {
  const double scale = 1 << level;
  float sum = white(seed, x, y);
  float count = 1.F;
  for (const float sign : {-1.F, 1.F}) {
    glm::vec2 at(static_cast<float>(x) + .5F, static_cast<float>(y) + .5F);
    glm::vec2 before(0.F);
    for (int i = 0; i < steps; ++i) {
      glm::vec2 along = noise.direction ? noise.direction(scale * static_cast<double>(at.x),
                                                          scale * static_cast<double>(at.y))
                                        : glm::vec2(1.F, 0.F);
      if (along.x == 0.F && along.y == 0.F) break;
      if (before.x * along.x + before.y * along.y < 0.F)
        along = -along;  // a field of lines has no sign; a path has
      before = along;
      at += sign * along;
      sum += white(seed, static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
      count += 1.F;
    }
  }
  // A mean of n values has 1/√n of the deviation.
  return std::clamp((sum / count - .5F) * std::sqrt(count) * .9F + .5F, 0.F, 1.F);
}

// The value of the topmost disc over a pixel. `positions` determines the discs, the same for all
// bands; `seed` their values.
float disc(std::uint64_t positions, std::uint64_t seed, int x, int y, float radius) {
  const float px = static_cast<float>(x);
  const float py = static_cast<float>(y);
  const int cx = static_cast<int>(std::floor(px / radius));
  const int cy = static_cast<int>(std::floor(py / radius));
  const float rest = white(seed, x, y);
  float top = 2.F;
  float value = rest;
  for (int j = cy - 1; j <= cy + 1; ++j) {
    for (int i = cx - 1; i <= cx + 1; ++i) {
      for (std::uint64_t k = 0; k < discs_a_cell; ++k) {
        const auto draw = [&](std::uint64_t n) {
          return static_cast<float>(random_uniform(positions, i, j, 4 * k + n));
        };
        const float dx = (static_cast<float>(i) + draw(0)) * radius - px;
        const float dy = (static_cast<float>(j) + draw(1)) * radius - py;
        const float height = draw(2);
        const float own = radius * (.45F + .4F * draw(3));
        if (height >= top || dx * dx + dy * dy >= own * own) continue;
        top = height;
        value = disc_share * static_cast<float>(random_uniform(seed, i, j, 16 + k)) +
                (1.F - disc_share) * rest;
      }
    }
  }
  return value;
}

}  // namespace

DirectionField own_directions(const CliqueModel& model, std::uint64_t seed) {
  constexpr double bend_px =
      60.0;  // half width of the noise that bends a field; with smaller noise it curls
  constexpr double max_rad = 0.9;  // per deviation of that noise
  const std::uint64_t noise = stream_seed(seed, Stream::statistical_directions);
  const double centre = to_radians(static_cast<double>(model.direction_deg));
  const double reach = max_rad * static_cast<double>(model.direction_spread);
  return [noise, centre, reach](double x, double y) {
    const exact::Turn turn = exact::turn(centre + reach * gaussian_noise(noise, x, y, bend_px));
    return glm::vec2(static_cast<float>(turn.cosine), static_cast<float>(turn.sine));
  };
}

Grid<float> seed_noise(const SeedNoise& noise, TexturePosition position, int width, int height,
                       int level, int band) {
  const std::uint64_t seed = stream_seed(noise.seed, Stream::statistical_noise,
                                         static_cast<std::uint64_t>(4 * level + band));
  const std::uint64_t positions =
      stream_seed(noise.seed, Stream::statistical_discs, static_cast<std::uint64_t>(level));
  const float radius = noise.px / static_cast<float>(1 << level);
  const int steps = std::max(1, static_cast<int>(noise.px) >> level);
  const bool discs = noise.kind == TextureSeed::discs && radius >= min_disc_px;
  const int x0 = position.x >> level;
  const int y0 = position.y >> level;
  Grid<float> out(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      float value = 0.F;
      if (noise.kind == TextureSeed::streaks)
        value = streak(noise, seed, x0 + x, y0 + y, level, steps);
      else if (discs)
        value = disc(positions, seed, x0 + x, y0 + y, radius);
      else
        value = white(seed, x0 + x, y0 + y);
      out(x, y) = value;
    }
  });
  return out;
}

}  // namespace belvedere
