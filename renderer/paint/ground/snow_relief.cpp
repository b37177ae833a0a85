#include "renderer/paint/ground/snow_relief.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "renderer/paint/picture_noise.h"

namespace belvedere {
namespace {

constexpr std::size_t field_memory_size =
    256;                            // lattice values that a field caches; a power of two
constexpr int lowest_octave = -12;  // forms of 2^-12 m are the smallest

// Sizes of forms: deviation of their noise in units of the sheet, and their steepness.
struct SnowSize {
  double sigma_units;
  float steepness;
};
enum Size : int { swells, drifts, calm_places };
constexpr std::array<SnowSize, 3> sizes = {{{12.0, 0.30F}, {4.2, 0.20F}, {46.0, 0.0F}}};
// Snow shows the lower of two forms; these are the stretches of each along and across the wind.
constexpr glm::dvec2 windward_stretch{1.15, 2.3};
constexpr glm::dvec2 lee_stretch{0.75, 1.6};
constexpr float lee_rise =
    0.35F;  // how much higher the second is: where it is lower, it cuts into the first
constexpr float crest_edge = 0.10F;  // width of the transition from one to the other

}  // namespace

glm::dvec2 snow_wind(glm::dvec3 sun_direction) {
  const glm::dvec2 level(sun_direction);
  const double length = glm::length(level);
  const glm::dvec2 away = length > 1e-6 ? -level / length : glm::dvec2(1.0, 0.0);
  constexpr glm::dvec2 aside{0.819, 0.574};
  return {away.x * aside.x - away.y * aside.y, away.x * aside.y + away.y * aside.x};
}

// Noise of deviation about 1 with its gradient; lattice and B-spline as in base/random.h, without
// the variance correction between lattice points.
class SnowRelief::Field {
 public:
  explicit Field(std::uint64_t seed)
      : seed_(seed), memory_(field_memory_size, Entry{nowhere, nowhere, 0.0F}) {}

  // Position in deviations. Returns the value and its change per deviation along x and y.
  std::array<float, 3> at(double x, double y) {
    const Weights wx = weights(x / spacing_per_sigma);
    const Weights wy = weights(y / spacing_per_sigma);
    if (wx.first != x_ || wy.first != y_) {
      x_ = wx.first;
      y_ = wy.first;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          cell_[static_cast<std::size_t>(4 * j + i)] = lattice(x_ + i, y_ + j);
    }
    float value = 0.0F;
    float along = 0.0F;
    float across = 0.0F;
    for (std::size_t j = 0; j < 4; ++j) {
      float row = 0.0F;
      float row_along = 0.0F;
      for (std::size_t i = 0; i < 4; ++i) {
        row += wx.value[i] * cell_[4 * j + i];
        row_along += wx.slope[i] * cell_[4 * j + i];
      }
      value += wy.value[j] * row;
      along += wy.value[j] * row_along;
      across += wy.slope[j] * row;
    }
    // A B-spline leaves .48 of the deviation of white noise in each direction, averaged over a
    // cell.
    constexpr float gain = 2.08F;
    return {gain * value, gain * along / static_cast<float>(spacing_per_sigma),
            gain * across / static_cast<float>(spacing_per_sigma)};
  }

 private:
  struct Weights {
    std::int64_t first;
    std::array<float, 4> value, slope;
  };
  struct Entry {
    std::int64_t x, y;
    float value;
  };
  static Weights weights(double position) {
    const double base = std::floor(position);
    const auto t = static_cast<float>(position - base);
    const float u = 1.0F - t;
    return {static_cast<std::int64_t>(base) - 1,
            {u * u * u / 6.0F, (4.0F - 6.0F * t * t + 3.0F * t * t * t) / 6.0F,
             (4.0F - 6.0F * u * u + 3.0F * u * u * u) / 6.0F, t * t * t / 6.0F},
            {-0.5F * u * u, -2.0F * t + 1.5F * t * t, 2.0F * u - 1.5F * u * u, 0.5F * t * t}};
  }
  float lattice(std::int64_t x, std::int64_t y) {
    const auto slot = static_cast<std::size_t>(static_cast<std::uint64_t>(x) +
                                               37U * static_cast<std::uint64_t>(y)) &
                      (field_memory_size - 1);
    Entry& entry = memory_[slot];
    if (entry.x != x || entry.y != y)
      entry = {x, y, static_cast<float>(random_normal(seed_, x, y))};
    return entry.value;
  }

  std::uint64_t seed_;
  std::int64_t x_ = nowhere, y_ = nowhere;
  std::array<float, 16> cell_{};
  std::vector<Entry> memory_;
};

struct SnowRelief::Layer {
  Field windward, lee;
};

SnowRelief::SnowRelief(std::uint64_t seed, glm::dvec2 wind) : seed_(seed), wind_(wind) {
  for (auto& layers : layers_) layers.resize(octaves);
}
SnowRelief::~SnowRelief() = default;

// One size of forms whose noise has a deviation of 2^power metres.
SnowRelief::Sample SnowRelief::layer_at(int size, int power, glm::dvec2 position_m) {
  const int index = std::clamp(power - lowest_octave, 0, octaves - 1);
  auto& layer = layers_[static_cast<std::size_t>(size)][static_cast<std::size_t>(index)];
  if (!layer) {
    const auto part = static_cast<std::uint64_t>(2 * (size * octaves + index));
    layer.reset(new Layer{Field(stream_seed(seed_, Stream::snow_drifts, part)),
                          Field(stream_seed(seed_, Stream::snow_drifts, part + 1))});
  }
  const double sigma_m = std::ldexp(1.0, index + lowest_octave);
  const double along = (position_m.x * wind_.x + position_m.y * wind_.y) / sigma_m;
  const double across = (position_m.y * wind_.x - position_m.x * wind_.y) / sigma_m;
  const auto form = [&](Field& field, glm::dvec2 stretch) {
    std::array<float, 3> f = field.at(along / stretch.x, across / stretch.y);
    f[1] /= static_cast<float>(stretch.x);
    f[2] /= static_cast<float>(stretch.y);
    return f;
  };
  const std::array<float, 3> first = form(layer->windward, windward_stretch);
  if (size == calm_places) return {glm::vec2(0.0F), first[0]};
  const std::array<float, 3> second = form(layer->lee, lee_stretch);
  const float over = smoothstep(-crest_edge, crest_edge, first[0] - second[0] - lee_rise);
  const auto mixed = [&](std::size_t k) { return first[k] + (second[k] - first[k]) * over; };
  const glm::vec2 wind(wind_);
  return {wind * mixed(1) + glm::vec2(-wind.y, wind.x) * mixed(2), mixed(0) + lee_rise * over};
}

// A mixture of two octaves that blend only around the half-way point, so that most positions have
// forms of one.
SnowRelief::Sample SnowRelief::size_at(int size, glm::dvec2 position_m, double metres_per_unit) {
  const double octave =
      exact::log2(sizes[static_cast<std::size_t>(size)].sigma_units * metres_per_unit);
  const double below = std::floor(octave);
  const float share = smoothstep(0.32F, 0.68F, static_cast<float>(octave - below));
  const int power = static_cast<int>(below);
  if (share <= 0.0F) return layer_at(size, power, position_m);
  if (share >= 1.0F) return layer_at(size, power + 1, position_m);
  const Sample fine = layer_at(size, power, position_m);
  const Sample coarse = layer_at(size, power + 1, position_m);
  return {glm::mix(fine.slope, coarse.slope, share), glm::mix(fine.height, coarse.height, share)};
}

SnowForm SnowRelief::at(glm::dvec2 position_m, double metres_per_unit, double pixels_per_unit) {
  const auto drawn = [&](Size size) {
    return smoothstep(1.0F, 2.6F, static_cast<float>(sizes[size].sigma_units * pixels_per_unit));
  };
  SnowForm form;
  const Sample large = size_at(swells, position_m, metres_per_unit);
  const float lively =
      unit(0.72F + 0.40F * size_at(calm_places, position_m, metres_per_unit).height);
  form.height = large.height;
  form.slope = large.slope * (sizes[swells].steepness * drawn(swells) * (0.45F + 0.55F * lively));
  const float gathered = unit(0.55F - 0.45F * large.height) * lively * drawn(drifts);
  if (gathered > 0.0F)
    form.slope +=
        size_at(drifts, position_m, metres_per_unit).slope * (sizes[drifts].steepness * gathered);
  return form;
}

}  // namespace belvedere
