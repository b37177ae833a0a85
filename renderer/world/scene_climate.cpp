#include "renderer/world/scene_climate.h"

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/math_exact.h"

namespace belvedere {

bool names_climate(const Scene& scene) { return scene.climate != SceneClimate{}; }

ClimateColumn plain_climate(glm::dvec2 lonlat_deg) {
  const double latitude = lonlat_deg.y;
  ClimateColumn column;
  for (std::size_t m = 0; m < column.sea_level_c.size(); ++m) {
    // July is the warmest month of the north, January of the south.
    const double course = exact::cos(2.0 * std::numbers::pi * (static_cast<double>(m) - 6.0) / 12.0);
    column.sea_level_c[m] = 27.0 - 0.0082 * latitude * latitude + 0.14 * latitude * course;
    column.lapse_k_per_km[m] = 5.6;
  }
  column.rain_mm_at_km.fill(1000.0);
  return column;
}

Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, const DefaultClimate& fallback, Progress& progress) {
  const SceneClimate& settings = loaded.scene.climate;
  if (dem.crs.empty() && !settings.latitude_deg)
    throw Error(ErrorKind::usage, "climate.latitude_deg", "a terrain without coordinate system does not say how far north it lies",
                "its latitude, -90 … 90");
  const auto raster = [&](const std::string& file) -> std::optional<RasterSource> {
    if (file.empty()) return {};
    RasterSource source;
    source.path = find_scene_file(loaded, file);
    return source;
  };
  ClimateParameters parameters;
  if (!settings.stations.empty()) parameters.stations = find_scene_file(loaded, settings.stations);
  parameters.temperature = raster(settings.temperature);
  parameters.temperature_factor = settings.temperature_factor;
  parameters.rain = raster(settings.rain);
  parameters.lapse_k_per_km = settings.lapse_k_per_km;
  parameters.wind_from_deg = settings.wind_from_deg;
  parameters.latitude_deg = settings.latitude_deg;
  return make_climate(dem, parameters, fallback, progress);
}

Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  return make_scene_climate(loaded, dem, plain_climate, progress);
}

}  // namespace belvedere
