#include "renderer/paint/water/water_wind.h"

#include "base/math.h"
#include "base/random_streams.h"

namespace belvedere {
namespace {

constexpr double broad_m = 420.0;
constexpr double fine_m = 110.0;

}  // namespace

WaterWind::WaterWind(std::uint64_t seed)
    : broad_(stream_seed(seed, Stream::water_wind, 0), broad_m),
      fine_(stream_seed(seed, Stream::water_wind, 1), fine_m) {}

float WaterWind::ruffled(glm::dvec3 position_m, float metres_per_unit, float strength) {
  if (!(strength > 0.0F)) return 0.0F;
  const float kept = unit(1.6F - metres_per_unit / 40.0F);
  const float noise =
      broad_(position_m.x, position_m.y) + 0.55F * kept * fine_(position_m.x, position_m.y);
  return smoothstep(0.55F, 1.35F, noise + 0.35F * (strength - 1.0F)) * unit(strength);
}

}  // namespace belvedere
