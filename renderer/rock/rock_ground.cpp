#include "renderer/rock/rock_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "renderer/paint/picture_filter.h"

namespace belvedere {
namespace {

using Class = LandCoverClass;

// Widths of the blurs, units.
constexpr double rock_sigma_units = 5.1;
constexpr double turf_sigma_units = 13.6;
constexpr double snow_sigma_units = 12.0;

constexpr float tongue = 0.75F;      // how far spurs and gullies shift the border
constexpr float bed_ledge = 0.50F;   // how far beds do
constexpr float keeps_rock = 0.42F;  // share of rock around below which rock is replaced …
constexpr float inside = 0.93F;      // … but not in the centre of a wall
constexpr float becomes_rock = 0.62F;
constexpr float bare_snow_deg = 50.0F;  // slope at which most crests are bare of snow
constexpr float bare_share = 0.56F;
constexpr float cone_share = 0.20F;  // share by which debris reaches up beneath a funnel

bool is_vegetation(Class id) { return is_turf(id) || id == Class::forest; }
bool is_snow(Class id) { return id == Class::snow || id == Class::glacier; }
bool gives_way(Class id) { return id == Class::scree || is_turf(id) || id == Class::snow; }

template <class Test>
Grid<float> share_around_of(const WideView& wide, double sigma_px, PixelRect wanted, Test&& test) {
  Grid<float> mask(wide.seen.width(), wide.seen.height(), 0.0F);
  std::vector<std::uint8_t> any(static_cast<std::size_t>(mask.height()), std::uint8_t{0});
  parallel_ranges(mask.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      for (int x = 0; x < mask.width(); ++x)
        if (test(wide.seen.land_cover(x, y))) {
          mask(x, y) = 1.0F;
          any[static_cast<std::size_t>(y)] = 1;
        }
  });
  return std::find(any.begin(), any.end(), std::uint8_t{1}) != any.end()
             ? blur_on_surface(mask, wide.seen.depth_m, sigma_px, wanted)
             : mask;
}

}  // namespace

RockAround look_around_rock(const WideView& wide, double pixels_per_unit, PixelRect wanted) {
  const double scale = pixels_per_unit / wide.factor;
  return {.rock = share_around_of(wide, rock_sigma_units * scale, wanted,
                                  [](Class id) { return id == Class::rock; }),
          .turf = share_around_of(wide, turf_sigma_units * scale, wanted, is_vegetation),
          .snow = share_around_of(wide, snow_sigma_units * scale, wanted, is_snow)};
}

int rock_around_reach(double pixels_per_unit, int factor) {
  return surface_reach_px(turf_sigma_units * pixels_per_unit / factor);
}

float standing_bed(double altitude_m, double east_m, double north_m, float metres_per_unit,
                   float noise) {
  constexpr float bed_units = 7.0F;
  const double wanted_m = std::max(0.5, static_cast<double>(bed_units * metres_per_unit));
  double thick_m = 1.0;
  while (thick_m * 1.4142 < wanted_m) thick_m *= 2.0;
  const auto phase =
      static_cast<float>((altitude_m + 0.26 * east_m - 0.11 * north_m) / thick_m) + 0.22F * noise;
  const float number = std::floor(phase);
  const float at = phase - number;
  const auto height = [](float bed) {
    const auto id = static_cast<std::uint64_t>(static_cast<std::int64_t>(bed));
    return 2.0F * static_cast<float>(mix_bits(id + 77U) >> 40U) / static_cast<float>(1U << 24U) -
           1.0F;
  };
  // A bed ends sharply at its top; below it weathers back.
  constexpr float back = 0.3F;
  const float own = height(number);
  return at < back ? own + (height(number - 1.0F) - own) * (1.0F - at / back) : own;
}

bool is_turf(Class id) {
  return id == Class::alpine_grass || id == Class::pasture || id == Class::shrub;
}

std::optional<float> clings_deg(LandCoverClass id, float close) {
  if (id == Class::snow) return 0.0F;
  if (close <= 0.0F) return std::nullopt;
  if (id == Class::glacier) return 2.0F;
  if (id == Class::scree) return 1.0F;
  if (is_turf(id)) return 3.0F;
  return std::nullopt;
}

LandCoverClass rock_border(const RockPosition& position) {
  const float r = position.rock;
  const float edge = 1.0F - 0.6F * std::abs(2.0F * r - 1.0F);
  const float under = smoothstep(0.05F, 0.4F, position.above);  // the foot of a wall
  const float cone = cone_share * position.cones * under * smoothstep(0.2F, 1.2F, -position.funnel);
  const float by_spurs =
      tongue * (1.0F - 0.65F * position.bedded) * std::clamp(1.4F * position.stands, -0.6F, 0.6F);
  const float m = r + (by_spurs + bed_ledge * position.bedded * position.bed) * edge - cone;
  if (position.mapped == Class::rock) {
    if (m > keeps_rock || (r > inside && cone <= 0.0F)) return Class::rock;
    if (position.snow > 0.30F && position.snow > position.turf) return Class::snow;
    return under < 0.35F ? Class::rock : Class::scree;
  }
  if (const std::optional<float> clings = clings_deg(position.mapped, position.close)) {
    // Near snow, stones and turf stay in the hollows of a wall and leave its ribs.
    const float slope_deg = position.slope_deg - *clings +
                            position.close * (3.0F * std::clamp(position.funnel, -1.5F, 1.5F) +
                                              4.5F * std::clamp(position.wall, -1.5F, 1.2F));
    const float from_deg = steep_snow_deg(position.close);
    float bare = smoothstep(from_deg, bare_snow_deg - 9.0F * position.close, slope_deg);
    // In turf no lone splinters.
    if (is_turf(position.mapped)) bare *= smoothstep(0.45F, 0.80F, bare);
    const float far_out = m + bare_share * bare;
    // The barer a wall, the broader its ribs.
    const float near_out = r + bare * (0.42F + 0.75F * position.rib) + 0.50F * position.stands +
                           0.15F * position.bedded * position.bed;
    if (far_out + position.close * (near_out - far_out) > becomes_rock) return Class::rock;
  }
  return gives_way(position.mapped) && m > becomes_rock ? Class::rock : position.mapped;
}

}  // namespace belvedere
