#include "renderer/world/scene_light.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "terrain/io/features.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

// Every pixel near a region needs its distance to the outline.
constexpr std::size_t max_corners = 20000;

std::vector<glm::dvec2> outline_of(const SceneLightRegion& given, const Dem& dem,
                                   const std::string& key) {
  std::vector<glm::dvec2> ring = given.points;
  for (const glm::dvec2 lonlat : given.points_lonlat)
    ring.push_back(position_of_lonlat(dem, lonlat, key + ".points_lonlat"));
  return ring;
}

// The areas of a region's file: one ring and its holes each; none if an optional file is missing.
std::vector<std::vector<std::vector<glm::dvec2>>> areas_of(const LoadedScene& loaded,
                                                           const SceneLightRegion& given,
                                                           const Dem& dem, const std::string& key,
                                                           Progress& progress) {
  VectorSource source = given.source;
  source.path = find_scene_file(loaded, given.file);
  if (source.path.empty()) {
    if (!given.optional) throw missing_scene_file(loaded, given.file);
    progress.note(fmt::format("{} is left out: {} is missing{}{}", key, given.file,
                              similar_scene_file_hint(loaded, given.file),
                              given.get_from.empty() ? "" : "; " + given.get_from));
    return {};
  }
  if (dem.crs.empty())
    throw Error(ErrorKind::usage, key + ".file", "a file of areas on a terrain without CRS",
                "points = [[E, N], …]");
  std::vector<std::vector<std::vector<glm::dvec2>>> areas;
  std::size_t corners = 0;
  for (MapFeature& feature :
       read_map_features(source, {.layer = given.layer, .where = given.where}, dem.crs).features) {
    if (feature.shape != MapShape::area) continue;
    for (const auto& ring : feature.parts) corners += ring.size();
    areas.push_back(std::move(feature.parts));
  }
  if (areas.empty())
    throw Error(ErrorKind::usage, given.file, "it has no areas for " + key,
                "a file, layer or filter with areas");
  if (corners > max_corners)
    throw Error(ErrorKind::limit, given.file, fmt::format("its areas have {} corners", corners),
                fmt::format("at most {}: light needs no finer outline", max_corners));
  return areas;
}

// The region's sun: the picture's, turned, or its own.
glm::dvec3 sun_of(const SceneLightRegion& given, const SunPosition& picture) {
  SunPosition sun = picture;
  if (given.azimuth_deg) sun.azimuth_deg = *given.azimuth_deg;
  if (given.turn_deg) sun.azimuth_deg += *given.turn_deg;
  if (given.altitude_deg) sun.altitude_deg = *given.altitude_deg;
  return sun_direction(sun);
}

}  // namespace

std::shared_ptr<const LightField> make_light_field(const LoadedScene& loaded, const Dem& dem,
                                                   const View& view, Progress& progress) {
  const Scene& scene = loaded.scene;
  if (scene.light_regions.empty() && scene.light_clouds.empty()) return nullptr;
  if (view.sun.altitude_deg <= 0.0)
    throw Error(
        ErrorKind::usage, scene.light_regions.empty() ? "light.clouds" : "light.regions",
        fmt::format("the scene's sun stands {:.1f}° below the horizon", -view.sun.altitude_deg),
        "a sun above it");
  std::vector<LightRegion> regions;
  for (std::size_t i = 0; i < scene.light_regions.size(); ++i) {
    const SceneLightRegion& given = scene.light_regions[i];
    const std::string key = fmt::format("light.regions.{}", i);
    LightRegion region{.blend_m = given.blend_m,
                       .sun_direction = sun_of(given, view.sun),
                       .strength = given.strength,
                       .warmth = given.warmth};
    if (!given.file.empty()) {
      for (auto& area : areas_of(loaded, given, dem, key, progress)) {
        region.rings = std::move(area);
        regions.push_back(region);
      }
      continue;
    }
    if (const std::vector<glm::dvec2> ring = outline_of(given, dem, key); !ring.empty()) {
      region.rings = {ring};
    } else {
      region.centre = resolve_place(dem, given.position, given.position_lonlat, key);
      region.radius_m = given.radius_m.value_or(0.0);
    }
    regions.push_back(std::move(region));
  }
  std::vector<CloudShadow> clouds;
  for (std::size_t i = 0; i < scene.light_clouds.size(); ++i) {
    const SceneLightCloud& given = scene.light_clouds[i];
    clouds.push_back({.centre = resolve_place(dem, given.position, given.position_lonlat,
                                              fmt::format("light.clouds.{}", i)),
                      .radius_m = given.radius_m,
                      .strength = given.strength,
                      .blend_m = given.blend_m.value_or(given.radius_m)});
  }
  if (regions.empty() && clouds.empty()) return nullptr;
  const exact::Turn towards = exact::turn(to_radians(view.camera.azimuth_deg));
  return std::make_shared<const LightField>(view.sun_direction,
                                            glm::dvec2(towards.cosine, -towards.sine),
                                            std::move(regions), std::move(clouds), scene.seed);
}

namespace {

constexpr double smoothed_m = 100.0;  // half of the step by which slopes are measured
constexpr double level =
    0.97;  // cosine of a slope of 14°, exaggerated: flatter ground does not count as a slope
constexpr double away_below = 0.10;  // cosine to the sun
constexpr double bias_m = 2.0;       // start of rays above the facet
// Minimum distance of summits, by their distance from the viewer.
constexpr double min_apart_m = 2500.0;
constexpr double apart_share = 0.10;
constexpr double flank_share = 0.4;  // of that: a summit with higher ground so near is on a flank
constexpr std::size_t max_summits = 48;
constexpr double min_share = 0.02;
// Proposals.
constexpr std::size_t max_proposals = 6;
constexpr std::array<double, 8> turns_deg = {30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 120.0, -120.0};
constexpr double wanted_lit = 0.62;  // the rest models a range
constexpr double cost_per_deg =
    0.0008;  // per turn, in lit share: prefers the smaller of two that help equally
constexpr double min_gain = 0.08;

glm::dvec3 normal_at(const TerrainModel& terrain, double column, double row, double exaggeration) {
  const GeoTransform& t = terrain.dem->transform;
  const double x = smoothed_m / t.cell_x;
  const double y = smoothed_m / t.cell_y;
  const auto height = [&](double c, double r) {
    return exaggeration * static_cast<double>(sample_bilinear(terrain.generalized_m, c, r));
  };
  const double east = (height(column + x, row) - height(column - x, row)) / (2.0 * smoothed_m);
  const double north = (height(column, row - y) - height(column, row + y)) / (2.0 * smoothed_m);
  return glm::normalize(glm::dvec3(-east, -north, 1.0));
}

double apart_m(double distance_m) { return std::max(min_apart_m, apart_share * distance_m); }

enum class Lit : std::uint8_t { lit, cast, away };

std::vector<Lit> light_of(std::span<const SeenSlope> slopes, const Tracer& tracer, glm::dvec3 sun,
                          const LightField* field) {
  std::vector<Lit> out(slopes.size(), Lit::away);
  constexpr int bundle = 16;
  const int bundles = static_cast<int>((slopes.size() + bundle - 1) / bundle);
  parallel_rows(bundles, [&](int b) {
    std::array<Ray, bundle> rays;
    std::array<std::size_t, bundle> owners{};
    std::array<std::uint8_t, bundle> blocked{};
    std::size_t count = 0;
    const std::size_t end = std::min(slopes.size(), static_cast<std::size_t>(b + 1) * bundle);
    for (std::size_t i = static_cast<std::size_t>(b) * bundle; i < end; ++i) {
      const glm::dvec3 own = field != nullptr ? field->at(slopes[i].position).sun : sun;
      if (glm::dot(own, slopes[i].normal) < away_below) continue;
      rays[count] = {slopes[i].start, own};
      owners[count++] = i;
    }
    tracer.occluded(std::span(rays).first(count), 1e9, std::span(blocked).first(count));
    for (std::size_t k = 0; k < count; ++k) out[owners[k]] = blocked[k] != 0 ? Lit::cast : Lit::lit;
  });
  return out;
}

// The lack of light of a range, weighted by its share of the picture.
double missing_light(std::span<const SeenRange> ranges) {
  double sum = 0.0;
  for (const SeenRange& range : ranges) sum += range.share * std::max(0.0, wanted_lit - range.lit);
  return sum;
}

SceneLightRegion region_around(const SeenRange& range, const Dem& dem) {
  const auto rounded = [](double value, double to) { return std::round(value / to) * to; };
  SceneLightRegion region;
  if (dem.crs.empty()) {
    region.position = glm::dvec2(rounded(range.centre.x, 100.0), rounded(range.centre.y, 100.0));
  } else {
    const glm::dvec2 lonlat = transform_point(dem.crs, normalize_crs("EPSG:4326"), range.centre);
    region.position_lonlat =
        glm::dvec2(std::round(lonlat.x * 1000.0) / 1000.0, std::round(lonlat.y * 1000.0) / 1000.0);
  }
  region.radius_m = std::max(500.0, rounded(range.radius_m, 100.0));
  region.blend_m = std::max(500.0, rounded(0.6 * range.radius_m, 100.0));
  region.name = fmt::format("around the summit of {:.0f} m, {:.0f} km away", range.altitude_m,
                            range.distance_m / 1000.0);
  return region;
}

}  // namespace

std::vector<SeenSlope> see_slopes(const TerrainModel& terrain, double exaggeration,
                                  const Tracer& tracer, const Camera& camera, int step) {
  const glm::ivec2 size = camera.size();
  const int rows = (size.y + step - 1) / step;
  std::vector<std::vector<SeenSlope>> found(static_cast<std::size_t>(rows));
  parallel_rows(rows, [&](int r) {
    constexpr int bundle = 16;
    std::array<Ray, bundle> rays;
    std::array<Hit, bundle> hits;
    for (int x0 = 0; x0 < size.x; x0 += bundle * step) {
      const int count = std::min(bundle, (size.x - x0 + step - 1) / step);
      for (int i = 0; i < count; ++i)
        rays[static_cast<std::size_t>(i)] =
            camera.ray(glm::dvec2(x0 + i * step + 0.5, r * step + 0.5));
      tracer.intersect(std::span(rays).first(static_cast<std::size_t>(count)),
                       std::span(hits).first(static_cast<std::size_t>(count)));
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        if (!hits[i].found) continue;
        const TerrainModel& ground = ground_of(terrain, hits[i].window);
        const glm::dvec3 normal = normal_at(ground, hits[i].column, hits[i].row, exaggeration);
        if (normal.z > level) continue;
        found[static_cast<std::size_t>(r)].push_back(
            {.position = ground.dem->transform.to_crs(hits[i].column, hits[i].row),
             .altitude_m = static_cast<double>(
                 sample_bilinear(ground.generalized_m, hits[i].column, hits[i].row)),
             .distance_m = hits[i].distance_m,
             .normal = normal,
             .start = rays[i].origin + rays[i].direction * hits[i].distance_m +
                      bias_m * hits[i].facet_normal()});
      }
    }
  });
  std::vector<SeenSlope> slopes;
  for (const std::vector<SeenSlope>& row : found)
    slopes.insert(slopes.end(), row.begin(), row.end());
  return slopes;
}

std::vector<SeenRange> find_ranges(std::span<const SeenSlope> slopes) {
  std::vector<std::size_t> by_height(slopes.size());
  std::iota(by_height.begin(), by_height.end(), std::size_t{0});
  std::stable_sort(by_height.begin(), by_height.end(), [&](std::size_t a, std::size_t b) {
    return slopes[a].altitude_m > slopes[b].altitude_m;
  });
  std::vector<SeenRange> ranges;
  for (std::size_t rank = 0; rank < by_height.size() && ranges.size() < max_summits; ++rank) {
    const std::size_t i = by_height[rank];
    const SeenSlope& slope = slopes[i];
    if (std::any_of(ranges.begin(), ranges.end(), [&](const SeenRange& other) {
          return glm::length(slope.position - other.summit) <
                 std::max(apart_m(slope.distance_m), apart_m(other.distance_m));
        }))
      continue;
    const double flank_m = flank_share * apart_m(slope.distance_m);
    if (std::any_of(by_height.begin(), by_height.begin() + static_cast<std::ptrdiff_t>(rank),
                    [&](std::size_t higher) {
                      return glm::length(slopes[higher].position - slope.position) < flank_m;
                    }))
      continue;
    ranges.push_back(
        {.summit = slope.position, .altitude_m = slope.altitude_m, .distance_m = slope.distance_m});
  }
  for (std::size_t i = 0; i < slopes.size(); ++i) {
    const auto farness = [&](const SeenRange& range) {
      return glm::length(slopes[i].position - range.summit);
    };
    std::min_element(ranges.begin(), ranges.end(), [&](const SeenRange& a, const SeenRange& b) {
      return farness(a) < farness(b);
    })->slopes.push_back(i);
  }
  for (SeenRange& range : ranges) {
    range.share = static_cast<double>(range.slopes.size()) / static_cast<double>(slopes.size());
    for (const std::size_t i : range.slopes)
      range.centre += slopes[i].position / static_cast<double>(range.slopes.size());
    std::vector<double> far;
    for (const std::size_t i : range.slopes)
      far.push_back(glm::length(slopes[i].position - range.centre));
    if (far.empty()) continue;
    range.radius_m = value_at_rank(far, 3 * far.size() / 4);
  }
  std::erase_if(ranges, [](const SeenRange& range) { return range.share < min_share; });
  std::stable_sort(ranges.begin(), ranges.end(),
                   [](const SeenRange& a, const SeenRange& b) { return a.share > b.share; });
  return ranges;
}

void light_ranges(std::vector<SeenRange>& ranges, std::span<const SeenSlope> slopes,
                  const Tracer& tracer, glm::dvec3 sun, const LightField* field) {
  const std::vector<Lit> light = light_of(slopes, tracer, sun, field);
  for (SeenRange& range : ranges) {
    std::array<double, 3> count{};
    for (const std::size_t i : range.slopes) count[static_cast<std::size_t>(light[i])] += 1.0;
    const auto all = static_cast<double>(range.slopes.size());
    range.lit = count[0] / all;
    range.cast = count[1] / all;
    range.away = count[2] / all;
  }
}

std::vector<ProposedLight> propose_light(const LoadedScene& loaded, const Dem& dem,
                                         const View& view, std::span<const SeenSlope> slopes,
                                         const Tracer& tracer) {
  if (view.sun.altitude_deg <= 0.0) return {};
  LoadedScene scene = loaded;
  std::vector<SceneLightRegion>& regions = scene.scene.light_regions;
  std::vector<SeenRange> ranges = find_ranges(slopes);
  light_ranges(ranges, slopes, tracer, view.sun_direction,
               make_light_field(scene, dem, view).get());
  std::vector<ProposedLight> out;
  for (std::size_t r = 0; r < ranges.size() && out.size() < max_proposals; ++r) {
    if (!ranges[r].in_shade()) continue;
    SceneLightRegion region = region_around(ranges[r], dem);
    double min = missing_light(ranges) - min_gain * ranges[r].share;
    std::vector<SeenRange> best;
    double best_turn = 0.0;
    for (const double turn : turns_deg) {
      region.turn_deg = turn;
      regions.push_back(region);
      std::vector<SeenRange> tried = ranges;
      light_ranges(tried, slopes, tracer, view.sun_direction,
                   make_light_field(scene, dem, view).get());
      regions.pop_back();
      const double cost = missing_light(tried) + cost_per_deg * std::abs(turn) * ranges[r].share;
      if (cost >= min) continue;
      min = cost;
      best_turn = turn;
      best = std::move(tried);
    }
    if (best.empty()) continue;
    region.turn_deg = best_turn;
    out.push_back({.region = region, .lit_before = ranges[r].lit, .lit_after = best[r].lit});
    regions.push_back(region);
    ranges = std::move(best);
  }
  return out;
}

std::string proposed_light_text(std::span<const ProposedLight> proposals) {
  if (proposals.empty())
    return "# No range of the picture is in shade that turning the light would help.\n";
  std::string out;
  for (const ProposedLight& proposal : proposals) {
    const SceneLightRegion& r = proposal.region;
    const auto position =
        r.position_lonlat
            ? fmt::format("position_lonlat = [{}, {}]", r.position_lonlat->x, r.position_lonlat->y)
            : fmt::format("position = [{}, {}]", r.position->x, r.position->y);
    out += fmt::format(
        "{}# {:.0f} % of its slopes are lit; with this region {:.0f} %.\n"
        "[[light.regions]]\n"
        "name = \"{}\"\n"
        "{}\n"
        "radius_m = {}\n"
        "turn_deg = {}\n"
        "blend_m = {}\n",
        out.empty() ? "" : "\n", 100.0 * proposal.lit_before, 100.0 * proposal.lit_after, r.name,
        position, *r.radius_m, *r.turn_deg, r.blend_m);
  }
  return out;
}

}  // namespace belvedere
