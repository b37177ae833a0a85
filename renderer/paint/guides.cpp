#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/error.h"
#include "renderer/paint/paint.h"

namespace belvedere {
namespace {

constexpr std::uint8_t excluded_label = 255;
constexpr float nearest_m = 500.0F;
constexpr float farthest_m = 500000.0F;

// Value 0…1 in 256 steps.
std::uint8_t quantize(float share) { return static_cast<std::uint8_t>(std::floor(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F)); }

}  // namespace

PaintedClasses find_painted_classes(const Grid<std::uint32_t>& sources, const GuidanceBuffers& guidance, const Grid<glm::vec3>& base) {
  PaintedClasses painted{guidance.land_cover, base};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::uint32_t source = sources[i];
    painted.land_cover[i] = guidance.land_cover[source];
    if (guidance.land_cover[i] != painted.land_cover[i]) painted.base[i] = base[source];
  }
  return painted;
}

GuideStack make_guide_stack(const GuidanceBuffers& guidance, const Grid<LandCoverClass>& land_cover) {
  if (!guidance.depth_m.same_size(land_cover)) throw Error(ErrorKind::bug, "guides", "land cover is missing");
  const int width = guidance.width();
  const int height = guidance.height();
  GuideStack stack;
  stack.depth_m = guidance.depth_m;
  stack.label = Grid<std::uint8_t>(width, height, excluded_label);
  for (std::size_t i = 0; i < stack.label.size(); ++i)
    if (!guidance.is_sky(i)) stack.label[i] = static_cast<std::uint8_t>(land_cover[i]);

  const auto add = [&](const char* name, bool present, auto share) {
    if (!present) return;
    Guide guide{name, Grid<std::uint8_t>(width, height, 0)};
    for (std::size_t i = 0; i < guide.values.size(); ++i)
      if (!guidance.is_sky(i)) guide.values[i] = quantize(share(i));
    stack.guides.push_back(std::move(guide));
  };
  const float log_range = std::log(farthest_m / nearest_m);
  const auto has = [&](const auto& channel) { return channel.same_size(guidance.depth_m); };
  add("altitude", has(guidance.altitude_m), [&](std::size_t i) { return guidance.altitude_m[i] / (20.0F * 255.0F); });
  add("tone", has(guidance.tone), [&](std::size_t i) { return guidance.tone[i]; });
  add("distance", true, [&](std::size_t i) { return std::log(std::max(guidance.depth_m[i], nearest_m) / nearest_m) / log_range; });
  add("shadow", has(guidance.shadow), [&](std::size_t i) { return guidance.shadow[i]; });
  add("slope", has(guidance.slope_deg), [&](std::size_t i) { return guidance.slope_deg[i] / 90.0F; });
  add("fall_line_x", has(guidance.fall_line), [&](std::size_t i) { return 0.5F + 0.5F * guidance.fall_line[i].x; });
  add("fall_line_y", has(guidance.fall_line), [&](std::size_t i) { return 0.5F + 0.5F * guidance.fall_line[i].y; });
  return stack;
}

}  // namespace belvedere
