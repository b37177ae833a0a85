#include "renderer/sheet.h"

#include <cmath>
#include <string>
#include <utility>

#include "renderer/base/embedded.h"
#include "renderer/exemplars.h"
#include "texture/stroke_painter.h"

namespace belvedere {
namespace {

// The sheet's scene: built in, then fitted to the target's size of stroke, palette and side of light.
LoadedScene sheet_scene(const SceneExemplar& wish, const Stage& target) {
  LoadedScene sheet = parse_scene(std::string(embedded_file("sheet.toml")), "sheet.toml", ".", {});
  const double scale = target.scene.pixels_per_unit();
  sheet.scene.output.width = wish.width;
  sheet.scene.output.height = wish.height;
  sheet.scene.output.sheet_width_mm = 0.5 * wish.width / scale;  // strokes as large as the target's
  sheet.scene.terrain.synthetic->seed = wish.seed;
  sheet.scene.seed = wish.seed;
  sheet.scene.light = target.scene.light;
  // The light falls from the same side of the picture as in the target.
  sheet.scene.sun.azimuth_deg =
      std::remainder(sheet.scene.camera.azimuth_deg + target.view.sun.azimuth_deg - target.view.camera.azimuth_deg, 360.0);
  if (sheet.scene.sun.azimuth_deg < 0.0) sheet.scene.sun.azimuth_deg += 360.0;
  if (target.palette.winter) sheet.scene.land_cover.settings.emplace_back("winter", 1.0);
  return sheet;
}

}  // namespace

PaintedExemplar paint_sheet(const SceneExemplar& wish, const Stage& target, Progress& progress) {
  const LoadedScene scene = sheet_scene(wish, target);
  Stage stage = set_stage(scene, progress);
  stage.palette = target.palette;
  const LitPicture picture = make_lit_picture(stage, {0, 0, wish.width, wish.height}, 32, progress);
  StrokeParameters strokes;
  strokes.pixels_per_unit = stage.scene.pixels_per_unit();
  strokes.winter = stage.palette.winter;
  strokes.sun_side = stage.view.sun_image_x < 0.0 ? -1.0 : 1.0;
  strokes.seed = wish.seed;
  const StrokeLayers layers{.sky = false, .ground = true, .accents = true, .upright = false};

  PaintedExemplar painted;
  Painting painting = paint_strokes(picture.ground.colour, picture.guidance, picture.ground, layers, strokes, progress);
  PaintedClasses classes = find_painted_classes(painting.sources, picture.guidance, picture.ground.colour);
  painted.picture = std::move(painting.picture);
  painted.base = std::move(classes.base);
  painted.exemplar.name = "painted sheet";
  painted.exemplar.guides = make_guide_stack(picture.guidance, classes.land_cover);
  painted.exemplar.picture = seam_picture(painted, painted.exemplar.guides.label, target.scene.synthesis.residual);
  return painted;
}

}  // namespace belvedere
