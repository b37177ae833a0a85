#include "renderer/stages/sheet_style.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/statistics.h"
#include "renderer/trace/camera.h"
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
  sight.near_m = std::max<double>(1.0, value_at_share(distances, left_out));
  sight.far_m = std::max<double>(1.001 * sight.near_m, value_at_share(distances, 1.0 - left_out));
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

namespace {

constexpr double max_pixels_per_unit = 1.3;
constexpr int band_px = 256;  // rows traced together: most channels are not kept

template <class T>
void put_rows(Grid<T>& into, int first_row, const Grid<T>& rows) {
  std::copy(rows.begin(), rows.end(), into.row(first_row));
}

bool has_ice(const LandCover& land_cover) {
  return std::any_of(land_cover.classes.cells.begin(), land_cover.classes.cells.end(),
                     [](LandCoverClass id) { return has_trait(id, ClassTrait::icy); });
}

// In the terrain or a window of it, whose finer cells may have smaller glaciers.
bool has_ice(const TerrainModel& terrain) {
  return has_ice(*terrain.land_cover) || std::any_of(terrain.windows.begin(), terrain.windows.end(),
                                                     [](const TerrainWindow& window) {
                                                       return has_ice(*window.ground.land_cover);
                                                     });
}

// The channels that a plan needs, for the whole sheet as a camera shows it: one ray per pixel,
// without light.
GuidanceBuffers look_at(const World& world, const Camera& camera, const Run& run) {
  const glm::ivec2 size = camera.size();
  GuidanceBuffers seen;
  seen.origin_m = world.surface->origin;
  seen.depth_m = seen.slope_deg = seen.relief_s_m = Grid<float>(size.x, size.y);
  seen.land_cover = Grid<LandCoverClass>(size.x, size.y);
  seen.fall_line = Grid<glm::vec2>(size.x, size.y);
  seen.position_m = Grid<glm::vec3>(size.x, size.y);
  seen.footprint_m = Grid<float>(size.x, size.y);
  for (int y = 0; y < size.y; y += band_px) {
    const PixelRect band{0, y, size.x, std::min(y + band_px, size.y)};
    const GuidanceBuffers rows = trace_forms(world, camera, band, run);
    put_rows(seen.depth_m, y, rows.depth_m);
    put_rows(seen.slope_deg, y, rows.slope_deg);
    put_rows(seen.relief_s_m, y, rows.relief_s_m);
    put_rows(seen.land_cover, y, rows.land_cover);
    put_rows(seen.fall_line, y, rows.fall_line);
    put_rows(seen.position_m, y, rows.position_m);
    put_rows(seen.footprint_m, y, rows.footprint_m);
  }
  return seen;
}

}  // namespace

IcePlan make_ice_plan(const World& world, const Run& run) {
  if (!has_ice(world.terrain)) return {};
  int factor = 1;
  while (world.scene.pixels_per_unit() / factor > max_pixels_per_unit) factor *= 2;
  const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
  StrokeParameters parameters;
  parameters.pixels_per_unit = world.scene.pixels_per_unit() / factor;
  parameters.seed = world.scene.seed;
  return plan_ice(look_at(world, *camera, run), parameters);
}

}  // namespace belvedere
