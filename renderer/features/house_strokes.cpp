#include "renderer/features/house_strokes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/random.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

constexpr glm::vec3 dusk{0.30F, 0.32F, 0.42F};
constexpr float stroke_px = 1.8F;  // of a face, wider than their spacing so that no gaps remain
constexpr float step_px = 0.9F;
constexpr int max_strokes = 120;  // of a face
constexpr float before_grass =
    0.003F;  // of its distance: strokes on ground that is nearer by this do not paint over a house

// A face as strokes side by side from its lower to its upper edge, each about a pixel wide, to keep
// its slanting ends.
void lay_face(const HouseFace& face, Stroke& body, std::vector<Stroke>& out) {
  const auto [a, b, c, d] = face.corners;
  const glm::vec2 along = 0.5F * (b - a + c - d);
  const float length = glm::length(along);
  if (length < 1e-3F) return;
  const glm::vec2 up = 0.5F * (d - a + c - b);
  const float height = std::abs(along.x * up.y - along.y * up.x) / length;
  const float width = std::clamp(height, 0.3F, stroke_px);
  const int count =
      std::clamp(static_cast<int>(std::ceil((height - width) / step_px)), 0, max_strokes) + 1;
  const float margin = height > width ? 0.5F * width / height : 0.5F;
  for (int k = 0; k < count; ++k) {
    const float t = count > 1 ? margin + (1.F - 2.F * margin) * static_cast<float>(k) /
                                             static_cast<float>(count - 1)
                              : 0.5F;
    const float broad =
        std::max(width, (height - width) / static_cast<float>(count) * (stroke_px / step_px));
    set_line(body, glm::mix(a, d, t), glm::mix(b, c, t), broad, broad);
    out.push_back(body);
  }
}

void build(const StrokeScene& scene, const DrawnHouse& house, const FeatureColours& colours,
           std::size_t i, std::vector<Stroke>& out) {
  const float tone = std::clamp(scene.guidance.tone[i], 0.F, 1.F);
  Stroke body = standing_stroke(scene, i);
  body.depth_m = house.distance_m;
  body.order = house.distance_m * (1.F - before_grass) - 1.F;
  body.standing = true;
  for (const HouseShade& cast : house.shades) {
    Stroke shade = body;
    shade.gate = StrokeGate::surface;
    set_line(shade, cast.from, cast.to, cast.width, 0.6F * cast.width);
    shade.alpha = 0.25F + 0.30F * tone;
    shade.colour = through_air(scene, i, dusk);
    out.push_back(shade);
  }
  body.gate = StrokeGate::upright;
  body.tip = StrokeTip::square;
  const std::uint64_t key = stream_seed(scene.parameters.seed, Stream::houses);
  const auto value =
      static_cast<float>(0.03 * random_normal(key, static_cast<std::int64_t>(house.foot.x),
                                              static_cast<std::int64_t>(house.foot.y), 0));
  for (const HouseFace& face : house.faces) {
    body.order -= 0.2F;
    body.alpha = 0.96F;
    // A house in the shade of a mountain has no sunny side.
    const float light = 0.58F + 0.12F * tone + 0.36F * face.light * tone;
    const glm::vec3 paint = (face.roof ? colours.fill : colours.casing) + value;
    const glm::vec3 cool =
        glm::mix(glm::vec3(0.92F, 0.97F, 1.10F), glm::vec3(1.F), face.light * tone);
    body.colour =
        through_air(scene, i, glm::clamp(paint * light * cool, glm::vec3(0.F), glm::vec3(1.F)));
    lay_face(face, body, out);
  }
}

}  // namespace

std::vector<Stroke> house_strokes(const DrawnFeatures& features, const StrokeScene& scene) {
  std::vector<Stroke> all;
  const glm::ivec2 origin = scene.window.origin_px;
  const PixelRect held{origin.x, origin.y, origin.x + scene.guidance.width(),
                       origin.y + scene.guidance.height()};
  for (const std::uint32_t number : features.houses_at(held)) {
    const DrawnHouse& house = features.houses[number];
    if (house.foot.x < 0.F || house.foot.y < 0.F || !scene.on_canvas(house.foot)) continue;
    const std::size_t i = scene.pixel(house.foot);
    if (scene.guidance.is_sky(i)) continue;
    const FeatureKind& kind = features.style.kinds[static_cast<std::size_t>(house.kind)];
    build(scene, house, features.winter ? kind.winter : kind.summer, i, all);
  }
  return all;
}

}  // namespace belvedere
