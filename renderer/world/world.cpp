#include "renderer/world/world.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/instruction_set.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "renderer/ground/cached_products.h"
#include "renderer/ground/scene_ground_map.h"
#include "renderer/image/provenance.h"
#include "renderer/paint/sky.h"
#include "renderer/scene/scene_lock.h"
#include "renderer/scene/scene_table.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/ground_windows.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/scene_light.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/scene_style.h"
#include "renderer/world/scene_values.h"
#include "renderer/world/viewer_check.h"
#include "terrain/climate/map_position.h"
#include "terrain/cover/map_cover.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

MistParameters to_parameters(const SceneMist& given, const Dem& dem, std::size_t number) {
  MistParameters mist = given.look;
  mist.kind = given.kind == "valley" ? MistKind::valley
              : given.kind == "lee"  ? MistKind::lee
                                     : MistKind::sea;
  mist.to_m = given.to_m.value_or(mist.to_m);
  const bool thin = mist.kind == MistKind::valley;
  mist.visibility_m = given.visibility_m.value_or(thin ? 500.0 : mist.visibility_m);
  mist.patches = given.patches.value_or(thin ? 0.35 : mist.patches);
  if (given.position || given.position_lonlat)
    mist.position = resolve_place(dem, given.position, given.position_lonlat,
                                  fmt::format("air.mist.{}", number));
  return mist;
}

}  // namespace

MistAir make_scene_mist(const Scene& scene, const View& view, const TerrainModel& terrain,
                        const Deformation& deformation, const Camera& camera) {
  MistAir air;
  if (scene.air.mist.empty()) return air;
  const Dem& dem = *terrain.dem;
  air.seed = scene.seed;
  air.rim_fade_m = view.air.rim_fade_m;
  bool floors = false;
  for (std::size_t k = 0; k < scene.air.mist.size(); ++k) {
    const MistParameters mist = to_parameters(scene.air.mist[k], dem, k);
    if (mist.kind == MistKind::lee) {
      const glm::dvec2 cell = dem.transform.to_cell(mist.position->x, mist.position->y);
      const double ground_m = sample_bilinear(terrain.generalized_m, cell.x, cell.y);
      const std::optional<LeeCloud> cloud = make_lee_cloud(
          mist, ground_m, deformation, camera, stream_seed(scene.seed, Stream::mist_layers, k));
      if (cloud) air.clouds.push_back(*cloud);
      continue;
    }
    floors = floors || mist.kind == MistKind::valley;
    air.layers.push_back(mist);
  }
  if (air.layers.empty()) return air;
  air.ground = make_mist_ground(terrain.generalized_m, terrain.rim_m, dem.transform, floors);
  const double right = dem.width() - 1.0;
  const double bottom = dem.height() - 1.0;
  for (const glm::dvec2 corner : {glm::dvec2(0.0), glm::dvec2(right, 0.0), glm::dvec2(0.0, bottom),
                                  glm::dvec2(right, bottom)}) {
    const glm::dvec2 position = dem.transform.to_crs(corner.x, corner.y);
    air.farthest_m =
        std::max(air.farthest_m, glm::length(deformation.point({position, 0.0}) - camera.eye()));
  }
  return air;
}

void each_field(auto& bytes, FieldsOf<FloorPlan> auto& plan) {
  auto& [built, grain] = plan;
  bytes(built, grain);
}

void each_field(auto& bytes, FieldsOf<GroundSurroundings> auto& surroundings) {
  auto& [valley_height_m, rim_m, flow, floor_plan] = surroundings;
  bytes(valley_height_m, rim_m, flow, floor_plan);
}

namespace {

constexpr double usual_horizon =
    0.18;  // of the picture's height from its top, where no terrain meets the sky

// Null for a DEM that was given: its own reduced copy is sufficient.
const CoarseAltitudes* region_of(const SceneDem& opened) {
  return opened.region.blocks.cells.empty() ? nullptr : &opened.region;
}

CacheKey surroundings_key(const LoadedScene& loaded, const Dem& dem, const LandCover& land_cover) {
  const auto& [origin_x, origin_y, cell_x, cell_y] = land_cover.classes.transform;
  CacheKeyText key;
  key.add("classes", land_cover.classes.cells)
      .add("classes_x", origin_x)
      .add("classes_y", origin_y);
  key.add("classes_cell_x", cell_x).add("classes_cell_y", cell_y);
  add_dem(key, dem);
  return make_cache_key(CachedProduct::ground_surroundings, key, subject_of(loaded));
}

// The parts of the scene that each value reads.

void reads_of_dem(Scene& to, const Scene& from) {
  to.terrain = from.terrain;
  to.land_cover.sea = from.land_cover.sea;
  to.land_cover.sea_level_m = from.land_cover.sea_level_m;
  to.generalize.destripe = from.generalize.destripe;
  to.features_style = from.features_style;
  to.features = from.features;
}

// Also reads whether the palette is one of winter, which lays snow.
void reads_of_cover(Scene& to, const Scene& from, bool winter) {
  to.seed = from.seed;
  to.land_cover = from.land_cover;
  to.season = from.season;
  to.climate = from.climate;
  to.features_style = from.features_style;
  to.features = from.features;
  to.palette = winter ? "winter" : "summer";
}

// Reads what lines and strips over the classes depend on, for a camera.
void reads_of_lines(Scene& to, const Scene& from) {
  to.seed = from.seed;
  to.features_style = from.features_style;
  to.features = from.features;
  to.output = from.output;
  to.terrain.preview_mcells = from.terrain.preview_mcells;
}

void reads_of_masks(Scene& to, const Scene& from) {
  to.land_cover.sea = from.land_cover.sea;
  to.land_cover.sea_level_m = from.land_cover.sea_level_m;
  to.generalize.mask = from.generalize.mask;
  to.generalize.mask_slope_deg = from.generalize.mask_slope_deg;
  to.generalize.automatic_mask = from.generalize.automatic_mask;
  to.generalize.keep_lakes = from.generalize.keep_lakes;
  to.generalize.line_integral = from.generalize.line_integral;
  to.generalize.bands.foreground.assign(from.generalize.bands.foreground.size(), 1.F);
}

void reads_of_generalized(Scene& to, const Scene& from) {
  to.land_cover.sea = from.land_cover.sea;
  to.land_cover.sea_level_m = from.land_cover.sea_level_m;
  to.generalize = from.generalize;
}

void reads_everything(Scene& to, const Scene& from) { to = from; }

// 1 where the noon sun is in the south, -1 in the north. Where the latitude is not known, the
// northern hemisphere is assumed.
double find_sunny_side(const Scene& scene, const Dem& dem) {
  if (!knows_place(scene, dem)) return 1.0;
  const MapPosition position = make_map_position(dem.transform, dem.crs, dem.width(), dem.height(),
                                                 scene.climate.latitude_deg);
  return position.centre_lonlat_deg().y < 0.0 ? -1.0 : 1.0;
}

}  // namespace

World make_world(const LoadedScene& loaded, Progress& progress, const Cache& cache,
                 KnownTerrain known, ValueStore* store) {
  const Scene& scene = loaded.scene;
  const SceneValues values(loaded, store, progress);
  // Missing instruction sets are reported before the work.
  in_section("sampling", [&] { return choose_instruction_set(scene.tracing.instruction_set); });

  // The ground as measured; the levels of a DEM larger than memory stay for its windows.
  const Value<SceneDem> opened =
      known.dem ? Value<SceneDem>{{}, std::make_shared<SceneDem>()}
                : values.make<SceneDem>("dem", reads_of_dem, {}, [&](const Making& m) {
                    return open_scene_dem(m.scene, m.progress, cache);
                  });
  const std::shared_ptr<const Dem> dem =
      known.dem ? std::move(known.dem) : std::shared_ptr<const Dem>(opened.value, &opened->dem);

  // Viewer and light.
  const View view =
      make_view(scene, *dem, progress, ground_altitude_of(*opened), region_of(*opened));
  std::unique_ptr<const Camera> camera = make_camera(view.camera);
  std::shared_ptr<const LightField> light_field = make_light_field(loaded, *dem, view, progress);
  const Deformation deformation(view.deform, view.viewer_xy);
  const SeenFrom seen{*camera, deformation};
  const ValueInput of_camera = content_of(view.camera);
  const ValueInput of_deform = content_of(view.deform, view.viewer_xy);

  // Land cover. Class rules and the terrain's model both need the drainage: it is computed once.
  std::unique_ptr<Catchments> catchments = std::move(known.catchments);
  if (!known.land_cover && !catchments) catchments = std::make_unique<Catchments>(*dem);
  Value<LandCover> bare;
  Value<const LandCover> drawn{{}, known.land_cover};
  if (!known.land_cover) {
    const bool winter = named_palette(loaded).winter;
    bare = values.make<LandCover>(
        "classes", [winter](Scene& to, const Scene& from) { reads_of_cover(to, from, winter); },
        {opened},
        [&](const Making& m) {
          return make_bare_patches(m.scene, *dem, m.progress, cache, catchments.get()).cover;
        });
    // Rivers are drawn for a camera; the cells do not depend on it.
    const bool has_lines = scene.any_features() || !bare->inferred_rivers.empty();
    drawn = values.make<const LandCover>(
        "land cover", has_lines ? SceneValues::Reads(reads_of_lines) : reads_nothing,
        has_lines ? std::vector<ValueInput>{bare, of_camera, of_deform}
                  : std::vector<ValueInput>{bare},
        [&](const Making& m) {
          LandCover cover = values.keeps() ? *bare : std::move(*bare);
          lay_ground_map(cover, m.scene, *dem, m.progress, cache, catchments.get(), &seen);
          return cover;
        });
  }
  const std::shared_ptr<const LandCover> land_cover = drawn.value;

  // The ground for this view. Classes change it only if it is masked by them, and the camera only
  // if the print's detail is limited.
  std::vector<ValueInput> of_shape = {opened, content_of(view.generalize, view.viewer_xy)};
  if (!scene.generalize.mask_classes.empty()) of_shape.push_back(bare);
  View of_viewer;
  of_viewer.viewer_xy = view.viewer_xy;
  of_viewer.generalize = view.generalize;
  if (scene.generalize.print_detail_px > 0.0) {
    of_shape.insert(of_shape.end(), {of_camera, of_deform});
    of_viewer = view;
  }
  const auto generalized = values.make<GeneralizedTerrain>(
      "generalized", reads_of_generalized, of_shape, [&](const Making& m) {
        Value<const GroundMasks> masks;
        if (opened->data)
          masks = values.make_with<const GroundMasks>(
              "masks", reads_of_masks, {opened}, m.progress, [&](const Making& n) {
                return preview_masks(n.scene, *opened->data, dem->halved - opened->data->halved,
                                     land_cover->map.get(), n.progress);
              });
        // Files of every position of a slider would crowd out those of prints.
        const Cache& kept = opened->data && values.keeps() ? no_cache() : cache;
        if (!values.keeps()) opened->data.reset();
        return generalize_for_view(m.scene, *dem, land_cover.get(), of_viewer, m.progress, kept,
                                   {.masks = masks.value.get()});
      });

  // All that a pixel may need of it, with finer windows where the DEM is larger than memory.
  const bool has_windows = opened->levels != nullptr;
  const std::optional<Deformation> local =
      deformation.is_local() ? std::optional(deformation) : std::nullopt;
  std::vector<ValueInput> of_terrain = {generalized, bare};
  if (has_windows) of_terrain.insert(of_terrain.end(), {opened, of_camera, of_deform});
  const auto terrain = values.make<TerrainModel>(
      "terrain", has_windows ? reads_everything : reads_nothing, of_terrain, [&](const Making& m) {
        const auto surroundings = values.make_with<GroundSurroundings>(
            "surroundings", reads_nothing, {opened, bare}, m.progress, [&](const Making& n) {
              return cached<GroundSurroundings>(
                  cache, [&] { return surroundings_key(n.scene, *dem, *land_cover); }, n.progress,
                  [&](Progress&) {
                    return find_surroundings(*dem, *land_cover, catchments.get());
                  });
            });
        const auto take = [&](auto& value) { return values.keeps() ? value : std::move(value); };
        TerrainModel made = make_terrain_model(dem, take(generalized->altitude_m), land_cover,
                                               view.deform.exaggeration, take(*surroundings));
        made.came_from = take(generalized->came_from);
        made.goes_to = take(generalized->goes_to);
        made.local = local;
        if (has_windows) {
          const RasterFrame& frame = opened->levels->frame();
          const GroundPlan plan = plan_ground(frame, *dem, view, opened->max_cells);
          m.progress.note(describe(plan, frame));
          add_ground_windows(
              made, plan,
              {m.scene, view, deformation, opened->sea, *opened->levels, m.progress, cache, seen});
          if (!values.keeps()) opened->levels.reset();  // no longer needed
        }
        return made;
      });
  const auto waters =
      values.make<const LazyWaters>("waters", reads_nothing, {terrain}, [&](const Making&) {
        return LazyWaters([&of = *terrain] { return find_water_ground(of); });
      });
  // Properties that differ between views of one ground.
  terrain->land_cover = land_cover;
  terrain->exaggeration = view.deform.exaggeration;
  terrain->local = local;

  // Bent, with its ray-tracing structure. Folded ground is refused before the tracer is built.
  const auto surface = values.make<const DeformedSurface>(
      "surface", reads_nothing,
      {has_windows ? ValueInput(terrain) : ValueInput(generalized), of_deform}, [&](const Making&) {
        return deform_ground(*terrain, glm::dvec3(view.viewer_xy, 0.0), deformation);
      });
  check_folds(scene.deform, *terrain, deformation, *camera, progress);
  const auto tracer = values.make<const Tracer>(
      "tracer", [](Scene& to, const Scene& from) { to.tracing = from.tracing; }, {surface},
      [&](const Making& m) {
        m.progress.begin("building the ray tracer", 0.0);
        return Tracer(*surface, m.scene.scene.tracing);
      });
  check_ground_in_view(*dem, *camera, *tracer, progress);
  const double horizon_px = skyline_row_px(*camera, *tracer, usual_horizon * scene.output.height);
  MistAir mist = make_scene_mist(scene, view, *terrain, deformation, *camera);
  const auto sunny_side = values.make<const double>(
      "sunny side", [](Scene& to, const Scene& from) { to.climate = from.climate; }, {opened},
      [&](const Making& m) { return find_sunny_side(m.scene.scene, *dem); });
  return {scene,
          dem,
          view,
          std::move(camera),
          std::move(light_field),
          land_cover,
          deformation,
          {terrain.value, surface.value, tracer.value},
          *terrain,
          surface.value,
          *tracer,
          waters.value,
          horizon_px,
          std::move(mist),
          *sunny_side};
}

FileNotes make_world_notes(const LoadedScene& loaded, const World& world) {
  Provenance provenance = make_provenance(write_scene(loaded.scene), {});
  for (const SceneInput& input : scene_inputs(loaded))
    if (!input.path.empty()) provenance.inputs[input.file] = hash_input(input.path).hash;
  provenance.instruction_set = world.tracer.description();
  FileNotes notes = to_notes(provenance);
  const CameraParameters& camera = world.view.camera;
  notes["belvedere:camera"] =
      fmt::format("{} eye {:.3f} {:.3f} {:.3f} azimuth {:.6f} pitch {:.6f} field {:.4f}",
                  camera.projection, camera.eye.x, camera.eye.y, camera.eye.z, camera.azimuth_deg,
                  camera.pitch_deg, camera.field_of_view_deg);
  notes["belvedere:crs"] = world.dem->crs.empty() ? "none" : describe_crs(world.dem->crs);
  notes["belvedere:sun"] = fmt::format("azimuth {:.4f} altitude {:.4f}", world.view.sun.azimuth_deg,
                                       world.view.sun.altitude_deg);
  return notes;
}

namespace {

constexpr int sight_line_count = 400;

// The visible part of a vertical line, or nothing.
std::optional<SightLine> shown(const Camera& camera, double azimuth_deg) {
  const double azimuth = to_radians(azimuth_deg);
  const auto inside = [&](double altitude_deg) {
    const double altitude = to_radians(altitude_deg);
    constexpr double far_m = 1000.0;  // any distance: only the direction counts
    const auto at =
        camera.project(camera.eye() + far_m * glm::dvec3(exact::sin(azimuth) * exact::cos(altitude),
                                                         exact::cos(azimuth) * exact::cos(altitude),
                                                         exact::sin(altitude)));
    return at && at->x >= 0.0 && at->y >= 0.0 && at->x <= camera.size().x &&
           at->y <= camera.size().y;
  };
  const auto edge = [&](double in, double out) {
    for (int halving = 0; halving < 40; ++halving) {
      const double centre = 0.5 * (in + out);
      (inside(centre) ? in : out) = centre;
    }
    return exact::tan(to_radians(in));
  };
  constexpr double step_deg = 0.5;
  constexpr int steepest = 179;  // steps
  std::optional<double> lowest;
  std::optional<double> highest;
  for (int step = -steepest; step <= steepest; ++step) {
    const double altitude = step * step_deg;
    if (!inside(altitude)) continue;
    if (!lowest) lowest = altitude;
    highest = altitude;
  }
  if (!lowest) return std::nullopt;
  return SightLine{azimuth_deg, edge(*lowest, *lowest - step_deg),
                   edge(*highest, *highest + step_deg)};
}

}  // namespace

BareView bare_view_of(const World& world) {
  const std::shared_ptr<const TerrainModel>& terrain = world.ground.terrain;
  return {world.view,
          world.dem,
          {terrain, &terrain->generalized_m},
          {terrain, &terrain->goes_to},
          world.deformation,
          world.ground.surface,
          make_camera(world.view.camera),
          world.ground.tracer};
}

BareView make_bare_view(const LoadedScene& loaded, Progress& progress, const Cache& cache) {
  BareView bare;
  SceneDem opened = open_scene_dem(loaded, progress, cache);
  bare.view =
      make_view(loaded.scene, opened.dem, progress, ground_altitude_of(opened), &opened.region);
  const auto dem = std::make_shared<const Dem>(std::move(opened.dem));
  bare.dem = dem;
  bare.camera = make_camera(bare.view.camera);
  // Lakes of the map keep their level, as in the picture.
  const std::shared_ptr<const MapCover> areas = areas_of_map(loaded, *dem, cache);
  std::optional<GroundMasks> masks;
  if (opened.data)
    masks = preview_masks(loaded, *opened.data, dem->halved - opened.data->halved, areas.get(),
                          progress);
  GeneralizedTerrain generalized =
      generalize_for_view(loaded, *dem, nullptr, bare.view, progress, cache,
                          {.masks = masks ? &*masks : nullptr, .areas = areas.get()});
  bare.generalized_m = std::make_shared<const Grid<float>>(std::move(generalized.altitude_m));
  bare.goes_to = std::make_shared<const Grid<glm::vec2>>(std::move(generalized.goes_to));
  bend_again(bare, bare.view.deform.bend);
  return bare;
}

void bend_again(BareView& bare, const BendCurve& bend) {
  bare.view.deform.bend = bend;
  bare.deformation = Deformation(bare.view.deform, bare.view.viewer_xy);
  bare.tracer.reset();
  bare.surface = std::make_shared<const DeformedSurface>(
      deform(*bare.generalized_m, bare.dem->transform, glm::dvec3(bare.view.viewer_xy, 0.0),
             bare.deformation));
  bare.tracer = std::make_shared<const Tracer>(*bare.surface);
}

std::vector<SightLine> sight_lines(const CameraParameters& parameters, int count) {
  if (const Projection* projection = find_projection(parameters.projection);
      projection != nullptr && projection->widest_deg == 0.0) {
    std::string central;
    for (const Projection& other : projections())
      if (other.widest_deg > 0.0)
        central += fmt::format("{}\"{}\"", central.empty() ? "" : " or ", other.name);
    throw Error(ErrorKind::usage, "camera.projection",
                fmt::format("\"{}\", whose lines of sight are parallel", projection->name),
                central);
  }
  const std::unique_ptr<Camera> camera = make_camera(parameters);
  // First the width of the view, then evenly over that.
  constexpr int quarters = 720;  // half a turn in quarters of a degree, to either side
  int first = quarters;
  int last = -quarters;
  for (int q = -quarters; q < quarters; ++q) {
    if (!shown(*camera, parameters.azimuth_deg + 0.25 * q)) continue;
    first = std::min(first, q);
    last = std::max(last, q);
  }
  std::vector<SightLine> lines;
  const double from = parameters.azimuth_deg + 0.25 * first;
  const double width = 0.25 * (last - first);
  for (int i = 0; i < count; ++i)
    if (const auto line = shown(*camera, from + width * (i + 0.5) / count)) lines.push_back(*line);
  if (lines.empty())
    throw Error(ErrorKind::usage, "camera", "a picture without any direction of view",
                "a wider view");
  return lines;
}

Grid<float> known_altitude(const Dem& dem) {
  Grid<float> known = dem.altitude_m;
  if (!dem.filled.empty())
    for (std::size_t i = 0; i < known.size(); ++i)
      if (dem.filled[i] != 0) known[i] = std::numeric_limits<float>::quiet_NaN();
  return known;
}

ValleySight make_valley_sight(const BareView& bare) {
  return {known_altitude(*bare.dem), bare.dem->transform, bare.deformation, bare.view.camera.eye.z,
          sight_lines(bare.view.camera, sight_line_count)};
}

}  // namespace belvedere
