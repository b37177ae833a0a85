#include "renderer/pipeline/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/instruction_set.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "renderer/compose/massifs.h"
#include "renderer/compose/view_candidates.h"
#include "renderer/compose/view_changes.h"
#include "renderer/exemplar/exemplars.h"
#include "renderer/paint/guides.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/scene/scene_table.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/trace/relief_sketch.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/ground_windows.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/viewer_check.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

ViewEvaluation evaluate_view(const CoarseAltitudes& region, const View& view,
                             double widen_valleys_m) {
  ViewEvaluation out;
  const Projection* projection = find_projection(view.camera.projection);
  if (projection == nullptr || projection->widest_deg <= 0.0) {
    out.why_not = "a parallel projection has neither sky nor horizon";
    return out;
  }
  const Deformation deformation(view.deform, view.viewer_xy);
  const bool rearranged = !view.deform.summits.empty() || deformation.moves_in_plan();
  std::function<glm::dvec3(glm::dvec3)> move;
  if (rearranged) move = [&](glm::dvec3 p) { return deformation.rearranged(p); };
  CoarseGround ground;
  try {
    ground = coarse_ground_of(region, move);
    if (widen_valleys_m > 0.0) ground = widened_ground(ground, widen_valleys_m);
  } catch (const Error& problem) {
    out.why_not = problem.found();
    return out;
  }
  const Massifs massifs = find_massifs(ground);
  const CameraPicture picture(view.camera);
  const bool plane = view.camera.projection == "perspective";
  const double width = to_radians(view.camera.field_of_view_deg);
  const double shape = static_cast<double>(view.camera.height) / view.camera.width;
  SightModel sight{
      .picture = picture,
      .viewer = view.viewer_xy,
      .eye_m = view.camera.eye.z,
      .azimuth_deg = view.camera.azimuth_deg,
      .width = width,
      .height = plane ? 2.0 * exact::atan(exact::tan(0.5 * width) * shape) : width * shape,
      .directions = camera_directions(view.camera, MeasureParameters{}.columns),
      .distance_m = {},
      .drop_m = {},
      .exaggeration = {},
      .base_m = view.deform.exaggeration_base_m,
      .rim_fade_m = view.air.rim_fade_m,
      .air_from_m = view.air.from_m,
      .air_scale_m = view.air.scale_m,
      .haze = view.air.haze};
  const ViewReach reach = find_reach(ground, deformation, view.camera);
  sight.near_m = reach.near_m;
  sight.far_m = reach.far_m;
  if (!(sight.far_m > 0.0)) {
    out.why_not = "there are no data in the direction of the view";
    return out;
  }
  sight.distance_m = growing_distances(std::max(1.0, 0.5 * sight.near_m), 1.12 * sight.far_m,
                                       MeasureParameters{}.steps);
  for (const double d : sight.distance_m) {
    sight.drop_m.push_back(deformation.drop_m(d));
    sight.exaggeration.push_back(deformation.exaggeration(d));
  }
  const ViewMeasures measures = measure_view(ground, sight, massifs.anchors);
  ScoreContext context{
      .lone = massifs.lone, .plateau = ground.plateau, .main = -1, .anchors = massifs.anchors};
  const bool leads = std::any_of(measures.anchors.begin(), measures.anchors.end(),
                                 [](const AnchorSight& anchor) { return anchor.inside; });
  if (leads) context.main = leading_anchor(measures, context);
  out.terms = score_terms(measures, context);
  out.merit = merit(out.terms, context);
  out.subject = context.main < 0
                    ? "no mountain, canyon or shore as a main subject"
                    : describe_anchor(massifs.anchors[static_cast<std::size_t>(context.main)]);
  out.near_m = sight.near_m;
  out.far_m = sight.far_m;
  return out;
}

namespace {

constexpr int check_width_px = 480;

int small_width(const SceneOutput& output) { return std::min(output.width, check_width_px); }

int small_height(const SceneOutput& output) {
  constexpr int min = 16;
  return std::max(min, static_cast<int>(static_cast<double>(output.height) * small_width(output) /
                                        output.width));
}

// The view with few pixels and only the light that guides need.
LoadedScene small(const LoadedScene& scene) {
  LoadedScene out = scene;
  out.scene.output.width = small_width(scene.scene.output);
  out.scene.output.height = small_height(scene.scene.output);
  out.scene.sampling.pixel_samples = 1;
  out.scene.sampling.shadow_rays = 1;
  out.scene.sampling.sky_directions = 0;
  return out;
}

PixelRect whole_picture(const LoadedScene& view) {
  return {0, 0, view.scene.output.width, view.scene.output.height};
}

// The parts of a World needed to determine the classes in its picture; refused for the same
// reasons.
struct Sight {
  std::shared_ptr<const Dem> dem;
  CoarseAltitudes region;  // the data at reduced resolution
  std::string levels;      // for a DEM larger than memory: the cells that rendering would use
  View view;
  std::vector<ClassArea> areas;
  Grid<LandCoverClass> classes;  // of the small picture
  std::vector<SeenRange> ranges;
  std::vector<ProposedLight> proposed;
};

// Light on the ranges of the small picture.
void look_at_light(Sight& sight, const LoadedScene& loaded, const TerrainModel& terrain,
                   const Tracer& tracer, const Camera& camera, bool propose, Progress& progress) {
  const std::vector<SeenSlope> slopes =
      see_slopes(terrain, sight.view.deform.exaggeration, tracer, camera, 2);
  sight.ranges = find_ranges(slopes);
  light_ranges(sight.ranges, slopes, tracer, sight.view.sun_direction,
               make_light_field(loaded, *sight.dem, sight.view, progress).get());
  for (SeenRange& range : sight.ranges) range.slopes.clear();
  if (propose) sight.proposed = propose_light(loaded, *sight.dem, sight.view, slopes, tracer);
}

Sight look(const LoadedScene& loaded, Progress& progress, const Cache& cache, bool propose) {
  const Scene& scene = loaded.scene;
  in_section("sampling", [&] { return choose_instruction_set(scene.tracing.instruction_set); });
  Sight sight;
  SceneDem opened = open_scene_dem(loaded, progress, cache);
  sight.view = make_view(scene, opened.dem, progress, ground_altitude_of(opened), &opened.region);
  sight.region = std::move(opened.region);
  if (opened.levels) {
    const RasterFrame& frame = opened.levels->frame();
    sight.levels = describe(plan_ground(frame, opened.dem, sight.view, opened.max_cells), frame);
  }
  sight.dem = std::make_shared<const Dem>(std::move(opened.dem));
  opened = {};
  PatchResult cover = make_scene_patches(loaded, *sight.dem, progress, cache);
  if (scene.land_cover.patches.smallest_m2 > 0.0) sight.areas = std::move(cover.areas);

  TerrainModel terrain;
  terrain.dem = sight.dem;
  terrain.land_cover = std::make_shared<const LandCover>(std::move(cover.cover));
  GeneralizedTerrain ground = generalize_for_view(loaded, *sight.dem, terrain.land_cover.get(),
                                                  sight.view, progress, cache);
  terrain.generalized_m = std::move(ground.altitude_m);
  terrain.came_from = std::move(ground.came_from);
  terrain.goes_to = std::move(ground.goes_to);
  const Deformation deformation(sight.view.deform, sight.view.viewer_xy);
  check_folds(scene.deform, terrain, deformation, *make_camera(sight.view.camera), progress);
  const DeformedSurface surface = deform(terrain.generalized_m, sight.dem->transform,
                                         glm::dvec3(sight.view.viewer_xy, 0.0), deformation);
  CameraParameters camera = sight.view.camera;
  camera.width = small_width(scene.output);
  camera.height = small_height(scene.output);
  progress.begin("looking", 0.0);
  const Tracer tracer(surface, scene.tracing);
  const std::unique_ptr<const Camera> small_camera = make_camera(camera);
  check_ground_in_view(*sight.dem, *make_camera(sight.view.camera), tracer, progress);
  sight.classes = trace_classes(terrain, tracer, *small_camera);
  look_at_light(sight, loaded, terrain, tracer, *small_camera, propose, progress);
  return sight;
}

}  // namespace

SceneReport check_scene(const LoadedScene& scene, Progress& progress, const Cache& cache,
                        bool propose) {
  require_inputs(scene);
  read_output_colour(scene);
  SceneReport report;
  report.inputs = scene_inputs(scene);
  const ScenePaint paint = read_scene_paint(scene, progress);
  Sight sight = look(scene, progress, cache, propose);
  report.view = sight.view;
  report.evaluation = evaluate_view(sight.region, sight.view,
                                    static_cast<double>(scene.scene.generalize.valleys.width_m));
  report.crs = sight.dem->crs.empty() ? std::string("none") : describe_crs(sight.dem->crs);
  report.cells_wide = sight.dem->width();
  report.cells_high = sight.dem->height();
  report.cell_m = sight.dem->cell_m();
  report.larger_than_memory = std::move(sight.levels);
  report.land_cover = std::move(sight.areas);
  report.ranges = std::move(sight.ranges);
  report.proposed = std::move(sight.proposed);
  if (names_climate(scene.scene)) make_scene_climate(scene, *sight.dem, progress);

  std::array<double, land_cover_class_count> count{};
  for (const LandCoverClass id : sight.classes) count[static_cast<std::size_t>(id)] += 1.0;
  for (const LandCoverClassInfo& info : land_cover_classes())
    if (const double share =
            count[static_cast<std::size_t>(info.id)] / static_cast<double>(sight.classes.size());
        share > 0.0)
      report.classes.emplace_back(info.id, share);
  if (!scene.scene.copies()) return report;

  const ExemplarClasses exemplars = look_at_classes(scene, paint.paintings);
  report.exemplars = exemplars.names;
  for (const ExemplarClasses::Flags& offered : exemplars.offered_by) {
    std::vector<LandCoverClass>& own = report.exemplar_classes.emplace_back();
    for (const auto& [id, share] : report.classes)
      if (offered[static_cast<std::size_t>(id)]) own.push_back(id);
  }
  std::vector<std::string> missing;
  for (const auto& [id, share] : report.classes) {
    if (id == LandCoverClass::sky || exemplars.offered[static_cast<std::size_t>(id)]) continue;
    const ClassPairs fallback = with_stand_ins(scene.scene.synthesis.fallback);
    const auto way_out =
        std::find_if(fallback.begin(), fallback.end(),
                     [&, without = id](const auto& pair) { return pair.first == without; });
    if (way_out == fallback.end() || !exemplars.offered[static_cast<std::size_t>(way_out->second)])
      missing.emplace_back(class_name(id));
  }
  if (!missing.empty())
    throw Error(ErrorKind::usage, scene.name,
                fmt::format("no exemplar shows how to paint {}, which is in the picture",
                            fmt::join(missing, ", ")),
                fmt::format("an exemplar with {}, or [synthesis] fallback = {{ {} = \"…\" }}",
                            missing.size() == 1 ? "it" : "them", missing.front()));
  return report;
}

SceneExemplars look_at_exemplars(const LoadedScene& scene, Progress& progress, const Cache& cache) {
  require_scene_files(scene);
  check_paintings(scene);
  const LoadedScene view = small(scene);
  const Palette named = read_scene_palette(scene, progress);
  const World world = make_world(view, progress, cache);
  const Palette palette = palette_for_location(named, scene, *world.dem);
  const LitPicture picture =
      make_lit_picture(world, palette, whole_picture(view), {.progress = progress});
  const double small_pixels =
      static_cast<double>(view.scene.output.width) * view.scene.output.height;
  // Example sheets are painted for the picture itself: their strokes have its size.
  return {.exemplars = make_exemplars(scene, world.view, palette, read_scans(scene, progress),
                                      progress, cache),
          .view = make_guide_stack(picture.guidance, picture.guidance.land_cover),
          .pixels_of_picture = static_cast<double>(scene.scene.output.width) *
                               scene.scene.output.height / small_pixels};
}

}  // namespace belvedere
