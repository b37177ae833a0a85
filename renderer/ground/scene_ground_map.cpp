#include "renderer/ground/scene_ground_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "base/files/kept_files.h"
#include "base/filter.h"
#include "base/masks/polygon.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "renderer/ground/braided_rivers.h"
#include "renderer/ground/cached_products.h"
#include "renderer/ground/river_banks.h"
#include "terrain/io/crs.h"
#include "terrain/io/raster_file.h"
#include "terrain/shape/coast.h"

namespace belvedere {
namespace {

// Whether features of a block can become ground; with a kind column they can.
bool may_be_ground(const FeatureStyle& style, const FeatureSource& source) {
  if (!source.kind_of.empty()) return true;
  const int kind = style.find(source.kind);
  return kind < 0 || becomes_ground(style.kinds[static_cast<std::size_t>(kind)]);
}

std::string extent_of(const MapBox& box) {
  return fmt::format("E {:.0f} … {:.0f}, N {:.0f} … {:.0f}", box.low.x, box.high.x, box.low.y,
                     box.high.y);
}

}  // namespace

MapBox box_of(const Dem& dem) {
  return {dem.transform.to_crs(-0.5, dem.height() - 0.5),
          dem.transform.to_crs(dem.width() - 0.5, -0.5)};
}

FeatureStyle read_scene_feature_style(const LoadedScene& loaded) {
  const std::string file = find_named_file(loaded, "features", loaded.scene.features_style);
  return *loaded.kept->get<FeatureStyle>("feature style " + file, {file},
                                         [&] { return load_feature_style(file); });
}

std::vector<FeatureSource> feature_sources(const LoadedScene& loaded) {
  std::vector<FeatureSource> sources;
  for (std::size_t i = 0; i < loaded.scene.features.size(); ++i) {
    const SceneFeatures& block = loaded.scene.features[i];
    if (!block.enabled) continue;
    VectorSource file = block.file;
    file.path = find_scene_file(loaded, block.source);
    if (file.path.empty()) continue;
    sources.push_back({.file = std::move(file),
                       .layer = block.layer,
                       .where = block.where,
                       .kind = block.kind,
                       .kind_of = block.kind_of,
                       .width_mm = block.width_mm,
                       .width_of = block.width_of,
                       .level_of = block.level_of,
                       .population_of = block.population_of,
                       .block = static_cast<int>(i),
                       .key = fmt::format("features.{}", i)});
  }
  return sources;
}

void each_field(auto& bytes, FieldsOf<Feature> auto& feature) {
  auto& [kind, source, block, shape, where, parts, width_mm, real_m, level_m, people] =
      feature;  // ground has no width on paper, and its file is its block's
  bytes(kind, block, shape, parts, real_m, level_m, people);
}

FeatureSet read_ground_features(const LoadedScene& loaded, const FeatureStyle& style,
                                const Dem& dem, Progress& progress) {
  const MapBox ground = box_of(dem);
  std::vector<FeatureSource> sources = feature_sources(loaded);
  std::erase_if(sources,
                [&](const FeatureSource& source) { return !may_be_ground(style, source); });
  FeatureSet set = read_feature_set(style, sources, dem.crs, ground);
  // With a kind column, the features outside the terrain may all be drawn kinds: the drawing code
  // reports those.
  std::vector<bool> all_ground;
  for (const FeatureSource& source : sources) all_ground.push_back(source.kind_of.empty());
  for (std::size_t r = 0; r < set.readings.size(); ++r) {
    const SourceReading& reading = set.readings[r];
    if (reading.at_zero > 0)
      progress.note(fmt::format("{}: {} features are at 0, 0", reading.file, reading.at_zero));
    if (reading.beside == 0) continue;
    if (all_ground[r] && reading.taken + reading.wrong_shape + reading.unknown.size() == 0)
      throw Error(
          ErrorKind::usage, reading.file,
          fmt::format("none of {} features lies on the terrain; their extent is {}", reading.beside,
                      extent_of({reading.low, reading.high})),
          fmt::format("coordinates within {} ({}), or a file that states its own coordinate system",
                      extent_of(ground), describe_crs(dem.crs)));
    progress.note(
        fmt::format("{}: {} features are outside the terrain", reading.file, reading.beside));
  }
  return set;
}

namespace {

constexpr char inferred_kind[] = "river";  // the word by which a style addresses inferred rivers
// Memory of areas and rivers per position while they are built: MapCover::bytes() four times,
// original and widened.
constexpr double bytes_a_place = 360.0;

std::string hash_of_parts(const std::string& path) {
  std::string all;
  for (const std::string& part : vector_parts(path)) all += hash_file(part) + ' ';
  return all;
}

// Keyed by the content of the blocks' files, the text of the style and the position of the terrain.
CacheKey features_key(const LoadedScene& loaded, const Dem& dem) {
  CacheKeyText key;
  for (const SceneFeatures& block : loaded.scene.features) {
    const auto& [source, file, layer, where, kind, kind_of, width_mm, width_of, level_of,
                 population_of, snap_m, keep_inferred, origin, licence, get_from, optional,
                 enabled] = block;
    key.add("enabled", enabled ? 1 : 0);
    if (!enabled) continue;
    const std::string path = find_scene_file(loaded, source);
    key.add("file", source)
        .add("content", path.empty() ? std::string("none") : hash_of_parts(path));
    key.add("file_crs", file.crs).add("encoding", file.encoding);
    key.add("layer", layer).add("where", where).add("kind", kind).add("kind_of", kind_of);
    key.add("width_of", width_of).add("level_of", level_of).add("population_of", population_of);
  }
  const std::string style = find_named_file(loaded, "features", loaded.scene.features_style);
  key.add("style", style.ends_with(".toml") ? hash_file(style) : style);
  const MapBox box = box_of(dem);
  key.add("crs", dem.crs).add("low", box.low).add("high", box.high);
  return make_cache_key(CachedProduct::ground_features, key, subject_of(loaded));
}

double area_m2(const std::vector<std::vector<glm::dvec2>>& rings) {
  double sum = 0.0;
  for (std::size_t r = 0; r < rings.size(); ++r)
    sum += (r == 0 ? 1.0 : -1.0) * std::abs(signed_area(rings[r]));
  return std::max(0.0, sum);
}

glm::dvec2 centre_of(const std::vector<glm::dvec2>& ring) {
  glm::dvec2 sum(0.0);
  for (const glm::dvec2 position : ring) sum += position - ring[0];
  return ring[0] + sum / static_cast<double>(ring.size());
}

// Coastlines of all files together; areas among them are islands, whatever the orientation of their
// outlines.
void add_coast_line(const Feature& feature, std::vector<std::vector<glm::dvec2>>& lines) {
  lines.push_back(feature.parts[0]);
  if (feature.shape != MapShape::area) return;
  if (signed_area(lines.back()) < 0.0) std::reverse(lines.back().begin(), lines.back().end());
  lines.back().push_back(lines.back().front());
}

// The sea enclosed by the coastlines.
void add_sea(const std::vector<std::vector<glm::dvec2>>& lines, const FeatureKind& kind,
             const MapBox& box, GroundMap& map, Progress& progress) {
  const CoastAreas coast = close_coast(lines, box.low, box.high);
  if (!coast.problem.empty())
    progress.note(coast.problem +
                  ": coastlines are left out, and the sea comes from the elevation model");
  if (coast.rings.empty()) return;
  const LandCoverClass painted_as = kind.ground.value_or(LandCoverClass::water);
  const bool still = kind.level && painted_as == LandCoverClass::water;
  if (still)
    map.lakes.push_back({.rings = coast.rings, .level_m = std::nullopt, .where = "the sea"});
  map.areas.push_back(
      {.rings = coast.rings, .painted_as = painted_as, .rank = kind.rank, .still = still});
}

// Minimum width of a river of this kind in the picture.
double min_river_px(const FeatureKind& kind, const LoadedScene& loaded) {
  const double px_per_mm = loaded.scene.output.width / loaded.scene.output.sheet_width_mm;
  return std::max(kind.min_px, kind.width_mm * kind.min_share * px_per_mm);
}

GroundMap sort_out(const LoadedScene& loaded, const FeatureStyle& style,
                   std::vector<Feature>&& features, const MapBox& box, Progress& progress) {
  GroundMap map;
  map.rivers.looks.resize(style.kinds.size());
  std::size_t without_size = 0;
  bool rivers = false;
  bool towns = false;
  bool keeps = false;
  std::vector<std::vector<glm::dvec2>> coast_lines;
  const FeatureKind* coast_kind = nullptr;
  for (Feature& feature : features) {
    const FeatureKind& kind = style.kinds[static_cast<std::size_t>(feature.kind)];
    const SceneFeatures& block = loaded.scene.features[static_cast<std::size_t>(feature.block)];
    if (kind.draw == FeatureDraw::river) {
      rivers = true;
      keeps = keeps || block.keep_inferred;
      map.rivers.looks[static_cast<std::size_t>(feature.kind)].painted_as =
          kind.ground.value_or(LandCoverClass::water);
      map.rivers.looks[static_cast<std::size_t>(feature.kind)].rank = kind.rank;
      map.rivers.looks[static_cast<std::size_t>(feature.kind)].kind = feature.kind;
      map.rivers.lines.push_back({.positions = std::move(feature.parts[0]),
                                  .width_m = 0.0,
                                  .min_width_m = static_cast<double>(feature.real_m),
                                  .snap_m = block.snap_m,
                                  .group = feature.kind});
      continue;
    }
    if (kind.draw == FeatureDraw::coast) {
      add_coast_line(feature, coast_lines);
      coast_kind = &kind;
      continue;
    }
    if (kind.draw == FeatureDraw::town) {
      towns = true;
      keeps = keeps || block.keep_inferred;
      const bool is_area = feature.shape == MapShape::area;
      // A built-up area keeps its outline; the circle only tells the rules where people live.
      constexpr double within = 0.8;
      const double radius_m = is_area
                                  ? within * std::sqrt(area_m2(feature.parts) / std::numbers::pi)
                                  : town_radius_m(static_cast<double>(feature.people));
      if (radius_m > 0.0)
        map.towns.push_back(
            {.position = is_area ? centre_of(feature.parts[0]) : feature.parts[0][0],
             .radius_m = std::min(radius_m, largest_town_radius_m),
             .name = fmt::format("a town in {}", block.source)});
      else
        ++without_size;
      if (!is_area) continue;
    }
    const LandCoverClass painted_as = kind.ground.value_or(LandCoverClass::settlement);
    const bool is_lake = kind.level && painted_as == LandCoverClass::water;
    if (is_lake)
      map.lakes.push_back({.rings = feature.parts,
                           .level_m = std::isnan(feature.level_m)
                                          ? std::nullopt
                                          : std::optional<double>(feature.level_m),
                           .where = block.source});
    map.areas.push_back({.rings = std::move(feature.parts),
                         .painted_as = painted_as,
                         .rank = kind.rank,
                         .still = is_lake});
  }
  if (coast_kind != nullptr) add_sea(coast_lines, *coast_kind, box, map, progress);
  map.keeps_rivers = !rivers || keeps;
  map.keeps_towns = !towns || keeps;
  if (without_size > 0)
    progress.note(
        fmt::format("{} towns given as points have no population and are left out: "
                    "set population_of to the column of their "
                    "inhabitants",
                    without_size));
  return map;
}

}  // namespace

GroundMap read_ground_map(const LoadedScene& loaded, const Dem& dem, Progress& progress,
                          const Cache& cache) {
  if (!loaded.scene.any_features()) return {};
  const FeatureStyle style = read_scene_feature_style(loaded);
  const MapBox box = box_of(dem);
  Scene named;
  named.features = loaded.scene.features;
  named.features_style = loaded.scene.features_style;
  const CacheKeyText key = CacheKeyText()
                               .add("map", write_scene(named))
                               .add("crs", dem.crs)
                               .add("low", box.low)
                               .add("high", box.high);
  std::vector<std::string> files;
  for (const FeatureSource& source : feature_sources(loaded))
    for (std::string& part : vector_parts(source.file.path)) files.push_back(std::move(part));
  return *loaded.kept->get<GroundMap>(key.str(), files, [&] {
    using Features = std::vector<Feature>;
    const auto read = [&](Progress& watcher) {
      FeatureSet set = read_ground_features(loaded, style, dem, watcher);
      std::erase_if(set.features, [&](const Feature& feature) {
        return !becomes_ground(set.style.kinds[static_cast<std::size_t>(feature.kind)]);
      });
      return std::move(set.features);
    };
    return sort_out(loaded, style,
                    cached<Features>(
                        cache, [&] { return features_key(loaded, dem); }, progress, read),
                    box, progress);
  });
}

void level_scene_lakes(Dem& dem, const LoadedScene& loaded, Progress& progress, const Cache& cache,
                       const Dem* whole) {
  const GroundMap map = read_ground_map(loaded, whole != nullptr ? *whole : dem, progress, cache);
  if (map.lakes.empty()) return;
  const std::vector<LakeLevel> levels =
      find_lake_levels(whole != nullptr ? *whole : dem, map.lakes);
  level_known_lakes(dem, map.lakes, levels);
  std::size_t refused = 0;
  std::size_t uneven = 0;
  std::size_t banks = 0;
  for (const LakeLevel& level : levels) {
    refused += level.refused_level_m ? 1 : 0;
    uneven += level.uneven ? 1 : 0;
    banks += level.level_m && level.bank_share > 0.1 ? 1 : 0;
  }
  if (refused > 0)
    progress.note(fmt::format(
        "{} of {} lakes have an altitude that differs by more than 40 m from their ground, "
        "perhaps in feet: the altitude of the ground is used",
        refused, levels.size()));
  if (uneven > 0)
    progress.note(
        fmt::format("{} of {} lakes are on ground that falls by more than 15 m: it stays unchanged",
                    uneven, levels.size()));
  if (banks > 0)
    progress.note(
        fmt::format("{} of {} lakes have a tenth or more of their outline over 25 m above "
                    "the water: that ground stays unchanged",
                    banks, levels.size()));
}

namespace {

// Gravel lies here, not in towns, on ice or in other water.
bool has_shores(LandCoverClass id) {
  using enum LandCoverClass;
  return id == valley_floor || id == pasture || id == alpine_grass || id == shrub || id == forest ||
         id == scree || id == sand;
}
// Trees grow here, below the treeline.
bool has_groves(LandCoverClass id) {
  using enum LandCoverClass;
  return id == valley_floor || id == pasture || id == shrub || id == forest || id == sand;
}

// Whether banks and shores are drawn: not in previews where even the broadest is about a pixel
// wide, because they are made for all rivers whenever the camera moves.
bool draws_banks(const Scene& scene) {
  constexpr double broad_px = 1.2;
  return !(scene.terrain.preview_mcells > 0.0 &&
           scene.pixels_per_unit() * max_shore_units < broad_px);
}

// The shores of rivers and the rivers, inferred ones with their braids, the topmost last. `cover`
// and `own` are the ground without what is drawn for a view.
std::vector<CoverRiver> with_shores(std::vector<CoverRiver> rivers, const LandCover& cover,
                                    const MapCover& own, const LoadedScene& loaded, const Dem& dem,
                                    const SeenFrom& seen, bool inferred) {
  constexpr double level_m = 3.0;        // a floor differs by this from its river …
  constexpr double level_slope = 0.015;  // … and this much per metre of distance
  if (!draws_banks(loaded.scene)) return rivers;
  const double ppu = loaded.scene.pixels_per_unit();
  const auto class_at = [&](glm::dvec2 position) {
    const LandCoverClass known = own.at(position);
    return known != LandCoverClass::sky ? known : cover.cell_at(position.x, position.y);
  };
  const auto units_per_m = [&](std::size_t i) { return units_across(rivers[i], ppu, dem, seen); };
  std::vector<CoverRiver> shores = river_shores(
      rivers, {.seed = loaded.scene.seed,
               .units_per_m = units_per_m,
               .is_open = [&](glm::dvec2 position) { return has_shores(class_at(position)); },
               .grows_trees = [&](glm::dvec2 position) { return has_groves(class_at(position)); }});
  const auto altitude = [&](glm::dvec2 position) {
    const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
    return sample_bilinear(dem.altitude_m, cell.x, cell.y);
  };
  if (inferred)
    rivers =
        braid_rivers(rivers, {.seed = loaded.scene.seed,
                              .units_per_m = units_per_m,
                              .is_floor = [&](glm::dvec2 from, glm::dvec2 to) {
                                const bool open = own.at(to) == LandCoverClass::water ||
                                                  has_shores(cover.cell_at(to.x, to.y));
                                return open && std::abs(altitude(to) - altitude(from)) <=
                                                   level_m + level_slope * glm::length(to - from);
                              }});
  shores.insert(shores.end(), std::make_move_iterator(rivers.begin()),
                std::make_move_iterator(rivers.end()));
  return shores;
}

// Rivers widened for visibility, with their banks; inferred ones fade instead of breaking into
// dots, and wind.
std::vector<CoverRiver> widen_rivers(std::vector<CoverRiver> rivers, bool inferred,
                                     const FeatureStyle& style, const LoadedScene& loaded,
                                     const Dem& dem, const SeenFrom& seen) {
  parallel_ranges<std::size_t>(rivers.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const int kind = rivers[i].kind;
      const FeatureKind of_kind =
          kind >= 0 ? style.kinds[static_cast<std::size_t>(kind)] : FeatureKind();
      rivers[i] = widen_for_view(std::move(rivers[i]), {min_river_px(of_kind, loaded), inferred},
                                 dem, seen);
    }
  });
  if (!draws_banks(loaded.scene)) return rivers;
  return with_banks(std::move(rivers), loaded.scene.seed, inferred ? 1.0 : 0.0);
}

}  // namespace

void lay_ground_map(LandCover& cover, const LoadedScene& loaded, const Dem& dem, Progress& progress,
                    const Cache& cache, Catchments* catchments, const SeenFrom* seen) {
  const GroundMap map = read_ground_map(loaded, dem, silent_progress(), cache);
  std::vector<CoverRiver> rivers = lay_rivers(map.rivers, loaded, dem, progress, cache, catchments);
  if (!map.areas.empty() || !rivers.empty()) {
    std::size_t positions = 0;
    for (const CoverArea& area : map.areas)
      for (const auto& ring : area.rings) positions += ring.size();
    for (const CoverRiver& river : rivers) positions += river.positions.size();
    check_memory(fmt::format("areas and rivers of {} points", positions),
                 bytes_a_place * static_cast<double>(positions));
    const MapBox box = box_of(dem);
    // The cover's cells do not depend on the view; only lookups for positions of the picture use
    // the widened rivers.
    const auto own = std::make_shared<const MapCover>(map.areas, rivers, box.low, box.high);
    if (seen == nullptr || rivers.empty()) {
      lay_map(cover, own);
    } else {
      rivers = widen_rivers(std::move(rivers), false, read_scene_feature_style(loaded), loaded, dem,
                            *seen);
      rivers = with_shores(std::move(rivers), cover, *own, loaded, dem, *seen, false);
      lay_map(cover,
              std::make_shared<const MapCover>(map.areas, std::move(rivers), box.low, box.high),
              own.get());
    }
  }
  lay_inferred_rivers(cover, loaded, dem, seen);
}

std::shared_ptr<const MapCover> areas_of_map(const LoadedScene& loaded, const Dem& dem,
                                             const Cache& cache) {
  const GroundMap map = read_ground_map(loaded, dem, silent_progress(), cache);
  if (map.areas.empty()) return nullptr;
  const MapBox box = box_of(dem);
  return std::make_shared<const MapCover>(map.areas, std::vector<CoverRiver>(), box.low, box.high);
}

void lay_inferred_rivers(LandCover& cover, const LoadedScene& loaded, const Dem& dem,
                         const SeenFrom* seen) {
  std::vector<CoverRiver> rivers = std::exchange(cover.inferred_rivers, {});
  if (rivers.empty()) return;
  const FeatureStyle style = read_scene_feature_style(loaded);
  const int kind = style.find(inferred_kind);
  for (CoverRiver& river : rivers) {
    river.kind = kind;
    if (kind >= 0)
      river.painted_as =
          style.kinds[static_cast<std::size_t>(kind)].ground.value_or(river.painted_as);
  }
  const MapBox box = box_of(dem);
  const auto own =
      std::make_shared<const MapCover>(std::vector<CoverArea>(), rivers, box.low, box.high);
  if (seen == nullptr) return lay_inferred(cover, own);
  rivers = widen_rivers(std::move(rivers), true, style, loaded, dem, *seen);
  rivers = with_shores(std::move(rivers), cover, *own, loaded, dem, *seen, true);
  lay_inferred(cover,
               std::make_shared<const MapCover>(std::vector<CoverArea>(), std::move(rivers),
                                                box.low, box.high),
               own.get());
}

}  // namespace belvedere
