#include "renderer/features/feature_matte.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <tuple>
#include <utility>

#include "renderer/features/paint_features.h"

namespace belvedere {
namespace {

constexpr float hides_house = 0.02F;  // of its distance: ground nearer by this hides a house
constexpr int samples = 4;            // of a pixel, along x and y

// Lays a kind over what covers a pixel; of three, the one that covers least is left out.
void cover(MattePixel& pixel, int kind, float share) {
  const auto id = static_cast<std::uint16_t>(kind + 1);
  const auto covered = [&](std::uint8_t old) {
    return static_cast<std::uint8_t>(std::lround(static_cast<float>(old) * (1.F - share)));
  };
  pixel.share = {covered(pixel.share[0]), covered(pixel.share[1])};
  const auto own = static_cast<std::uint8_t>(std::lround(255.F * share));
  std::size_t at = pixel.share[0] <= pixel.share[1] ? 0 : 1;
  for (std::size_t k = 0; k < 2; ++k)
    if (pixel.id[k] == id) at = k;
  if (pixel.id[at] == id)
    pixel.share[at] = static_cast<std::uint8_t>(std::min(255, pixel.share[at] + own));
  else if (own >= pixel.share[at])
    std::tie(pixel.id[at], pixel.share[at]) = std::pair(id, own);
}

// Corners of a face go around it.
bool is_inside(const HouseFace& face, glm::vec2 point) {
  bool inside = false;
  for (std::size_t i = 0, j = 3; i < 4; j = i++) {
    const glm::vec2 a = face.corners[i];
    const glm::vec2 b = face.corners[j];
    if ((a.y > point.y) != (b.y > point.y) &&
        point.x < (b.x - a.x) * (point.y - a.y) / (b.y - a.y) + a.x)
      inside = !inside;
  }
  return inside;
}

// The share of a pixel of the sheet that a house covers.
float share_of(const DrawnHouse& house, int x, int y) {
  int hits = 0;
  for (int k = 0; k < samples * samples; ++k) {
    const glm::vec2 point{
        static_cast<float>(x) + (static_cast<float>(k % samples) + 0.5F) / samples,
        static_cast<float>(y) + (static_cast<float>(k / samples) + 0.5F) / samples};
    hits += std::any_of(house.faces.begin(), house.faces.end(),
                        [&](const HouseFace& face) { return is_inside(face, point); })
                ? 1
                : 0;
  }
  return static_cast<float>(hits) / (samples * samples);
}

}  // namespace

Grid<MattePixel> make_feature_matte(const DrawnFeatures& features, const Grid<float>& depth_m,
                                    PixelRect rect, const Grid<std::int16_t>* crest_rows) {
  Grid<MattePixel> matte(rect.width(), rect.height());
  if (features.empty()) return matte;
  visit_coats(features, depth_m, rect, crest_rows, [&](int kind, int x, int y, float share) {
    cover(matte(x - rect.x0, y - rect.y0), kind, share);
  });
  for (const std::uint32_t number : features.houses_at(rect)) {
    const DrawnHouse& house = features.houses[number];
    const auto low = [&](float at) { return static_cast<int>(std::floor(at - house.reach_px)); };
    const auto high = [&](float at) { return static_cast<int>(std::ceil(at + house.reach_px)); };
    const PixelRect around = intersection(
        {low(house.foot.x), low(house.foot.y), high(house.foot.x), high(house.foot.y)}, rect);
    for (int y = around.y0; y < around.y1; ++y)
      for (int x = around.x0; x < around.x1; ++x) {
        const bool hidden =
            depth_m(x - rect.x0, y - rect.y0) < house.distance_m * (1.F - hides_house);
        const float share = hidden ? 0.F : share_of(house, x, y);
        if (share > 0.F) cover(matte(x - rect.x0, y - rect.y0), house.kind, share);
      }
  }
  return matte;
}

}  // namespace belvedere
