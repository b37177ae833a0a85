#include "renderer/paint/guides.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

using B = GuidanceBuffers;

constexpr float nearest_m = 500.0F;
constexpr float farthest_m = 500000.0F;

float log_distance(const GuidanceBuffers& g, std::size_t i) {
  return exact::log(std::max(g.depth_m[i], nearest_m) / nearest_m) /
         exact::log(farthest_m / nearest_m);
}

// The base picture already contributes relief, altitude and air, so guides only choose among
// strokes. Their weights are low: higher ones break the texture into grain. Tone comes first,
// because strokes in shade differ from those in light, then the direction of the strokes.
const GuideKind kinds[] = {
    {"altitude", "20 m per step from 0 m", &B::altitude_m,
     [](const B& g, std::size_t i) { return g.altitude_m[i] / (20.0F * 255.0F); }, 0.04},
    {"tone", "light, 0…1", &B::tone, [](const B& g, std::size_t i) { return g.tone[i]; }, 0.15},
    {"distance", "logarithm from 500 m to 500 km", &B::depth_m, log_distance, 0.02},
    {"shadow", "0 in cast shadow … 1 lit", &B::shadow,
     [](const B& g, std::size_t i) { return g.shadow[i]; }, 0.02},
    {"slope", "0…90°", &B::slope_deg,
     [](const B& g, std::size_t i) { return g.slope_deg[i] / 90.0F; }, 0.02},
    {"fall_line_x", "x of the unit direction, -1 (left) … 1; 128 where there is none",
     &B::fall_line, [](const B& g, std::size_t i) { return 0.5F + 0.5F * g.fall_line[i].x; }, 0.1},
    {"fall_line_y", "y of the unit direction, -1 (up) … 1; 128 where there is none", &B::fall_line,
     [](const B& g, std::size_t i) { return 0.5F + 0.5F * g.fall_line[i].y; }, 0.05},
    {"valley", "height above the lowest ground within 900 m, 0…600 m", &B::valley_height_m,
     [](const B& g, std::size_t i) { return g.valley_height_m[i] / 600.0F; }, 0.0},
    {"flow", "upstream area, logarithm from 100 m² to 100 000 km²", &B::flow,
     [](const B& g, std::size_t i) { return (g.flow[i] - 2.0F) / 9.0F; }, 0.0},
};

// Calls f(i) for the pixels of a grid, with rows in parallel.
template <class G, class F>
void for_each_pixel(const G& grid, F&& f) {
  parallel_rows(grid.height(), [&](int y) {
    for (std::size_t i = grid.index(0, y); i < grid.index(0, y + 1); ++i) f(i);
  });
}

// Value 0…1 in 256 steps.
std::uint8_t quantize(float share) {
  return static_cast<std::uint8_t>(std::floor(std::clamp(share, 0.0F, 1.0F) * 255.0F + 0.5F));
}

// Strokes carry the colour of their origin some distance over the class. Up to this difference
// (encoded sRGB, the channel that differs most) it is part of the variety of paint and is copied.
// The rest is a border of fields or of light that a stroke crossed: on a base with other borders it
// would be a speck of a foreign colour.
constexpr float carried_colour = 0.06F;

// The remainder of a difference when `max` is taken off its largest component; the others scale in
// proportion.
glm::vec3 beyond(glm::vec3 difference, float max) {
  const float largest =
      std::max({std::abs(difference.x), std::abs(difference.y), std::abs(difference.z)});
  return largest > max ? difference * (1.0F - max / largest) : glm::vec3(0.0F);
}

}  // namespace

std::span<const GuideKind> guide_kinds() { return kinds; }

std::vector<std::string> guide_names() {
  std::vector<std::string> names;
  for (const GuideKind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

std::vector<std::pair<std::string, double>> default_guide_weights() {
  std::vector<std::pair<std::string, double>> weights;
  for (const GuideKind& kind : kinds) weights.emplace_back(kind.name, kind.weight);
  return weights;
}

PaintedClasses find_painted_classes(const Grid<std::uint32_t>& sources,
                                    const GuidanceBuffers& guidance, const Grid<glm::vec3>& base) {
  PaintedClasses painted{guidance.land_cover, base};
  for_each_pixel(sources, [&](std::size_t i) {
    const std::uint32_t source = sources[i];
    painted.land_cover[i] = guidance.land_cover[source];
    const bool over_border = guidance.land_cover[i] != painted.land_cover[i];
    painted.base[i] =
        over_border ? base[source] : base[i] + beyond(base[source] - base[i], carried_colour);
  });
  return painted;
}

GuideStack make_guide_stack(const GuidanceBuffers& guidance,
                            const Grid<LandCoverClass>& land_cover) {
  require_channels(guidance, {&B::depth_m}, "guides");
  if (!guidance.depth_m.same_size(land_cover))
    throw Error(ErrorKind::bug, "guides", "land cover and picture have different sizes");
  GuideStack stack;
  stack.depth_m = guidance.depth_m;
  stack.label = Grid<std::uint8_t>(guidance.width(), guidance.height(), unused_label);
  for_each_pixel(stack.label, [&](std::size_t i) {
    if (!guidance.is_sky(i)) stack.label[i] = static_cast<std::uint8_t>(land_cover[i]);
  });
  for (const GuideKind& kind : kinds) {
    if (!has_channel(guidance, kind.channel)) continue;
    Guide guide{std::string(kind.name), Grid<std::uint8_t>(guidance.width(), guidance.height(), 0)};
    for_each_pixel(guide.values, [&](std::size_t i) {
      if (!guidance.is_sky(i)) guide.values[i] = quantize(kind.share(guidance, i));
    });
    stack.guides.push_back(std::move(guide));
  }
  return stack;
}

}  // namespace belvedere
