#include "renderer/live/live_view.h"

#include <algorithm>

#include "base/files/output_file.h"
#include "renderer/image/display_conversion.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/copy_plan.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/picture_legend.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_work.h"
#include "renderer/scene/scene_settings.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/world/scene_features.h"

namespace belvedere {
namespace {

constexpr double preview_mcells = 1.0;

}  // namespace

const std::vector<Rung>& rungs() {
  static const std::vector<std::string> without_forms = {"rock relief", "strokes"};
  static const std::vector<Rung> all = {
      {.name = "light and colour",
       .without = without_forms,
       .max_width_px = 360,
       .strokes = false,
       .names = false},
      {.name = "larger", .without = without_forms, .strokes = false},
      {.name = "strokes", .without = {"fine light"}},
      {.name = "as rendered", .without = {}}};
  return all;
}

std::vector<std::string> lacks_of(const LoadedScene& loaded, const Rung& rung) {
  std::vector<std::string> out = rung.without;
  if (rung.strokes) return out;
  if (!loaded.scene.air.mist.empty()) out.emplace_back("mist");
  if (loaded.scene.any_features()) out.emplace_back("features");
  return out;
}

LoadedScene scene_of_rung(const LoadedScene& loaded, const Rung& rung) {
  LoadedScene out = loaded;
  Scene& scene = out.scene;
  scene.output = with_width(scene.output, std::min(scene.output.width, rung.max_width_px));
  if (rung.is_last()) return out;
  scene.terrain.preview_mcells = preview_mcells;
  scene.sampling.pixel_samples = 1;
  scene.sampling.shadow_rays = 1;
  scene.sampling.sky_directions = std::min(scene.sampling.sky_directions, 4);
  if (scene.water.mirror == "traced") scene.water.mirror = "column";
  scene.synthesis.enabled = false;
  return out;
}

namespace {

using B = GuidanceBuffers;

constexpr int live_tile_px = 256;

// The tiles of a picture, those nearest to its middle first.
std::vector<PixelRect> tiles_from_middle(PixelRect sheet) {
  std::vector<PixelRect> tiles;
  for (int y = sheet.y0; y < sheet.y1; y += live_tile_px)
    for (int x = sheet.x0; x < sheet.x1; x += live_tile_px)
      tiles.push_back(intersection(sheet, {x, y, x + live_tile_px, y + live_tile_px}));
  const auto distance = [&](const PixelRect& tile) {
    const int dx = tile.x0 + tile.x1 - sheet.x1;
    const int dy = tile.y0 + tile.y1 - sheet.y1;
    return dx * dx + dy * dy;
  };
  std::stable_sort(tiles.begin(), tiles.end(), [&](const PixelRect& a, const PixelRect& b) {
    return distance(a) < distance(b);
  });
  return tiles;
}

template <class Read>
Grid<glm::vec3> read_tiles(PixelRect sheet, const Read& read, const LiveView::UseTile& use_tile) {
  if (!use_tile) return read(sheet);
  Grid<glm::vec3> whole(sheet.width(), sheet.height());
  for (const PixelRect& tile : tiles_from_middle(sheet)) {
    const Grid<glm::vec3> part = read(tile);
    copy_part(whole, part, tile.x0, tile.y0);
    use_tile(tile, part);
  }
  return whole;
}

}  // namespace

GroundSize LiveView::size_of(const LoadedScene& loaded) {
  return *SceneValues(loaded, &paint_, silent_progress())
              .make<GroundSize>(
                  "size", [](Scene& to, const Scene& from) { to.terrain = from.terrain; }, {},
                  [](const Making& m) { return ground_size_of(m.scene); });
}

namespace {

// Names at the print's size, whatever the size of the picture.
std::shared_ptr<const NamedSheet> names_over(const LoadedScene& given, const World& world,
                                             const LivePicture& picture, const Run& run) {
  const Scene& scene = given.scene;
  if ((!scene.labels.any() && !scene.margin) || !world.terrain.windows.empty()) return nullptr;
  BareView bare = bare_view_of(world);
  bare.view.camera.width = scene.output.width;
  bare.view.camera.height = scene.output.height;
  bare.camera = make_camera(bare.view.camera);
  const PictureOverview overview{.sheet_px = bare.camera->size(),
                                 .factor = std::max(1, scene.output.width / picture.colour.width()),
                                 .classes = picture.seen.land_cover,
                                 .colours = picture.colour};
  PictureLegend legend;
  legend.luminance = luminance_from_bytes(luminance_to_bytes(overview));
  if (scene.margin && scene.margin->legend)
    legend.classes = find_legend(overview, legend_swatch_px(given));
  return std::make_shared<const NamedSheet>(lay_out_names(given, bare, legend, true, run.progress));
}

}  // namespace

// Ground that is much finer than the previews' would take a gigabyte between two pictures that take
// long anyway.
ValueStore* LiveView::kept_for(const Rung& rung, const GroundSize& ground) {
  constexpr double small_mcells = 2.0;
  if (!rung.is_last()) return &coarse_;
  return ground.mcells <= small_mcells ? &fine_ : nullptr;
}

LivePicture LiveView::paint(const LoadedScene& given, const Rung& rung, const Run& run,
                            const UseTile& use_tile) {
  const RunLimits limits(run);
  const GroundSize ground = size_of(given);
  const LoadedScene loaded = scene_of_rung(given, rung);
  SheetRequest request{.panorama = rung.strokes, .part = rung.part, .block_px = 1024};
  const PixelRect sheet = region_of(loaded.scene, request);
  if (use_tile) request.block_px = live_tile_px;
  if (rung.is_last()) require_inputs(loaded);

  const SheetWorkParameters parameters{.scratch_folder = {},
                                       .rock_relief = rung.strokes,
                                       .tile_px = use_tile ? 0 : 1024,
                                       .kept = kept_for(rung, ground),
                                       .kept_paint = &paint_,
                                       .keep_rays = !rung.strokes};
  SheetWork work(loaded, request, parameters, run, run);
  LivePicture picture;
  if (rung.strokes) {
    const bool copied = is_copied(loaded.scene, request);
    CopyPlan plan;
    if (copied) {
      const ScratchFolder scratch;
      const WorkFolder kept(scratch.path(), identify(loaded, request), WorkMode::begin);
      plan = make_copy_plan(loaded, work.world, work.paint, work.ground, work.scratch, kept, run);
    }
    const DrawnFeatures features =
        draw_scene_features(loaded, work.world, work.ground.inputs->strokes.winter, run.progress);
    const PictureStages stages =
        add_picture_stages(work.graph, work.ground, copied ? &plan : nullptr, features);
    // The files of `render` have been through linear light.
    std::optional<DisplayConversion> display;
    if (rung.is_last()) display.emplace(read_output_colour(loaded).display);
    const auto read = [&](PixelRect tile) {
      Grid<glm::vec3> colour = stages.picture->read(tile).colour;
      return display ? display->convert(decode_srgb(colour)) : colour;
    };
    picture.colour = read_tiles(sheet, read, use_tile);
  } else {
    picture.colour = read_tiles(
        sheet, [&](PixelRect tile) { return work.ground.base->read(tile).colour; }, use_tile);
  }
  picture.seen = work.ground.raised->read(
      sheet, with_channels({&B::depth_m, &B::position_m, &B::altitude_m, &B::land_cover},
                           work.world.surface->origin));
  picture.view = work.world.view;
  picture.crs = work.world.dem->crs;
  picture.halved = rung.is_last() ? 0 : work.world.dem->halved;
  if (picture.halved > 0) picture.shortest_m = work.world.dem->cell_m();
  if (rung.names) picture.sheet = names_over(given, work.world, picture, run);
  return picture;
}

LiveView::Ground LiveView::ground(const LoadedScene& given, const Run& run) {
  const RunLimits limits(run);
  const LoadedScene loaded = scene_of_rung(given, rungs().front());
  const World world = make_world(loaded, run.progress, run.cache, {}, &coarse_);
  return {world.dem, world.land_cover,
          std::shared_ptr<const Grid<float>>(world.ground.terrain, &world.terrain.generalized_m),
          world.view};
}

}  // namespace belvedere
