#include "renderer/register/registered_guidance.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/image/srgb.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/world.h"
#include "terrain/climate/map_climate.h"
#include "terrain/climate/map_position.h"
#include "terrain/cover/class_rules.h"
#include "terrain/register/control_pairs.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr std::size_t max_samples = 12'000;
constexpr std::size_t max_rule_cells = 400'000;  // of the ground on which lines are tried
constexpr double known_share = 0.01;             // of the width
constexpr double min_line_share = 0.02;  // of the ground below the lowest line that is tried

// Pixels of known ground, evenly spaced.
std::vector<std::size_t> sampled_pixels(const Grid<float>& sigma_px,
                                        const GuidanceBuffers& guidance) {
  const auto limit = static_cast<float>(known_share * sigma_px.width());
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < sigma_px.size(); ++i)
    if (!guidance.is_sky(i) && sigma_px[i] <= limit) known.push_back(i);
  std::vector<std::size_t> out;
  const std::size_t count = std::min(max_samples, known.size());
  for (std::size_t k = 0; k < count; ++k) out.push_back(known[k * known.size() / count]);
  return out;
}

glm::dvec2 position_of(const GuidanceBuffers& guidance, std::size_t i) {
  return glm::dvec2(guidance.position_m[i]) + glm::dvec2(guidance.origin_m);
}

double at_middle(const Grid<float>& line) {
  return line.empty() ? 0.0 : static_cast<double>(line(line.width() / 2, line.height() / 2));
}

void set_parameter(std::vector<std::pair<std::string, double>>& settings, std::string_view name,
                   double value) {
  const auto found = std::find_if(settings.begin(), settings.end(),
                                  [&](const auto& setting) { return setting.first == name; });
  if (found != settings.end())
    found->second = value;
  else
    settings.emplace_back(name, value);
}

void set_lines(const PainterLines& lines, std::vector<std::pair<std::string, double>>& settings) {
  if (lines.treeline_m > 0.0) set_parameter(settings, "treeline_m", lines.treeline_m);
  if (lines.snowline_m > 0.0) set_parameter(settings, "snowline_m", lines.snowline_m);
  if (lines.ice_line_m > 0.0) set_parameter(settings, "ice_line_m", lines.ice_line_m);
  if (lines.winter) set_parameter(settings, "winter", 1.0);
}

// The class rules of a scene on a terrain, for trying lines of trees, snow and ice.
class RuleTrial {
 public:
  RuleTrial(const LoadedScene& scene, const Dem& dem)
      : dem_(highest_cells(dem, max_rule_cells)),
        rules_(read_class_rules(find_named_file(scene, "layers", scene.scene.land_cover.rules))),
        waters_(dem_) {
    const Sea sea;
    parameters_ = know_whole(scene, dem_, sea).rules;
    parameters_.rivers = false;
    parameters_.catchments = &waters_;
    if (knows_place(scene.scene, dem_))
      parameters_.climate.sun =
          sun_share(dem_,
                    make_map_position(dem_.transform, dem_.crs, dem_.width(), dem_.height(),
                                      scene.scene.climate.latitude_deg),
                    {});
  }

  PainterLines climate() const {
    return {.treeline_m = at_middle(parameters_.climate.treeline_m),
            .snowline_m = at_middle(parameters_.climate.snow_line_m),
            .ice_line_m = at_middle(parameters_.climate.ice_line_m)};
  }

  std::vector<LandCoverClass> classes(const PainterLines& lines,
                                      const std::vector<glm::dvec2>& positions) {
    ClassRuleParameters parameters = parameters_;
    set_lines(lines, parameters.settings);
    const LandCover cover = apply_class_rules(rules_, parameters, dem_, silent_progress());
    std::vector<LandCoverClass> out(positions.size());
    parallel_ranges(positions.size(), std::size_t{500}, [&](std::size_t from, std::size_t to) {
      for (std::size_t i = from; i < to; ++i) out[i] = cover.at(positions[i].x, positions[i].y);
    });
    return out;
  }

 private:
  const Dem dem_;
  const ClassRules rules_;
  Catchments waters_;
  ClassRuleParameters parameters_;
};

}  // namespace

RegisteredCover find_registered_cover(const Grid<glm::vec3>& painting, const Grid<float>& sigma_px,
                                      const GuidanceBuffers& guidance, const LoadedScene& scene,
                                      const Dem& dem, Progress& progress) {
  progress.begin("fitting lines of trees, snow and ice", 0.0);
  std::vector<PaintSample> samples;
  std::vector<glm::dvec2> positions;
  std::vector<float> altitudes;
  for (const std::size_t i : sampled_pixels(sigma_px, guidance)) {
    samples.push_back({to_oklab(painting[i]), glm::dvec3(guidance.normal[i]),
                       static_cast<double>(guidance.depth_m[i])});
    positions.push_back(position_of(guidance, i));
    altitudes.push_back(guidance.altitude_m[i]);
  }
  if (samples.empty()) return {};
  RuleTrial trial(scene, dem);
  RegisteredCover out;
  out.climate = trial.climate();
  out.lines = find_painter_lines(
      samples, static_cast<double>(value_at_share(altitudes, min_line_share)),
      static_cast<double>(*std::max_element(altitudes.begin(), altitudes.end())),
      [&](const PainterLines& lines) { return trial.classes(lines, positions); });
  return out;
}

void cover_scene(const RegisteredCover& cover, Scene& scene) {
  set_lines(cover.lines, scene.land_cover.settings);
}

void renew_land_cover(const LoadedScene& scene, const Dem& dem, GuidanceBuffers& guidance,
                      Progress& progress) {
  const LandCover cover = make_scene_land_cover(scene, dem, progress);
  parallel_rows(guidance.height(), [&](int y) {
    for (int x = 0; x < guidance.width(); ++x) {
      const std::size_t i = guidance.land_cover.index(x, y);
      if (guidance.is_sky(i)) continue;
      const glm::dvec2 at = position_of(guidance, i);
      guidance.land_cover[i] = cover.at(at.x, at.y);
    }
  });
}

namespace {

constexpr double blur_share = 2.0 / 1200.0;  // of the width, find_painting_light's blur
constexpr double other_light_deg = 25.0;
constexpr double blend_share = 0.25;  // of a region's width on the map

double bearing_from(glm::dvec2 eye, glm::dvec2 at) {
  const double bearing = to_degrees(exact::atan2(at.x - eye.x, at.y - eye.y));
  return bearing < 0.0 ? bearing + 360.0 : bearing;
}

// The points farthest in each of sixteen directions: corners of a convex outline, counterclockwise.
std::vector<glm::dvec2> convex_outline(const std::vector<glm::dvec2>& points) {
  constexpr int directions = 16;
  std::vector<glm::dvec2> out;
  for (int k = 0; k < directions; ++k) {
    const exact::Turn turn = exact::turn(to_radians(360.0 * k / directions));
    const auto along = [&](glm::dvec2 p) { return turn.cosine * p.x + turn.sine * p.y; };
    const glm::dvec2 farthest =
        *std::max_element(points.begin(), points.end(),
                          [&](glm::dvec2 a, glm::dvec2 b) { return along(a) < along(b); });
    const glm::dvec2 corner = glm::round(farthest);
    if (out.empty() || (corner != out.back() && corner != out.front())) out.push_back(corner);
  }
  return out;
}

// The ground of some pixels without the nearest and the farthest twentieth of it.
std::vector<glm::dvec2> outline_of(const std::vector<std::size_t>& pixels,
                                   const GuidanceBuffers& guidance) {
  constexpr double left_out = 0.05;
  constexpr std::size_t min_pixels = 50;
  if (pixels.size() < min_pixels) return {};
  std::vector<float> distances;
  for (const std::size_t i : pixels) distances.push_back(guidance.depth_m[i]);
  const float near = value_at_share(distances, left_out);
  const float far = value_at_share(distances, 1.0 - left_out);
  std::vector<glm::dvec2> points;
  for (const std::size_t i : pixels)
    if (guidance.depth_m[i] >= near && guidance.depth_m[i] <= far)
      points.push_back(glm::dvec2(guidance.position_m[i]) + glm::dvec2(guidance.origin_m));
  return convex_outline(points);
}

double width_of(const std::vector<glm::dvec2>& outline) {
  double area = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 a = outline[i] - outline[0],
                     b = outline[(i + 1) % outline.size()] - outline[0];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return std::sqrt(std::abs(area));
}

}  // namespace

GuidanceBuffers trace_registered_guidance(const LoadedScene& loaded, std::shared_ptr<const Dem> dem,
                                          glm::ivec2 size_px, const Run& run) {
  LoadedScene sized = loaded;
  sized.scene.output.width = size_px.x;
  sized.scene.output.height = size_px.y;
  const World world = make_world(sized, run.progress, run.cache, {.dem = std::move(dem)});
  return trace_view(world, view_of(world), {0, 0, size_px.x, size_px.y}, run);
}

RegisteredLight find_registered_light(const Grid<glm::vec3>& painting,
                                      const GuidanceBuffers& guidance, glm::dvec2 eye) {
  Grid<std::uint8_t> labels(painting.width(), painting.height(), unused_label);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (!guidance.is_sky(i)) labels[i] = static_cast<std::uint8_t>(guidance.land_cover[i]);
  PaintingLightParameters parameters;
  parameters.blur_px = blur_share * painting.width();
  const PaintingLight found = find_painting_light(painting, labels, guidance, parameters);
  RegisteredLight out{found.whole, 0.0,
                      Grid<RegisteredRegion>(parameters.columns, parameters.rows)};
  Grid<std::vector<std::size_t>> pixels(parameters.columns, parameters.rows);
  std::vector<std::size_t> all;
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      const std::size_t i = labels.index(x, y);
      if (labels[i] == unused_label) continue;
      pixels(x * parameters.columns / labels.width(), y * parameters.rows / labels.height())
          .push_back(i);
      all.push_back(i);
    }
  const auto bearing_of = [&](const std::vector<std::size_t>& of) {
    glm::dvec2 mean(0.0);
    for (const std::size_t i : of)
      mean += (glm::dvec2(guidance.position_m[i]) + glm::dvec2(guidance.origin_m)) /
              static_cast<double>(of.size());
    return bearing_from(eye, mean);
  };
  out.bearing_deg = bearing_of(all);
  for (std::size_t k = 0; k < pixels.size(); ++k)
    out.regions[k] = {found.regions[k], bearing_of(pixels[k]), outline_of(pixels[k], guidance)};
  return out;
}

std::vector<RegisteredRegion> regions_of_other_light(const RegisteredLight& light) {
  std::vector<RegisteredRegion> out;
  for (const RegisteredRegion& region : light.regions)
    if (region.sun.differs() && region.outline.size() >= 3 &&
        std::abs(std::remainder(region.sun.azimuth_deg - light.sun.azimuth_deg, 360.0)) >
            other_light_deg)
      out.push_back(region);
  return out;
}

void light_scene(const RegisteredLight& light, Scene& scene) {
  if (!light.sun.trusted()) return;
  scene.sun.azimuth_deg = std::round(light.sun.azimuth_deg);
  scene.sun.altitude_deg = std::round(light.sun.altitude_deg);
  for (const RegisteredRegion& region : regions_of_other_light(light)) {
    SceneLightRegion& added = scene.light_regions.emplace_back();
    added.name = fmt::format("part {} of the painting", scene.light_regions.size());
    added.points = region.outline;
    added.azimuth_deg = std::round(region.sun.azimuth_deg);
    added.altitude_deg = std::round(region.sun.altitude_deg);
    added.blend_m = std::round(blend_share * width_of(region.outline));
  }
}

}  // namespace belvedere
