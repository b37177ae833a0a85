#include "renderer/world/scene_land_cover.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "base/files/kept_files.h"
#include "base/pixel_rect.h"
#include "base/statistics.h"
#include "renderer/ground/cached_products.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/paint/palette.h"
#include "renderer/world/ground_texture.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/scene_style.h"
#include "renderer/world/scene_towns.h"
#include "terrain/climate/map_climate.h"
#include "terrain/climate/radiation.h"
#include "terrain/layers/layer_apply.h"
#include "terrain/layers/layer_climate.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layers_file.h"

namespace belvedere {

void each_field(auto& bytes, FieldsOf<GroundRelief::Bumps> auto& bumps) {
  auto& [height_m, length_m, seed, share] = bumps;
  bytes(height_m, length_m, seed, share);
}

void each_field(auto& bytes, FieldsOf<CoverRiver> auto& centreline) {
  auto& [positions, half_width_m, painted_as, rank, kind] = centreline;
  bytes(positions, half_width_m, painted_as, rank, kind);
}

void each_field(auto& bytes, FieldsOf<LandCover> auto& cover) {
  auto& [classes, colours, relief, map, inferred, below, inferred_rivers] =
      cover;  // a map is applied over the cached result
  auto& [cells, transform, crs] = classes;
  auto& [colour_cells, colour_transform, colour_crs] = colours;
  auto& [relief_transform, bumps, lake_depth_m] = relief;
  bytes(cells, transform, crs, colour_cells, colour_transform, colour_crs, relief_transform, bumps,
        lake_depth_m, inferred_rivers);
}

namespace {

constexpr const char* winter_setting = "winter";

struct CoverContext {
  Catchments* catchments = nullptr;
  const WholeTerrain* whole = nullptr;        // for a window: the whole
  const WindowGround* window = nullptr;       // and the window
  std::optional<SeenGround>* seen = nullptr;  // receives what the rules used of it
};

CacheKey rule_cover_key(const LoadedScene& loaded, const ClassRules& rules,
                        const ClassRuleParameters& parameters, const Dem& dem,
                        const WholeTerrain* whole, const WindowGround* window) {
  CacheKeyText key;
  const auto& [name, known_parameters, terms, layers, river_beds] = rules;
  key.add("rules", name)
      .add("parameters", known_parameters)
      .add("terms", terms)
      .add("river_beds", river_beds);
  for (const auto& [painted_as, when] : layers) key.add("layer", painted_as).add("when", when);
  const auto& [settings, towns, rivers, sea, seed, climate, sites, catchments, around, rule_whole] =
      parameters;
  key.add("settings", settings).add("seed", seed).add("rivers", rivers);
  add_sea(key, sea);
  for (const auto& [position, radius_m, town] : towns)
    key.add("town", town).add("place", position).add("radius_m", radius_m);
  const auto& [line_posts, treeline_m, ice_line_m, snow_line_m, season_snow_m, table_posts,
               lowest_m, step_m, moisture, temperature_c, rain_mm, sun] = climate;
  key.add("treeline_m", treeline_m)
      .add("ice_line_m", ice_line_m)
      .add("snow_line_m", snow_line_m)
      .add("season_snow_m", season_snow_m);
  key.add("lowest_m", lowest_m)
      .add("step_m", step_m)
      .add("moisture", moisture)
      .add("temperature_c", temperature_c)
      .add("rain_mm", rain_mm);
  key.add("sun", sun);
  for (const GeoTransform& posts : {line_posts, table_posts}) add_transform(key, posts);
  key.add("latitude_deg", loaded.scene.climate.latitude_deg)
      .add("sunshine", loaded.scene.climate.sunshine);
  if (sites)
    for (const auto& [position, radius_m, stretch, along_rad, on_floor] : *sites)
      key.add("site", position)
          .add("radius_m", radius_m)
          .add("stretch", stretch)
          .add("along", along_rad)
          .add("on_floor", on_floor ? 1 : 0);
  add_dem(key, dem);
  if (whole != nullptr)
    add_dem(key, whole->dem);  // casts shadows, and is what `rule_whole` points at
  if (window != nullptr && window->around) {
    const auto& [x0, y0, x1, y1] = window->part;
    key.add("x0", x0).add("y0", y0).add("x1", x1).add("y1", y1).add("around",
                                                                    window->around->made_from);
  }
  return make_cache_key(CachedProduct::land_cover, key, subject_of(loaded));
}

ClassRules read_scene_rules(const LoadedScene& loaded) {
  const std::string file = find_named_file(loaded, "layers", loaded.scene.land_cover.rules);
  return *loaded.kept->get<ClassRules>("rules " + file, {file},
                                       [&] { return read_class_rules(file); });
}

bool takes_climate(const LoadedScene& loaded, const ClassRules& rules, const Dem& dem) {
  return uses_variable(rules, "treeline") && knows_place(loaded.scene, dem);
}

// Without the sun, which takes longest and which only the land cover needs.
RuleClimate rule_climate(const LoadedScene& loaded, const ClassRules& rules, const Dem& dem) {
  if (!takes_climate(loaded, rules, dem)) return alpine_climate();
  return make_map_climate(dem, make_scene_climate(loaded, dem, silent_progress()),
                          {.day_of_season = day_of_season(loaded.scene.season)});
}

// For the note: the altitudes at the centre of the map.
std::string describe_lines(const RuleClimate& climate) {
  const auto centre = [](const Grid<float>& line) {
    return static_cast<double>(line(line.width() / 2, line.height() / 2));
  };
  const double season_m = centre(climate.season_snow_m);
  return fmt::format(
      "by the climate of the place forest ends at {:.0f} m, snow lasts from {:.0f} m, glaciers "
      "begin at {:.0f} m{}",
      centre(climate.treeline_m), centre(climate.snow_line_m), centre(climate.ice_line_m),
      season_m < static_cast<double>(no_season_snow_m)
          ? fmt::format("; on that day snow lies from {:.0f} m", season_m)
          : "");
}

// For the note: what grows, by the water in the lowest quarter of the ground; empty where forest
// has enough.
std::string describe_dryness(const RuleClimate& climate, const Dem& dem) {
  std::vector<float> altitude_m;
  constexpr std::size_t step = 97;
  for (std::size_t i = 0; i < dem.altitude_m.size(); i += step)
    altitude_m.push_back(dem.altitude_m[i]);
  const float low = value_at_rank(altitude_m, altitude_m.size() / 8);
  const std::vector<float> ground(static_cast<std::size_t>(dem.width()), low);
  const auto at_centre = [&](ClimateVariable variable) {
    std::vector<float> row(ground.size());
    fill_climate_row(climate, variable, dem.transform, dem.height() / 2, dem.width(), ground.data(),
                     row.data());
    return static_cast<double>(row[row.size() / 2]);
  };
  const double moisture = at_centre(ClimateVariable::moisture);
  constexpr double enough = 0.72;
  if (!(moisture < enough)) return "";
  return fmt::format(
      "; at {:.0f} m {:.0f} mm of rain a year are {:.0f} % of what plants could use: {}",
      static_cast<double>(low), at_centre(ClimateVariable::rain), 100.0 * moisture,
      moisture < 0.22   ? "desert, green only along water"
      : moisture < 0.46 ? "steppe, green only along water"
                        : "bushes and open woods");
}

// A scene's own value has precedence, and rules may lack the parameter.
void set_unless_said(std::vector<std::pair<std::string, double>>& settings, const ClassRules& rules,
                     const char* name, double value) {
  const auto is_it = [&](const auto& setting) { return setting.first == name; };
  if (std::none_of(settings.begin(), settings.end(), is_it) &&
      std::any_of(rules.parameters.begin(), rules.parameters.end(), is_it))
    settings.emplace_back(name, value);
}

ClassRuleParameters rule_parameters(const LoadedScene& loaded, const ClassRules& rules,
                                    const Dem& dem, Progress& progress,
                                    const Cache& cache = no_cache()) {
  auto settings = loaded.scene.land_cover.settings;
  // A winter palette sets the snow, unless the scene does or the rules have no winter.
  const auto is_winter = [](const auto& setting) { return setting.first == winter_setting; };
  if (std::none_of(settings.begin(), settings.end(), is_winter) &&
      std::any_of(rules.parameters.begin(), rules.parameters.end(), is_winter) &&
      named_palette(loaded).winter)
    settings.emplace_back(winter_setting, 1.0);
  // A map's towns and rivers instead of inferred ones.
  GroundMap map = read_ground_map(loaded, dem, silent_progress(), cache);
  if (!map.keeps_towns) set_unless_said(settings, rules, "settlement", -1.0);
  if (const double clearings = loaded.scene.climate.clearings; clearings != 0.0)
    set_unless_said(settings, rules, "clearings", clearings);
  std::vector<KnownTown> towns = make_scene_towns(loaded, dem, progress);
  towns.insert(towns.end(), std::make_move_iterator(map.towns.begin()),
               std::make_move_iterator(map.towns.end()));
  return {.settings = std::move(settings),
          .towns = std::move(towns),
          .rivers = map.keeps_rivers,
          .sea = scene_sea(loaded.scene.land_cover),
          .seed = loaded.scene.seed,
          .climate = rule_climate(loaded, rules, dem)};
}

MonthShares scene_sunshine(const LoadedScene& loaded) {
  return shares_of_months(loaded.scene.climate.sunshine, "climate.sunshine");
}

Grid<float> sun_of(const LoadedScene& loaded, const Dem& dem, const WholeTerrain* whole,
                   Progress& progress) {
  const auto& latitude_deg = loaded.scene.climate.latitude_deg;
  const SunShareParameters parameters{.sunshine = scene_sunshine(loaded)};
  if (whole != nullptr) return sun_share(dem, whole->dem, latitude_deg, parameters, progress);
  return sun_share(
      dem, make_map_position(dem.transform, dem.crs, dem.width(), dem.height(), latitude_deg),
      parameters, progress);
}

// Class rules on a ground.
struct RuleWork {
  const LoadedScene& loaded;
  ClassRules rules;
  ClassRuleParameters parameters;
  const Dem& dem;
  const WholeTerrain* whole = nullptr;
  const WindowGround* window = nullptr;

  CacheKey key() const { return rule_cover_key(loaded, rules, parameters, dem, whole, window); }
  // Not part of the key: the sun follows from the terrain, its position and the clouds, and what
  // rules used around a window from its own key.
  template <class Work>
  auto with_all(Progress& progress, Work&& work) {
    if (takes_climate(loaded, rules, dem))
      parameters.climate.sun = sun_of(loaded, dem, whole, progress);
    parameters.whole = whole != nullptr && &whole->dem != &dem ? &whole->dem : nullptr;
    if (window == nullptr || !window->around) return work();
    const RuleAround around{window->around->ground->get(), window->part};
    parameters.around = &around;
    auto result = work();
    parameters.around = nullptr;
    return result;
  }
  RuleGround see() {
    return with_all(silent_progress(), [&] { return see_rule_ground(rules, parameters, dem); });
  }
};

LandCover make_rule_cover(const LoadedScene& loaded, const Dem& dem, const CoverContext& context,
                          Progress& progress, const Cache& cache) {
  const ClassRules rules = read_scene_rules(loaded);
  RuleWork work{loaded,
                rules,
                context.whole != nullptr ? context.whole->rules
                                         : rule_parameters(loaded, rules, dem, progress, cache),
                dem,
                context.whole,
                context.window};
  if (context.window != nullptr) work.parameters.sea = context.window->sea;
  work.parameters.catchments = context.catchments;
  if (context.whole == nullptr && takes_climate(loaded, rules, dem))
    progress.note(describe_lines(work.parameters.climate) +
                  describe_dryness(work.parameters.climate, dem));
  const bool keeps = context.seen != nullptr && !context.window->kept.empty();
  std::optional<RuleGround> seen;
  LandCover cover = cached<LandCover>(
      cache, [&] { return work.key(); }, progress,
      [&](Progress& watcher) {
        RuleGround ground;
        LandCover made = work.with_all(watcher, [&] {
          return apply_class_rules(rules, work.parameters, dem, watcher, keeps ? &ground : nullptr);
        });
        if (keeps) seen = part_of(std::move(ground), context.window->kept);
        return made;
      });
  if (!keeps) return cover;
  *context.seen = SeenGround{nullptr, cache.is_on() ? work.key().text : ""};
  using Lazy = LazyValue<RuleGround>;
  if (seen) {
    (*context.seen)->ground = std::make_shared<const Lazy>(std::move(*seen));
  } else {
    (*context.seen)->ground =
        std::make_shared<const Lazy>([&loaded, rules, parameters = work.parameters,
                                      whole = context.whole, window = *context.window] {
          return part_of(RuleWork{loaded, rules, parameters, *window.dem, whole, &window}.see(),
                         window.kept);
        });
  }
  return cover;
}

CacheKey layer_cover_key(const LoadedScene& loaded, const SurfaceLayers& layers,
                         const LayerApplyParameters& parameters,
                         const std::optional<Climate>& climate, const SeaParameters& sea,
                         const Dem& dem) {
  const auto& [seed, drawing, colour, coverage, relief, whole, drawn] = parameters;
  const auto& [power, finest_cells, octaves, spectrum, drawing_seed] = drawing;
  CacheKeyText key;
  key.add("surface layers", surface_layers_text(layers))
      .add("seed", seed)
      .add("colour", colour)
      .add("coverage", coverage)
      .add("relief", relief);
  key.add("power", power)
      .add("finest_cells", finest_cells)
      .add("octaves", octaves)
      .add("spectrum", spectrum)
      .add("drawing", drawing_seed);
  add_sea(key, sea);
  // Position and sun follow from the DEM, the latitude and the clouds.
  key.add("latitude_deg", loaded.scene.climate.latitude_deg)
      .add("sunshine", loaded.scene.climate.sunshine);
  if (climate) {
    for (const auto& [sea_level_c, lapse_k_per_km, rain_mm_at_km, summer_share, gathers, dry_air,
                      sheltered] : climate->nodes)
      key.add("sea_level_c", sea_level_c)
          .add("lapse", lapse_k_per_km)
          .add("rain", rain_mm_at_km)
          .add("summer", summer_share)
          .add("gathers", gathers)
          .add("dry_air", dry_air)
          .add("sheltered", sheltered);
    key.add("nodes_across", climate->nodes.width())
        .add("warmer_k", climate->warmer_k)
        .add("rain_share", climate->rain_share);
  }
  add_dem(key, dem);
  if (whole != nullptr) add_dem(key, *whole);  // determines how classes are drawn
  return make_cache_key(CachedProduct::land_cover, key, subject_of(loaded));
}

SurfaceLayers read_scene_layers(const LoadedScene& loaded) {
  const std::string file = find_scene_file(loaded, loaded.scene.land_cover.layers);
  SurfaceLayers layers = *loaded.kept->get<SurfaceLayers>(
      "layers " + file, {file}, [&] { return read_surface_layers(file); });
  set_layer_parameters(layers, loaded.scene.land_cover.settings);
  return layers;
}

LandCover make_layer_cover(const LoadedScene& loaded, const Dem& dem, const CoverContext& context,
                           Progress& progress, const Cache& cache) {
  const WholeTerrain* whole = context.whole;
  const SeaParameters sea =
      context.window != nullptr ? context.window->sea : scene_sea(loaded.scene.land_cover);
  const SurfaceLayers layers = read_scene_layers(loaded);
  LayerApplyParameters parameters;
  parameters.seed = loaded.scene.seed;
  parameters.whole = whole != nullptr ? &whole->dem : nullptr;
  parameters.colour = loaded.scene.land_cover.colours == "layers";
  parameters.relief = parameters.colour;
  const std::vector<std::string> inputs = compile_layers(layers).inputs;
  if (needs_place(inputs, {})) require_place(loaded.scene, dem);
  std::optional<Climate> climate;
  if (whole != nullptr)
    climate = whole->climate;
  else if (needs_climate(inputs, {}))
    climate = make_scene_climate(loaded, dem, silent_progress());
  LandCover cover = cached<LandCover>(
      cache, [&] { return layer_cover_key(loaded, layers, parameters, climate, sea, dem); },
      progress,
      [&](Progress& watcher) {
        const LayerClimateGrids grids = make_layer_climate(
            dem, inputs, {}, loaded.scene.climate.latitude_deg, [&] { return *climate; }, watcher,
            parameters.whole, sea, scene_sunshine(loaded));
        if (whole != nullptr) parameters.drawn = whole->drawn->get();
        return layer_land_cover(layers, dem, grids.view(), parameters, watcher);
      });
  // The height of bumps and the visibility of beds do not change what is cached.
  const SceneLandCover& settings = loaded.scene.land_cover;
  for (GroundRelief::Bumps& bumps : cover.relief.bumps) bumps.height_m *= settings.bumps;
  if (settings.bumps == 0.0) cover.relief.bumps.clear();
  if (!settings.lake_beds) cover.relief.lake_depth_m = {};
  return cover;
}

// Land cover where there is no raster: by surface layers, or by rules.
LandCover make_modelled_cover(const LoadedScene& loaded, const Dem& dem,
                              const CoverContext& context, Progress& progress, const Cache& cache) {
  return loaded.scene.land_cover.layers.empty()
             ? make_rule_cover(loaded, dem, context, progress, cache)
             : make_layer_cover(loaded, dem, context, progress, cache);
}

// The classes with every patch, however small.
LandCover make_full_classes(const LoadedScene& loaded, const Dem& dem, const CoverContext& context,
                            Progress& progress, const Cache& cache) {
  const SceneLandCover& settings = loaded.scene.land_cover;
  if (settings.sources.empty()) return make_modelled_cover(loaded, dem, context, progress, cache);
  LandCoverParameters parameters;
  parameters.sources = to_raster_sources(loaded, settings.sources);
  parameters.legend = find_named_file(loaded, "legends", settings.legend);
  parameters.folders = loaded.allowed_folders;
  parameters.unknown = settings.unknown;
  parameters.nodata = settings.nodata;
  parameters.finest_cell_m = dem.halved > 0 ? dem.cell_m() : 0.0;
  LandCover cover =
      read_land_cover(parameters, {dem.transform, dem.width(), dem.height(), dem.crs}, progress);
  const bool takes_colours = settings.colours == "layers";
  if (!settings.refine.empty() || takes_colours) {
    LandCover modelled = make_modelled_cover(loaded, dem, context, progress, cache);
    refine_by_rules(cover, modelled, settings.refine);
    cover.inferred_rivers =
        refine_rivers(std::move(modelled.inferred_rivers), cover, settings.refine);
    cover.colours = std::move(modelled.colours);
    cover.relief = std::move(modelled.relief);
  }
  if (settings.refine.empty() && (!settings.towns.empty() || !settings.towns_file.empty()))
    progress.note(
        "the scene's towns are not used: rules build them, but the land cover comes from rasters");
  return cover;
}

// And in the colours of an image, if a scene drapes one over the ground. A window may lie outside
// it, the whole may not.
LandCover make_full_cover(const LoadedScene& loaded, const Dem& dem, const CoverContext& context,
                          Progress& progress, const Cache& cache) {
  LandCover cover = make_full_classes(loaded, dem, context, progress, cache);
  const SceneLandCover& settings = loaded.scene.land_cover;
  CoverErosion erosion;
  for (const auto& [name, steps] : settings.erode)
    erosion.emplace_back(*find_class(name), static_cast<int>(steps));
  cover = erode_land_cover(std::move(cover), erosion, loaded.scene.seed);
  if (settings.colours != "image") return cover;
  cover.colours = read_ground_image(find_scene_file(loaded, settings.colour_image),
                                    {dem.transform, dem.width(), dem.height(), dem.crs},
                                    context.whole == nullptr, progress);
  return cover;
}

}  // namespace

LandCover make_scene_land_cover(const LoadedScene& loaded, const Dem& dem, Progress& progress,
                                const Cache& cache, Catchments* catchments, const SeenFrom* seen) {
  return make_scene_patches(loaded, dem, progress, cache, catchments, seen).cover;
}

PatchResult make_bare_patches(const LoadedScene& loaded, const Dem& dem, Progress& progress,
                              const Cache& cache, Catchments* catchments) {
  PatchResult result = remove_small_patches(
      make_full_cover(loaded, dem, {.catchments = catchments}, progress, cache),
      loaded.scene.land_cover.patches);
  if (loaded.scene.land_cover.colours == "texture")
    result.cover.colours = make_scene_texture(loaded, result.cover, dem, progress, cache);
  return result;
}

PatchResult make_scene_patches(const LoadedScene& loaded, const Dem& dem, Progress& progress,
                               const Cache& cache, Catchments* catchments, const SeenFrom* seen) {
  PatchResult result = make_bare_patches(loaded, dem, progress, cache, catchments);
  lay_ground_map(result.cover, loaded, dem, progress, cache, catchments, seen);
  return result;
}

WholeTerrain know_whole(const LoadedScene& loaded, const Dem& dem, const Sea& sea) {
  WholeTerrain whole{dem, sea, {}};
  const SceneLandCover& settings = loaded.scene.land_cover;
  if (!settings.sources.empty() && settings.refine.empty())
    return whole;  // neither rules nor layers
  if (settings.layers.empty()) {
    const ClassRules rules = read_scene_rules(loaded);
    whole.rules =
        parameters_for_parts(rules, rule_parameters(loaded, rules, dem, silent_progress()), dem);
    return whole;
  }
  const SurfaceLayers layers = read_scene_layers(loaded);
  const std::vector<std::string> inputs = compile_layers(layers).inputs;
  if (needs_climate(inputs, {})) whole.climate = make_scene_climate(loaded, dem, silent_progress());
  whole.drawn = std::make_shared<const LazyValue<LayerDrawing>>(
      [&loaded, &dem, layers, inputs, climate = whole.climate] {
        const LayerClimateGrids grids = make_layer_climate(
            dem, inputs, {}, loaded.scene.climate.latitude_deg, [&] { return *climate; },
            silent_progress(), nullptr, scene_sea(loaded.scene.land_cover), scene_sunshine(loaded));
        LayerApplyParameters parameters;
        parameters.seed = loaded.scene.seed;
        return plan_drawing(layers, dem, grids.view(), parameters);
      });
  return whole;
}

std::optional<SeenGround> see_whole(const LoadedScene& loaded, const WholeTerrain& whole,
                                    const PixelRect& kept, const Cache& cache) {
  const SceneLandCover& settings = loaded.scene.land_cover;
  if (!settings.layers.empty() || (!settings.sources.empty() && settings.refine.empty())) return {};
  const ClassRules rules = read_scene_rules(loaded);
  const RuleWork work{loaded, rules, whole.rules, whole.dem};
  return SeenGround{std::make_shared<const LazyValue<RuleGround>>(
                        [work, kept] { return part_of(RuleWork(work).see(), kept); }),
                    cache.is_on() ? work.key().text : ""};
}

WindowCover make_window_cover(const LoadedScene& loaded, const WindowGround& window,
                              const WholeTerrain& whole, Progress& progress, const Cache& cache) {
  std::optional<SeenGround> seen;
  const CoverContext context{
      .catchments = window.catchments.get(), .whole = &whole, .window = &window, .seen = &seen};
  LandCover cover = make_full_cover(loaded, *window.dem, context, progress, cache);
  cover = remove_small_patches(std::move(cover), loaded.scene.land_cover.patches).cover;
  if (whole.map != nullptr) lay_map(cover, whole.map);
  lay_inferred_rivers(cover, loaded, *window.dem, window.seen);
  return {std::move(cover), std::move(seen)};
}

}  // namespace belvedere
