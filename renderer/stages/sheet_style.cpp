#include "renderer/stages/sheet_style.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/trace/camera_reduced.h"
#include "renderer/world/picture_parameters.h"

namespace belvedere {
namespace {

constexpr int look_width_px = 400;
constexpr double left_out = 0.03;  // share of the ground ignored at both ends of its distances

StyleSight look_at_sheet(const World& world, const Camera& camera, const Run& run) {
  const int factor = std::max(1, camera.size().x / look_width_px);
  const std::unique_ptr<const Camera> reduced = make_reduced_camera(camera, factor);
  const glm::ivec2 size = reduced->size();
  return style_sight_of(trace_forms(world, *reduced, {0, 0, size.x, size.y}, run).depth_m, factor);
}

}  // namespace

StyleSight style_sight_of(const Grid<float>& depth_m, int scale) {
  StyleSight sight;
  std::vector<float> distances;
  for (int y = 0; y < depth_m.height(); ++y)
    for (int x = 0; x < depth_m.width(); ++x) {
      const float depth = depth_m(x, y);
      if (std::isinf(depth))
        sight.sky_rows = (y + 1) * scale;
      else
        distances.push_back(depth);
    }
  if (distances.empty()) return sight;
  const auto at = [&](double share) {
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(
                                                share * static_cast<double>(distances.size() - 1));
    std::nth_element(distances.begin(), middle, distances.end());
    return static_cast<double>(*middle);
  };
  sight.near_m = std::max(1.0, at(left_out));
  sight.far_m = std::max(1.001 * sight.near_m, at(1.0 - left_out));
  return sight;
}

StylePaintParameters SheetStyle::seen() const {
  StylePaintParameters out = parameters;
  if (sight == nullptr) return out;
  const StyleSight& seen = sight->get();
  out.sky_rows = std::min(seen.sky_rows, out.sheet_px.y);
  out.near_m = seen.near_m;
  out.far_m = seen.far_m;
  return out;
}

std::shared_ptr<const SheetStyle> make_sheet_style(const Style& style,
                                                   const StylePaintParameters& parameters,
                                                   const World& world, const Camera& camera,
                                                   const Run& run) {
  return std::make_shared<const SheetStyle>(SheetStyle{
      style, parameters, std::make_shared<const LazyValue<StyleSight>>([&world, &camera, run] {
        return look_at_sheet(world, camera, run);
      })});
}

}  // namespace belvedere
