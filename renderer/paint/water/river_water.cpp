#include "renderer/paint/water/river_water.h"

#include <glm/common.hpp>
#include <utility>

#include "base/math.h"

namespace belvedere {
namespace {

constexpr float pool_tone = 0.16F;
constexpr glm::vec3 pool_lost{0.34F, 0.14F, 0.13F};  // share of light that a pool absorbs
constexpr float riffle_tone = 0.07F;
constexpr float riffle_white = 0.50F;

}  // namespace

WaterLook with_current(WaterLook look, float around, float streak, const Patches& patches,
                       float river) {
  // Pools and riffles follow each other; both are over the middle, shallows at the banks.
  const float middle = river * smoothstep(0.45F, 0.95F, around);
  const float pool = middle * smoothstep(-0.3F, 1.1F, patches.n60 + 0.5F * patches.n25);
  const float riffle = middle * smoothstep(0.1F, 1.0F, -patches.n60) * (1.0F - pool);
  look.tone_shift += riffle_tone * riffle - pool_tone * pool;
  look.depth *= 1.0F - pool * pool_lost;
  // Dashes end within the river.
  const float dash = smoothstep(0.2F, 1.3F, streak) * smoothstep(-0.5F, 0.9F, patches.n25);
  look.white_share = riffle_white * riffle * dash;
  return look;
}

}  // namespace belvedere
