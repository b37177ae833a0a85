#include "tools/cli/new/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/cache/cache.h"
#include "base/files/output_file.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/scene_settings.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/world.h"
#include "terrain/io/http_access.h"
#include "terrain/io/raster_io.h"
#include "tools/cli/contact/scene_sweep.h"

namespace belvedere::tools {
namespace {

std::string terrain_of(const LoadedScene& loaded) {
  Scene terrain;
  terrain.terrain = loaded.scene.terrain;
  return write_scene(terrain);
}

// Data on a server are not in the cache: the shared ground of all drafts is read once, into a file.
void share_ground(std::vector<LoadedScene>& drafts, const std::string& folder, const Cache& cache) {
  const std::vector<SceneSource>& sources = drafts.front().scene.terrain.sources;
  if (std::none_of(sources.begin(), sources.end(),
                   [](const SceneSource& source) { return is_address(source.file); }))
    return;
  const auto other = [&](const LoadedScene& draft) {
    return terrain_of(draft) != terrain_of(drafts.front());
  };
  if (drafts.size() < 2 || std::any_of(drafts.begin(), drafts.end(), other)) return;
  LoadedScene whole = drafts.front();
  whole.scene.terrain.preview_mcells = 0.0;
  const Dem dem = make_scene_dem(whole, silent_progress(), cache);
  const std::string name = "ground_of_all_drafts.tif";
  write_raster((std::filesystem::path(folder) / name).string(),
               Raster<float>{known_altitude(dem), dem.transform, dem.crs});
  for (LoadedScene& draft : drafts) {
    draft.allowed_folders.insert(draft.allowed_folders.begin(), folder);
    SceneTerrain& terrain = draft.scene.terrain;
    terrain.sources.assign(1, {});
    terrain.sources.front().file = name;
    terrain.dem.cell_m = 0.0;
    terrain.dem.extent.reset();
  }
}

}  // namespace

LoadedScene make_small_draft(LoadedScene scene, int width_px, double mcells) {
  const int height_px = std::max(
      64, static_cast<int>(std::lround(static_cast<double>(width_px) * scene.scene.output.height /
                                       scene.scene.output.width)));
  scene.scene = make_draft(std::move(scene.scene));
  scene.scene.output.width = width_px;
  scene.scene.output.height = height_px;
  scene.scene.output.formats = {"png"};
  scene.scene.terrain.preview_mcells = mcells;
  return scene;
}

void write_contact_sheet(const std::string& path, std::vector<LoadedScene> drafts,
                         const std::vector<std::string>& captions, const Run& run,
                         const ContactSheetParameters& parameters) {
  // Land cover depends on the ground alone: the second picture reuses what the first computed, also
  // without a cache.
  const ScratchFolder kept;
  const Cache own({.folder = kept.path(), .limit_bytes = 0});
  // One progress display, instead of all stages of every picture.
  const Run quiet{.threads = run.threads,
                  .memory_bytes = run.memory_bytes,
                  .tile_px = run.tile_px,
                  .progress = silent_progress(),
                  .cache = run.cache.is_on() ? run.cache : own};
  run.progress.begin("drawing the proposals", static_cast<double>(drafts.size()));
  share_ground(drafts, kept.path(), quiet.cache);
  PictureTable sheet;
  sheet.columns.resize(std::min(static_cast<std::size_t>(parameters.columns), drafts.size()));
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    const ScratchFolder folder;
    render(drafts[i], folder.path(), quiet);
    run.progress.advance(1.0);
    if (i % sheet.columns.size() == 0) sheet.cells.emplace_back();
    sheet.cells.back().push_back(
        {read_picture((std::filesystem::path(folder.path()) / "panorama.png").string()),
         captions[i]});
  }
  write_png8(path, draw_table(sheet), {});
}

}  // namespace belvedere::tools
