#include "renderer/exemplar/available_texels.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/guidance_channels.h"
#include "base/math_exact.h"
#include "renderer/exemplar/texel_names.h"

namespace belvedere {
namespace {

constexpr float same_surface_ratio =
    1.03F;                               // neighbours with a larger depth ratio lie on two surfaces
constexpr double counted_size = 4096.0;  // of the painting that the minimum counts refer to

template <std::size_t bounds>
std::size_t bin_of(float value, const std::array<float, bounds>& limits) {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), value) -
                                  limits.begin());
}

std::size_t tone_bin(float tone) {
  return static_cast<std::size_t>(
      std::clamp(static_cast<int>(tone * AvailableTexels::tones), 0, AvailableTexels::tones - 1));
}

std::size_t direction_bin(glm::vec2 direction) {
  const float turns = exact::atan2(direction.y, direction.x) / (2.F * std::numbers::pi_v<float>);
  const int bin = static_cast<int>(std::floor(turns * AvailableTexels::directions + 0.5F));
  return static_cast<std::size_t>((bin + AvailableTexels::directions) %
                                  AvailableTexels::directions);
}

bool same_surface(float a, float b) {
  return a <= same_surface_ratio * b && b <= same_surface_ratio * a;
}

}  // namespace

std::int64_t AvailableTexels::ground() const {
  return std::accumulate(texels.begin(), texels.end(), std::int64_t{0});
}

void add_available(AvailableTexels& available, const GuidanceBuffers& guidance,
                   const Grid<LandCoverClass>& classes) {
  using B = GuidanceBuffers;
  require_channels(guidance, {&B::depth_m, &B::tone, &B::fall_line, &B::altitude_m, &B::shadow},
                   "supply");
  const int width = guidance.width();
  const int height = guidance.height();
  available.pixels += static_cast<std::int64_t>(guidance.depth_m.size());
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = classes.index(x, y);
      if (guidance.is_sky(i) || classes[i] == LandCoverClass::sky) continue;
      const auto id = static_cast<std::size_t>(classes[i]);
      const float depth = guidance.depth_m[i];
      ++available.texels[id];
      ++available.by_light[id][tone_bin(guidance.tone[i])]
                          [bin_of(depth, AvailableTexels::distance_bounds_m)];
      if (guidance.fall_line[i] != glm::vec2(0.F))
        ++available.by_direction[id][direction_bin(guidance.fall_line[i])];
      ++available
            .by_altitude[id][bin_of(guidance.altitude_m[i], AvailableTexels::altitude_bounds_m)];
      if (guidance.shadow[i] < 0.5F) ++available.in_cast_shadow[id];

      // A texel counts once for each other class around it.
      AvailableTexels::ByClass<bool> beside{};
      bool edge = false;
      const auto look = [&](int nx, int ny) {
        if (!classes.contains(nx, ny)) return;
        const float other = guidance.depth_m(nx, ny);
        if (other > same_surface_ratio * depth) edge = true;
        const auto its = static_cast<std::size_t>(classes(nx, ny));
        if (its != id && its != static_cast<std::size_t>(LandCoverClass::sky) &&
            same_surface(depth, other))
          beside[its] = true;
      };
      look(x - 1, y);
      look(x + 1, y);
      look(x, y - 1);
      look(x, y + 1);
      available.at_silhouette += edge ? 1 : 0;
      for (std::size_t k = 0; k < beside.size(); ++k) {
        if (!beside[k]) continue;
        ++available.border[id][k];
        ++available.border[k][id];
      }
    }
  }
}

std::vector<TexelShortage> find_gaps(const AvailableTexels& available, const NeededTexels& demand,
                                     const MinTexels& floors) {
  std::vector<TexelShortage> gaps;
  const double scale = static_cast<double>(available.pixels) / (counted_size * counted_size);
  const double length_scale =
      std::sqrt(scale);  // borders are lines: they scale with a painting's side
  const auto require = [&](bool needed, std::int64_t found, double floor, const auto& name) {
    if (needed && static_cast<double>(found) < floor)
      gaps.push_back({name(), static_cast<double>(found), floor});
  };
  for (int k = 1; k < land_cover_class_count; ++k) {
    const auto id = static_cast<std::size_t>(k);
    const std::string name(class_name(static_cast<LandCoverClass>(k)));
    require(demand.texels[id], available.texels[id], floors.texels * scale, [&] { return name; });
    const double max = floors.largest_share * static_cast<double>(available.ground());
    if (static_cast<double>(available.texels[id]) > max)
      gaps.push_back(
          {name + ", share of the ground", static_cast<double>(available.texels[id]), max, true});
    for (std::size_t t = 0; t < AvailableTexels::tones; ++t)
      for (std::size_t d = 0; d < AvailableTexels::distances; ++d)
        require(demand.light[id][t][d], available.by_light[id][t][d], floors.light * scale, [&] {
          return fmt::format("{}, tone {:.1f}–{:.1f}, {}", name, 0.2 * t, 0.2 * (t + 1),
                             distance_name(d));
        });
    for (std::size_t n = 0; n < AvailableTexels::directions; ++n)
      require(demand.direction[id][n], available.by_direction[id][n], floors.direction * scale,
              [&] { return fmt::format("{}, fall line {}", name, direction_name(n)); });
    require(demand.shadow[id], available.in_cast_shadow[id], floors.shadow * scale,
            [&] { return name + ", in cast shadow"; });
    for (std::size_t other = id + 1; other < static_cast<std::size_t>(land_cover_class_count);
         ++other)
      require(demand.border[id][other], available.border[id][other], floors.border * length_scale,
              [&] {
                return fmt::format("border of {} and {}", name,
                                   class_name(static_cast<LandCoverClass>(other)));
              });
  }
  const auto forest = static_cast<std::size_t>(LandCoverClass::forest);
  for (std::size_t a = 0; a < AvailableTexels::altitudes; ++a)
    require(true, available.by_altitude[forest][a], floors.altitude * scale,
            [&] { return "forest, " + altitude_name(a); });
  return gaps;
}

}  // namespace belvedere
