#include "renderer/pipeline/scene_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "renderer/exemplar/exemplars.h"
#include "renderer/paint/guides.h"
#include "renderer/pipeline/output_color.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/world/lit_picture.h"
#include "renderer/world/scene_terrain.h"
#include "terrain/io/raster_io.h"

namespace belvedere {
namespace {

constexpr int check_width_px = 480;

// The view with few pixels and no more light than it takes: classes are all that is looked at.
LoadedScene small(const LoadedScene& scene) {
  LoadedScene out = scene;
  const int width = std::min(scene.scene.output.width, check_width_px);
  out.scene.output.height =
      std::max(16, static_cast<int>(static_cast<double>(scene.scene.output.height) * width / scene.scene.output.width));
  out.scene.output.width = width;
  // Example sheets are painted at half their size: enough to see which classes they have.
  if (out.scene.exemplars.empty()) out.scene.exemplars.emplace_back();
  for (SceneExemplar& exemplar : out.scene.exemplars) {
    exemplar.width /= 2;
    exemplar.height /= 2;
  }
  out.scene.sampling.pixel_samples = 1;
  out.scene.sampling.shadow_rays = 1;
  out.scene.sampling.sky_directions = 0;
  return out;
}

PixelRect whole_picture(const LoadedScene& view) { return {0, 0, view.scene.output.width, view.scene.output.height}; }

std::vector<bool> labels_of(const std::vector<PaintedExemplar>& exemplars) {
  std::vector<bool> found(256, false);
  for (const PaintedExemplar& painted : exemplars)
    for (const std::uint8_t label : painted.exemplar.guides.label) found[label] = true;
  return found;
}

}  // namespace

SceneReport check_scene(const LoadedScene& scene, Progress& progress) {
  require_inputs(scene);
  read_output_color(scene);
  SceneReport report;
  report.inputs = scene_inputs(scene);
  const LoadedScene view = small(scene);
  ScenePaint paint = read_scene_paint(view, progress);
  const World world(view, progress);
  if (scene.scene.land_cover.patches.smallest_m2 > 0.0) report.land_cover = make_scene_patches(scene, *world.dem, progress).areas;
  report.view = world.view;
  report.crs = world.dem->crs.empty() ? std::string("none") : describe_crs(world.dem->crs);
  report.cells_wide = world.dem->width();
  report.cells_high = world.dem->height();
  report.cell_m = world.dem->cell_m();

  const LitPicture picture = make_lit_picture(world, paint.palette, whole_picture(view), {.progress = progress});
  std::array<double, land_cover_class_count> count{};
  for (const LandCoverClass id : picture.guidance.land_cover) count[static_cast<std::size_t>(id)] += 1.0;
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (const double share = count[static_cast<std::size_t>(info.id)] / static_cast<double>(picture.guidance.land_cover.size());
        share > 0.0)
      report.classes.emplace_back(info.id, share);
  if (!scene.scene.synthesis.enabled) return report;

  const std::vector<PaintedExemplar> exemplars = make_exemplars(view, world.view, paint.palette, std::move(paint.paintings), progress);
  for (const PaintedExemplar& painted : exemplars) report.exemplars.push_back(painted.exemplar.name);
  const std::vector<bool> has = labels_of(exemplars);
  std::vector<std::string> missing;
  for (const auto& [id, share] : report.classes) {
    if (id == LandCoverClass::sky || has[static_cast<std::size_t>(id)]) continue;
    const ClassPairs fallback = with_stand_ins(scene.scene.synthesis.fallback);
    const auto way_out =
        std::find_if(fallback.begin(), fallback.end(), [&, without = id](const auto& pair) { return pair.first == without; });
    if (way_out == fallback.end() || !has[static_cast<std::size_t>(way_out->second)]) missing.emplace_back(class_name(id));
  }
  if (!missing.empty())
    throw Error(ErrorKind::usage, scene.name,
                fmt::format("no exemplar shows how to paint {}, which the picture has", fmt::join(missing, ", ")),
                fmt::format("an exemplar with {}, or [synthesis] fallback = {{ {} = \"…\" }}", missing.size() == 1 ? "it" : "them",
                            missing.front()));
  return report;
}

SceneExemplars look_at_exemplars(const LoadedScene& scene, Progress& progress) {
  require_scene_files(scene);
  check_paintings(scene);
  const LoadedScene view = small(scene);
  const Palette palette = read_scene_palette(scene, progress);
  const World world(view, progress);
  const LitPicture picture = make_lit_picture(world, palette, whole_picture(view), {.progress = progress});
  const double small_pixels = static_cast<double>(view.scene.output.width) * view.scene.output.height;
  // Example sheets are painted for the picture itself: their strokes are as large as its.
  return {.exemplars = make_exemplars(scene, world.view, palette, read_scans(scene, progress), progress),
          .view = make_guide_stack(picture.guidance, picture.guidance.land_cover),
          .pixels_of_picture = static_cast<double>(scene.scene.output.width) * scene.scene.output.height / small_pixels};
}

}  // namespace belvedere
