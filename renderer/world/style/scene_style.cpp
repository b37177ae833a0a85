#include "renderer/world/style/scene_style.h"

#include "base/files/kept_files.h"
#include "renderer/style/style_file.h"
#include "renderer/style/winter_style.h"

namespace belvedere {

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
