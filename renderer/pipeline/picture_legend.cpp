#include "renderer/pipeline/picture_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "renderer/trace/camera_reduced.h"
#include "renderer/trace/class_view.h"

namespace belvedere {
namespace {

constexpr int looked_px = 600;         // width of the small picture
constexpr double least_share = 0.001;  // of its ground
constexpr double swatch_tone = 0.72;   // light, not glaring
constexpr int places_a_side = 240;     // at which altitudes are asked

std::string hex(glm::vec3 colour) {
  const auto byte = [](float value) { return static_cast<int>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F))); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.r), byte(colour.g), byte(colour.b));
}

}  // namespace

std::vector<LegendEntry> find_legend(const World& world, const Palette& palette) {
  const int factor = std::max(1, world.scene.output.width / looked_px);
  const std::unique_ptr<const Camera> camera = make_reduced_camera(*world.camera, factor);
  std::array<std::size_t, land_cover_class_count> seen{};
  std::size_t ground = 0;
  for (const LandCoverClass id : trace_classes(world.terrain, world.tracer, *camera)) {
    if (id == LandCoverClass::sky) continue;
    ++seen[static_cast<std::size_t>(id)];
    ++ground;
  }
  std::array<double, land_cover_class_count> altitude_m{};
  std::array<double, land_cover_class_count> places{};
  const Dem& dem = *world.dem;
  for (int j = 0; j < places_a_side; ++j)
    for (int i = 0; i < places_a_side; ++i) {
      const int x = static_cast<int>((i + .5) * dem.width() / places_a_side);
      const int y = static_cast<int>((j + .5) * dem.height() / places_a_side);
      const glm::dvec2 place = dem.transform.to_crs(x, y);
      const auto id = static_cast<std::size_t>(world.land_cover->at(place.x, place.y));
      altitude_m[id] += static_cast<double>(dem.altitude_m(x, y));
      places[id] += 1.0;
    }
  std::vector<LegendEntry> legend;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const auto id = static_cast<std::size_t>(info.id);
    if (info.id == LandCoverClass::sky || static_cast<double>(seen[id]) < least_share * static_cast<double>(ground) || seen[id] == 0)
      continue;
    std::string name(info.name);
    std::replace(name.begin(), name.end(), '_', ' ');
    const double mean_m = places[id] > 0.0 ? altitude_m[id] / places[id] : 1000.0;
    legend.push_back({name, hex(palette_colour(palette, info.id, mean_m, swatch_tone))});
  }
  return legend;
}

}  // namespace belvedere
