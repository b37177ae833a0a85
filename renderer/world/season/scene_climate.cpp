#include "renderer/world/season/scene_climate.h"

#include "base/error.h"
#include "terrain/climate/default_climate.h"

namespace belvedere {

bool names_climate(const Scene& scene) { return scene.climate != SceneClimate{}; }

bool knows_place(const Scene& scene, const Dem& dem) {
  return !dem.crs.empty() || scene.climate.latitude_deg.has_value();
}

void require_place(const Scene& scene, const Dem& dem) {
  if (!knows_place(scene, dem))
    throw Error(ErrorKind::usage, "climate.latitude_deg",
                "a terrain without coordinate system has no known latitude",
                "its latitude, -90 … 90");
}

Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  const SceneClimate& settings = loaded.scene.climate;
  require_place(loaded.scene, dem);
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
  parameters.rain_factor = settings.rain_factor;
  parameters.lapse_k_per_km = settings.lapse_k_per_km;
  parameters.wind_from_deg = settings.wind_from_deg;
  parameters.latitude_deg = settings.latitude_deg;
  return make_climate(
      dem, parameters,
      [](glm::dvec2 lonlat_deg) { return default_climate(lonlat_deg.x, lonlat_deg.y); }, progress);
}

}  // namespace belvedere
