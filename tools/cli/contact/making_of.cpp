#include "tools/cli/contact/making_of.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/files/output_file.h"
#include "base/land_cover_class.h"
#include "renderer/pipeline/copy_plan.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/stages.h"
#include "renderer/trace/sketch/relief_sketch.h"
#include "renderer/world/scene_features.h"
#include "renderer/world/season/scene_season.h"
#include "renderer/world/world.h"
#include "tools/cli/contact/scene_sweep.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

constexpr std::uint64_t tile_bytes =
    256ULL << 20U;  // that stages keep in memory before they use a scratch file

// Relief of a ground as seen from the scene's camera.
Grid<glm::vec3> relief(const BareView& bare, const Grid<float>& altitude_m,
                       const Deformation& deformation) {
  const DeformedSurface surface =
      deform(altitude_m, bare.dem->transform, glm::dvec3(bare.view.viewer_xy, 0.0), deformation);
  const Tracer tracer(surface);
  return make_relief_sketch(altitude_m, bare.dem->transform, {}, deformation, tracer, *bare.camera,
                            bare.view.sun_direction);
}

void add_ground(std::vector<MakingStep>& steps, const LoadedScene& loaded, const Run& run) {
  const BareView bare = make_bare_view(loaded, run.progress, run.cache);
  run.progress.begin("drawing the relief", 3.0);
  const auto add = [&](const char* file, const char* caption, const Grid<float>& altitude_m,
                       const Deformation& deformation) {
    steps.push_back({file, caption, relief(bare, altitude_m, deformation)});
    run.progress.advance(1.0);
  };
  add("measured", "the ground as measured", bare.dem->altitude_m, Deformation());
  add("generalized", "generalized for this view", *bare.generalized_m, Deformation());
  add("bent", "raised, moved and bent", *bare.generalized_m, bare.deformation);
}

Grid<glm::vec3> class_picture(const GuidanceBuffers& guidance) {
  Grid<glm::vec3> out(guidance.width(), guidance.height(), no_class_colour);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!guidance.is_sky(i))
      out[i] = class_colour(static_cast<std::uint8_t>(guidance.land_cover[i]));
  return out;
}

Grid<glm::vec3> tone_picture(const GuidanceBuffers& guidance) {
  Grid<glm::vec3> out(guidance.width(), guidance.height(), no_class_colour);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!guidance.is_sky(i)) out[i] = glm::vec3(std::clamp(guidance.tone[i], 0.F, 1.F));
  return out;
}

// From here on, by the stages of rendering itself.
void add_paint(std::vector<MakingStep>& steps, const LoadedScene& loaded, const Run& run) {
  const ScratchFolder scratch;
  const WorkFolder work(scratch.path() + "/work", {}, WorkMode::begin);
  ScenePaint paint = read_scene_paint(loaded, run.progress);
  const World world = make_world(loaded, run.progress, run.cache);
  paint.palette = palette_for_location(paint.palette, loaded, *world.dem);
  TileStore::Place position{work.folder(), tile_bytes};
  const SheetView view = view_of(world);
  StageGraph graph(position, run.progress);
  const GroundStages ground =
      add_ground_stages(graph, make_ground_inputs(world, view, paint.palette, run),
                        choose_block_px(world.scene, view.pixels_per_unit));
  const PixelRect sheet = ground.lit->sheet();
  const GuidanceBuffers guidance = ground.lit->read(sheet);
  steps.push_back({"classes", "land cover", class_picture(guidance)});
  steps.push_back({"tone", "light and shade", tone_picture(guidance)});
  steps.push_back({"base", "colours of the palette", ground.base->read(sheet).colour});
  const bool copied = world.scene.copies();
  CopyPlan plan =
      copied ? make_copy_plan(loaded, world, paint, ground, position, work, run) : CopyPlan{};
  const DrawnFeatures features =
      draw_scene_features(loaded, world, ground.inputs->strokes.winter, run.progress);
  const PictureStages picture =
      add_picture_stages(graph, ground, copied ? &plan : nullptr, features);
  if (copied)
    steps.push_back({"copied", "paint copied from paintings", picture.copied->read(sheet)});
  steps.push_back({"strokes", "strokes over it: the picture", picture.picture->read(sheet).colour});
}

}  // namespace

glm::vec3 class_colour(std::uint8_t label) {
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (static_cast<std::uint8_t>(info.id) == label)
      return glm::vec3((info.rgb >> 16U) & 255U, (info.rgb >> 8U) & 255U, info.rgb & 255U) / 255.F;
  return no_class_colour;
}

std::vector<MakingStep> make_making_of(const LoadedScene& loaded, const Run& run) {
  const RunLimits limits(run);
  std::vector<MakingStep> steps;
  add_ground(steps, loaded, run);
  add_paint(steps, loaded, run);
  return steps;
}

Grid<glm::vec3> draw_making_of(const std::vector<MakingStep>& steps, int step_px) {
  PictureTable table;
  table.columns = {"", ""};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i % 2 == 0) table.cells.emplace_back();
    table.cells.back().push_back({reduced_picture(steps[i].picture, step_px),
                                  fmt::format("{}  {}", i + 1, steps[i].caption)});
  }
  return draw_table(table);
}

}  // namespace belvedere::tools
