#include "renderer/register/registered_cover.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/image/oklab.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/season/scene_season.h"
#include "terrain/climate/map_climate.h"
#include "terrain/climate/map_position.h"
#include "terrain/cover/class_rules.h"
#include "terrain/register/control_pairs.h"

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
  if (lines.winter) set_parameter(settings, "winter", 1.0);
}

// The class rules of a scene on a terrain, for trying tree and snow lines.
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
    return {at_middle(parameters_.climate.treeline_m), at_middle(parameters_.climate.snow_line_m)};
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
  progress.begin("fitting tree and snow lines", 0.0);
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

}  // namespace belvedere
