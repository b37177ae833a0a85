#include "renderer/pipeline/picture_legend.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>
#include <string>
#include <string_view>

#include "renderer/trace/camera_reduced.h"
#include "renderer/trace/sketch/class_view.h"

namespace belvedere {
namespace {

constexpr int looked_px = 600;            // width of the small picture
constexpr double min_share = 0.001;       // of its ground
constexpr double swatch_tone = 0.72;      // lit, but not glaring
constexpr int places_a_side = 240;        // altitudes that are sampled
constexpr double open_ground_m = 1200.0;  // altitude of the ground under swatches of features

std::string hex(glm::vec3 colour) {
  const auto byte = [](float value) {
    return static_cast<int>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.r), byte(colour.g), byte(colour.b));
}

std::string words_of(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

SwatchForm form_of(FeatureDraw draw) {
  return draw == FeatureDraw::cable      ? SwatchForm::cable
         : draw == FeatureDraw::building ? SwatchForm::house
                                         : SwatchForm::line;
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
  std::array<double, land_cover_class_count> positions{};
  const Dem& dem = *world.dem;
  for (int j = 0; j < places_a_side; ++j)
    for (int i = 0; i < places_a_side; ++i) {
      const int x = static_cast<int>((i + .5) * dem.width() / places_a_side);
      const int y = static_cast<int>((j + .5) * dem.height() / places_a_side);
      const glm::dvec2 position = dem.transform.to_crs(x, y);
      const auto id = static_cast<std::size_t>(world.land_cover->at(position.x, position.y));
      altitude_m[id] += static_cast<double>(dem.altitude_m(x, y));
      positions[id] += 1.0;
    }
  std::vector<LegendEntry> legend;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const auto id = static_cast<std::size_t>(info.id);
    if (info.id == LandCoverClass::sky ||
        static_cast<double>(seen[id]) < min_share * static_cast<double>(ground) || seen[id] == 0)
      continue;
    const double mean_m = positions[id] > 0.0 ? altitude_m[id] / positions[id] : 1000.0;
    legend.push_back(
        {words_of(info.name), hex(palette_colour(palette, info.id, mean_m, swatch_tone))});
  }
  return legend;
}

std::vector<FeatureSwatch> find_feature_legend(const DrawnFeatures& drawn, const Palette& palette) {
  const std::string ground =
      hex(palette_colour(palette, drawn.winter ? LandCoverClass::snow : LandCoverClass::pasture,
                         open_ground_m, swatch_tone));
  std::vector<FeatureSwatch> swatches;
  for (std::size_t k = 0; k < drawn.style.kinds.size(); ++k) {
    const FeatureKind& kind = drawn.style.kinds[k];
    const bool shown = std::any_of(drawn.counts.begin(), drawn.counts.end(),
                                   [&](const std::vector<DrawnCount>& source) {
                                     return k < source.size() && source[k].drawn > 0;
                                   });
    if (!shown || becomes_ground(kind)) continue;
    const FeatureColours& colours = drawn.winter ? kind.winter : kind.summer;
    swatches.push_back({.name = words_of(kind.name),
                        .form = form_of(kind.draw),
                        .ground = ground,
                        .fill = hex(colours.fill),
                        .casing = hex(colours.casing),
                        .bed = hex(colours.bed),
                        .width_mm = kind.width_mm,
                        .min_px = kind.min_px,
                        .casing_mm = kind.casing_mm,
                        .bed_mm = kind.bed_mm,
                        .opacity = kind.opacity,
                        .dash_mm = kind.dash_mm,
                        .has_pylons = kind.pylon_mm > 0.0});
  }
  return swatches;
}

std::string legend_to_text(const std::vector<LegendEntry>& legend) {
  std::string text;
  for (const LegendEntry& entry : legend) text += entry.colour + " " + entry.name + "\n";
  return text;
}

std::vector<LegendEntry> legend_from_text(const std::string& text) {
  std::vector<LegendEntry> legend;
  std::istringstream lines(text);
  std::string colour, name;
  while (lines >> colour && std::getline(lines >> std::ws, name)) legend.push_back({name, colour});
  return legend;
}

std::string swatches_to_text(const std::vector<FeatureSwatch>& swatches) {
  std::string text;
  for (const FeatureSwatch& s : swatches)
    text +=
        fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", static_cast<int>(s.form),
                    s.ground, s.fill, s.casing, s.bed, s.width_mm, s.min_px, s.casing_mm, s.bed_mm,
                    s.opacity, s.dash_mm.x, s.dash_mm.y, s.has_pylons ? 1 : 0, s.name);
  return text;
}

std::vector<FeatureSwatch> swatches_from_text(const std::string& text) {
  std::vector<FeatureSwatch> swatches;
  std::istringstream lines(text);
  lines.imbue(std::locale::classic());
  FeatureSwatch s;
  int form = 0;
  while (lines >> form >> s.ground >> s.fill >> s.casing >> s.bed >> s.width_mm >> s.min_px >>
             s.casing_mm >> s.bed_mm >> s.opacity >> s.dash_mm.x >> s.dash_mm.y >> s.has_pylons &&
         std::getline(lines >> std::ws, s.name)) {
    s.form = static_cast<SwatchForm>(form);
    swatches.push_back(s);
  }
  return swatches;
}

}  // namespace belvedere
