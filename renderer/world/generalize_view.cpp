#include "renderer/world/generalize_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/pyramid.h"
#include "base/statistics.h"
#include "renderer/ground/cached_products.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "terrain/cover/map_cover.h"
#include "terrain/generalize/line_integral_generalize.h"
#include "terrain/generalize/mask.h"
#include "terrain/io/dem_levels.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

void each_field(auto& bytes, FieldsOf<GeneralizedTerrain> auto& ground) {
  auto& [altitude_m, came_from, goes_to] = ground;
  bytes(altitude_m, came_from, goes_to);
}

namespace {

// The camera is sampled at every nth cell, because its values change slowly.
constexpr int step_cells = 16;

// The share u_d of equation 5 of Jenny, Jenny & Hurni 2011.
Grid<float> share_by_distance(const Dem& dem, glm::dvec2 viewer_xy,
                              const GeneralizeDistances& distances) {
  Grid<float> share(dem.width(), dem.height());
  const double far_m = std::max(distances.background_from_m, distances.foreground_to_m + 1.0);
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x) {
      const glm::dvec2 position = dem.transform.to_crs(x, y);
      const double distance = exact::hypot(position.x - viewer_xy.x, position.y - viewer_xy.y);
      share(x, y) =
          static_cast<float>(foreground_share(distance, distances.foreground_to_m, far_m));
    }
  });
  return share;
}

// The mask by slope, and the drawn one.
Grid<float> mask_of_ground(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  const SceneGeneralize& settings = loaded.scene.generalize;
  const glm::dvec2 cell_m{dem.transform.cell_x, dem.transform.cell_y};
  Grid<float> mask;
  if (settings.mask_slope_deg[1] > 0.0)
    mask = slope_mask(dem.altitude_m, cell_m,
                      {settings.mask_slope_deg[0], settings.mask_slope_deg[1]});
  if (!settings.mask.empty()) {
    RasterSource source;
    source.path = find_scene_file(loaded, settings.mask);
    mask =
        combine_masks(std::move(mask),
                      soften_mask(read_mask(
                          source, {dem.transform, dem.width(), dem.height(), dem.crs}, progress)));
  }
  return mask;
}

// Multiplies the mask by that of the classes, if the scene masks by class.
Grid<float> mask_for_scene(Grid<float> mask, const LoadedScene& loaded, const Dem& dem,
                           const LandCover* land_cover, Progress& progress, const Cache& cache) {
  const SceneGeneralize& settings = loaded.scene.generalize;
  if (settings.mask_classes.empty()) return mask;
  GeneralizedShares shares;
  shares.fill(1.F);
  for (const auto& [name, share] : settings.mask_classes)
    shares[static_cast<std::size_t>(*find_class(name))] = static_cast<float>(share);
  const LandCover made =
      land_cover == nullptr ? make_scene_land_cover(loaded, dem, progress, cache) : LandCover();
  return combine_masks(
      std::move(mask),
      soften_mask(class_mask((land_cover == nullptr ? made : *land_cover).classes.cells, shares)));
}

// Inputs of the generalized ground from scene and view, besides the DEM; cheap compared with the
// ground itself.
struct ViewOfGround {
  Grid<float> mask;
  PixelGround pixel_ground;  // empty where the print's detail is not limited
  glm::dvec2 viewer_xy{0.0};
  GeneralizeDistances distances;
  Grid<std::uint8_t> map_lakes;  // 1 in level lakes of a map, however small; empty without
};

// Where water keeps its level: on lakes, at sea.
Grid<unsigned char> level_water(const Dem& dem, const SeaParameters& sea,
                                const Grid<std::uint8_t>& map_lakes) {
  Grid<unsigned char> water = find_lakes(dem.altitude_m, {});
  for (std::size_t i = 0; i < map_lakes.size(); ++i)
    water[i] = static_cast<unsigned char>(water[i] | map_lakes[i]);
  const Sea found = find_sea(dem, sea);
  if (!found.empty())
    for (std::size_t i = 0; i < water.size(); ++i)
      water[i] = static_cast<unsigned char>(water[i] | found.mask[i]);
  return water;
}

// Cells of a map's lakes whose neighbours are at the same altitude.
Grid<std::uint8_t> lakes_of_map(const Dem& dem, const MapCover* areas) {
  if (areas == nullptr) return {};
  const Grid<float>& z = dem.altitude_m;
  Grid<std::uint8_t> lakes(z.width(), z.height(), 0);
  parallel_rows(z.height(), [&](int y) {
    for (int x = 0; x < z.width(); ++x) {
      if (!areas->is_still(dem.transform.to_crs(x, y))) continue;
      int level = 0;
      for (const glm::ivec2 step :
           {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)})
        level += z.clamped(x + step.x, y + step.y) == z(x, y) ? 1 : 0;
      lakes(x, y) = level >= 2 ? 1 : 0;
    }
  });
  return lakes;
}

// All but the mask, which is given.
GroundMasks find_masks(const SceneGeneralize& settings, const SeaParameters& sea, const Dem& dem,
                       const Grid<float>& mask, const Grid<std::uint8_t>& map_lakes,
                       Progress& progress) {
  GroundMasks out;
  // First, because it needs the most memory.
  if (settings.line_integral)
    out.along_lines_m =
        generalize_along_slope_lines(dem.altitude_m, mask, dem.cell_m(), {}, progress);
  if (settings.automatic_mask)
    out.amplify = slope_foot_mask(dem.altitude_m, {dem.transform.cell_x, dem.transform.cell_y},
                                  1 << std::min<std::size_t>(settings.bands.foreground.size(), 6));
  if (settings.keep_lakes) out.keep = level_water(dem, sea, map_lakes);
  return out;
}

GeneralizedTerrain make_ground(const SceneGeneralize& settings, const SeaParameters& sea,
                               const Dem& dem, const ViewOfGround& seen, const GroundMasks* known,
                               Progress& progress) {
  const glm::dvec2 cell_m{dem.transform.cell_x, dem.transform.cell_y};
  GeneralizeParameters bands = settings.bands;
  bands.finest_band = dem.halved;
  GroundMasks masks = known != nullptr
                          ? *known
                          : find_masks(settings, sea, dem, seen.mask, seen.map_lakes, progress);
  GeneralizeGrids grids;
  grids.amplification_mask = std::move(masks.amplify);
  grids.keep = std::move(masks.keep);
  grids.unchanged = std::move(masks.unchanged);
  grids.finer_m = std::move(masks.finer_m);
  grids.mask = seen.mask;
  grids.pixel_ground = seen.pixel_ground;
  if (settings.print_detail_px > 0.0)
    bands.print_pixels = static_cast<float>(settings.print_detail_px);
  grids.foreground_share = share_by_distance(dem, seen.viewer_xy, seen.distances);
  Grid<float> out = generalize(settings.line_integral ? masks.along_lines_m : dem.altitude_m,
                               cell_m, grids, bands, progress);
  masks = {};
  const Grid<unsigned char> lakes = std::move(grids.keep);
  grids = {};
  if (settings.valleys.width_m <= 0.F) return {std::move(out), {}, {}};
  WidenedValleys wide =
      widen_valleys(out, lakes, seen.mask, dem.cell_m(), settings.valleys, progress, dem.halved);
  return {std::move(wide.altitude_m), std::move(wide.came_from), std::move(wide.goes_to)};
}

// All inputs of make_ground. Every key of [generalize] counts, as written by a scene with nothing
// else in it, so that none can be forgotten.
CacheKey ground_key(const LoadedScene& loaded, const Dem& dem, const SeaParameters& sea,
                    const ViewOfGround& seen, bool by_data) {
  Scene settings;
  settings.generalize = loaded.scene.generalize;
  const auto& [mask, pixel_ground, viewer_xy, distances, map_lakes] = seen;
  settings.generalize.foreground_to_m = distances.foreground_to_m;
  settings.generalize.background_from_m = distances.background_from_m;
  const auto& [m_per_pixel, step] = pixel_ground;
  CacheKeyText key;
  key.add("settings", write_scene(settings)).add("mask", mask).add("viewer", viewer_xy);
  if (!map_lakes.empty()) key.add("lakes", map_lakes);
  if (by_data) key.add("masks", "of the data");
  key.add("m_per_pixel", m_per_pixel).add("step_cells", step);
  add_sea(key, sea);
  add_dem(key, dem);
  return make_cache_key(CachedProduct::generalized_ground, key, subject_of(loaded));
}

}  // namespace

// The larger singular value of the map from ground to picture, by central differences.
double pixels_per_m(const Camera& camera, const Deformation& deformation, glm::dvec2 position,
                    double altitude_m, double step_m) {
  const auto seen = [&](double east, double north) {
    return camera.project(deformation.point({position + glm::dvec2(east, north), altitude_m}));
  };
  const auto east = seen(step_m, 0.0);
  const auto west = seen(-step_m, 0.0);
  const auto north = seen(0.0, step_m);
  const auto south = seen(0.0, -step_m);
  if (!east || !west || !north || !south) return 0.0;
  const glm::dvec2 a = (*east - *west) / (2.0 * step_m);
  const glm::dvec2 b = (*north - *south) / (2.0 * step_m);
  const double half_trace = 0.5 * (glm::dot(a, a) + glm::dot(b, b));
  const double determinant = a.x * b.y - a.y * b.x;
  const double square =
      half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - determinant * determinant));
  return std::isfinite(square) ? std::sqrt(square) : 0.0;
}

PixelGround ground_m_per_pixel(const Dem& dem, const View& view) {
  const std::unique_ptr<Camera> camera = make_camera(view.camera);
  const Deformation deformation(view.deform, view.viewer_xy);
  Grid<float> coarse((dem.width() - 1) / step_cells + 2, (dem.height() - 1) / step_cells + 2);
  Grid<float> distance_m(coarse.width(), coarse.height());
  parallel_rows(coarse.height(), [&](int y) {
    for (int x = 0; x < coarse.width(); ++x) {
      const glm::dvec2 position = dem.transform.to_crs(x * step_cells, y * step_cells);
      const double altitude = dem.altitude_m.clamped(x * step_cells, y * step_cells);
      const double pixels = pixels_per_m(*camera, deformation, position, altitude, dem.cell_m());
      coarse(x, y) = pixels > 0.0 ? static_cast<float>(1.0 / pixels) : 0.F;
      distance_m(x, y) = static_cast<float>(
          std::max(1.0, glm::length(deformation.point({position, altitude}) - view.camera.eye)));
    }
  });
  // Angle of a pixel, for extrapolation behind the viewer.
  std::vector<float> angles;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    if (coarse[i] > 0.F) angles.push_back(coarse[i] / distance_m[i]);
  if (angles.empty()) return {};
  const float centre = middle_value(std::move(angles));
  for (std::size_t i = 0; i < coarse.size(); ++i)
    if (coarse[i] == 0.F) coarse[i] = centre * distance_m[i];
  return {std::move(coarse), step_cells};
}

namespace {

// Cells of a level under which one of the data is marked.
Grid<std::uint8_t> any_below(const Grid<std::uint8_t>& marked, int level) {
  Grid<std::uint8_t> out(level_cells(marked.width(), level), level_cells(marked.height(), level));
  const int half = (1 << level) / 2;
  for (int y = 0; y < marked.height(); ++y)
    for (int x = 0; x < marked.width(); ++x)
      if (marked(x, y) != 0)
        out(std::min((x + half) >> level, out.width() - 1),
            std::min((y + half) >> level, out.height() - 1)) = 1;
  return out;
}

}  // namespace

GroundMasks preview_masks(const LoadedScene& loaded, const Dem& data, int level,
                          const MapCover* areas, Progress& progress) {
  Grid<float> mask = mask_of_ground(loaded, data, progress);
  GroundMasks masks = find_masks(loaded.scene.generalize, scene_sea(loaded.scene.land_cover), data,
                                 mask, lakes_of_map(data, areas), progress);
  masks.mask = std::move(mask);
  if (data.halved == 0) {  // else the finest bands are not known
    const Grid<float>& z = masks.along_lines_m.empty() ? data.altitude_m : masks.along_lines_m;
    masks.finer_m = finer_bands(z, level);
  }
  if (!masks.mask.empty()) masks.unchanged = any_below(unchanged_cells({}, masks.mask), level);
  const auto unit = [](Grid<float> grid) {
    for (float& v : grid) v = std::clamp(v, 0.F, 1.F);  // borders are extended linearly
    return grid;
  };
  for (int i = 0; i < level; ++i) {
    masks.mask = unit(reduce(masks.mask));
    masks.amplify = unit(reduce(masks.amplify));
    masks.along_lines_m = reduce(masks.along_lines_m);
  }
  if (!masks.keep.empty()) {
    Grid<float> share(masks.keep.width(), masks.keep.height());
    std::transform(masks.keep.begin(), masks.keep.end(), share.begin(),
                   [](std::uint8_t keep) { return keep != 0 ? 1.F : 0.F; });
    for (int i = 0; i < level; ++i) share = reduce(share);
    masks.keep = Grid<std::uint8_t>(share.width(), share.height());
    std::transform(share.begin(), share.end(), masks.keep.begin(),
                   [](float part) { return static_cast<std::uint8_t>(part >= 0.5F ? 1 : 0); });
  }
  return masks;
}

GeneralizedTerrain generalize_for_view(const LoadedScene& loaded, const Dem& dem,
                                       const LandCover* land_cover, const View& view,
                                       Progress& progress, const Cache& cache,
                                       const GroundGiven& given) {
  const SeaParameters sea = given.sea != nullptr ? *given.sea : scene_sea(loaded.scene.land_cover);
  const GroundMasks* masks = given.masks;
  const MapCover* areas = land_cover != nullptr ? land_cover->map.get() : given.areas;
  const SceneGeneralize& settings = loaded.scene.generalize;
  ViewOfGround seen{
      .mask = mask_for_scene(masks != nullptr ? masks->mask : mask_of_ground(loaded, dem, progress),
                             loaded, dem, land_cover, progress, cache),
      .pixel_ground = {},
      .viewer_xy = view.viewer_xy,
      .distances = view.generalize,
      .map_lakes = masks != nullptr ? Grid<std::uint8_t>() : lakes_of_map(dem, areas)};
  if (settings.print_detail_px > 0.0) seen.pixel_ground = ground_m_per_pixel(dem, view);
  return cached<GeneralizedTerrain>(
      cache, [&] { return ground_key(loaded, dem, sea, seen, masks != nullptr); }, progress,
      [&](Progress& watcher) { return make_ground(settings, sea, dem, seen, masks, watcher); });
}

}  // namespace belvedere
