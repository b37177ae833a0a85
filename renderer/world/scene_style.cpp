#include "renderer/world/scene_style.h"

#include "base/files/kept_files.h"
#include "renderer/image/srgb.h"
#include "renderer/paint/light.h"
#include "renderer/style/fit/style_painting.h"
#include "renderer/style/stroke_direction.h"
#include "renderer/style/style_file.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr double snow_difference = 0.8;  // share of the palette's difference between white classes
constexpr double forest_hue = 0.4;       // share of its change of hue of forest from summer

}  // namespace

Style winter_style(Style style) {
  const Palette winter = read_palette("winter");
  const ClassRamps in_winter = palette_ramps(winter);
  const ClassRamps in_summer = palette_ramps(read_palette("summer"));
  const ClassRamps own = palette_ramps(style.palette);
  const StyleBrushwork on_snow = brushwork_of(style, snow);
  const std::size_t s = index_of(snow);
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const std::size_t c = index_of(info.id);
    const bool white = is_white(info.id, true) && !is_white(info.id, false);
    if (!white && info.id != forest) continue;
    LabRamp ramp = own[c];
    for (std::size_t k = 0; k < ramp.size(); ++k)
      if (info.id == forest) {
        const glm::dvec3 change = in_winter[c][k] - in_summer[c][k];
        ramp[k] += glm::dvec3(1.0, forest_hue, forest_hue) * change;
      } else {
        ramp[k] = own[s][k] + snow_difference * (in_winter[c][k] - in_winter[s][k]);
      }
    style.palette.classes[c].stops = {{0.0, encoded_ramp(ramp)}};
    if (!white) continue;
    const double level = style.brushwork[c].level;
    style.brushwork[c] = on_snow;
    if (style.brushwork[c].length_px > 0.0) style.brushwork[c].level = level;
  }
  style.palette.winter = true;
  style.palette.growth = winter.growth;
  style.palette.ground_drift_share = winter.ground_drift_share;
  style.palette.forest_drift_share = winter.forest_drift_share;
  return style;
}

std::optional<Style> named_style(const LoadedScene& loaded) {
  if (loaded.scene.style.file.empty()) return std::nullopt;
  const std::string file = find_named_file(loaded, "styles", loaded.scene.style.file);
  const bool winter = loaded.scene.style.winter;
  return *loaded.kept->get<Style>((winter ? "winter style " : "style ") + file, {file}, [&] {
    Style style = read_style(file);
    return winter ? winter_style(std::move(style)) : style;
  });
}

Palette named_palette(const LoadedScene& loaded) {
  if (loaded.scene.palette.empty())
    if (const std::optional<Style> style = named_style(loaded)) return style->palette;
  const std::string file = find_named_file(loaded, "palettes", loaded.scene.palette);
  return *loaded.kept->get<Palette>("palette " + file, {file}, [&] { return read_palette(file); });
}

StylePaintParameters to_style_parameters(const Scene& scene, double pixels_per_unit,
                                         glm::ivec2 sheet_px) {
  StylePaintParameters p;
  p.pixels_per_unit = pixels_per_unit;
  p.sheet_px = sheet_px;
  p.seed = scene.seed;
  p.palette = scene.style.palette;
  p.brushwork = scene.style.brushwork;
  p.sky = scene.style.sky;
  p.scale = scene.style.scale.value_or(0.0);
  p.contour_lines = scene.style.contour_lines;
  p.paint_relief *= scene.style.relief;
  p.weave *= scene.style.canvas;
  return p;
}

}  // namespace belvedere
