#include "tools/cli/new/contact_sheet.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "base/cache/cache.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draft.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/valley_view.h"
#include "terrain/io/raster_io.h"
#include "tools/cli/lock/scratch_folder.h"
#include "tools/report/picture_text.h"

namespace belvedere::tools {
namespace {

constexpr int border_px = 12;
constexpr int caption_px = text_height * caption_scale + border_px;
const glm::vec3 sheet_paper(0.96F, 0.95F, 0.92F);
const glm::vec3 sheet_ink(0.15F, 0.15F, 0.18F);

void lay(Grid<glm::vec3>& sheet, const Grid<glm::vec3>& picture, int x0, int y0) {
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      if (sheet.contains(x0 + x, y0 + y)) sheet(x0 + x, y0 + y) = picture(x, y);
}

std::string terrain_of(const LoadedScene& loaded) {
  Scene terrain;
  terrain.terrain = loaded.scene.terrain;
  return write_scene(terrain);
}

// Reads the ground that all drafts have in common once, into a file of theirs: bringing data into the cells of drafts takes longer than
// reading what came of it.
void share_ground(std::vector<LoadedScene>& drafts, const std::string& folder, const Cache& cache) {
  const auto other = [&](const LoadedScene& draft) { return terrain_of(draft) != terrain_of(drafts.front()); };
  if (drafts.size() < 2 || drafts.front().scene.terrain.sources.empty() || std::any_of(drafts.begin(), drafts.end(), other)) return;
  const Dem dem = make_scene_dem(drafts.front(), silent_progress(), cache);
  const std::string name = "ground_of_all_drafts.tif";
  write_raster((std::filesystem::path(folder) / name).string(), Raster<float>{known_altitude(dem), dem.transform, dem.crs});
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

LoadedScene make_small_draft(LoadedScene scene, int width_px, double cell_m) {
  const int height_px =
      std::max(64, static_cast<int>(std::lround(static_cast<double>(width_px) * scene.scene.output.height / scene.scene.output.width)));
  scene.scene = make_draft(std::move(scene.scene));
  scene.scene.output.width = width_px;
  scene.scene.output.height = height_px;
  scene.scene.output.formats = {"png"};
  scene.scene.terrain.dem.cell_m = std::max(scene.scene.terrain.dem.cell_m, cell_m);
  return scene;
}

void write_contact_sheet(const std::string& path, std::vector<LoadedScene> drafts, const std::vector<std::string>& captions, const Run& run,
                         const ContactSheetParameters& parameters) {
  // Land cover hangs on the ground alone: the second picture finds what the first made, also where nothing is kept from run to run.
  const ScratchFolder kept;
  const Cache own({.folder = kept.path(), .limit_bytes = 0});
  // One stage to watch, instead of all stages of every picture.
  const Run quiet{.threads = run.threads,
                  .memory_bytes = run.memory_bytes,
                  .tile_px = run.tile_px,
                  .progress = silent_progress(),
                  .cache = run.cache.is_on() ? run.cache : own};
  run.progress.begin("drawing the proposals", static_cast<double>(drafts.size()));
  share_ground(drafts, kept.path(), quiet.cache);
  std::vector<Grid<glm::vec3>> pictures;
  for (const LoadedScene& draft : drafts) {
    const ScratchFolder folder;
    render(draft, folder.path(), quiet);
    run.progress.advance(1.0);
    pictures.push_back(read_picture((std::filesystem::path(folder.path()) / "panorama.png").string()));
  }
  int width = 0, height = 0;
  for (const Grid<glm::vec3>& picture : pictures) width = std::max(width, picture.width()), height = std::max(height, picture.height());
  const int columns = std::min(parameters.columns, static_cast<int>(pictures.size()));
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / std::max(1, columns);
  Grid<glm::vec3> sheet(columns * (width + border_px) + border_px, rows * (height + caption_px + border_px) + border_px, sheet_paper);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int x = border_px + static_cast<int>(i) % columns * (width + border_px);
    const int y = border_px + static_cast<int>(i) / columns * (height + caption_px + border_px);
    lay(sheet, pictures[i], x, y);
    draw_text(sheet, x, y + height + border_px / 2, captions[i], sheet_ink, caption_scale);
  }
  write_png8(path, sheet, {});
}

}  // namespace belvedere::tools
