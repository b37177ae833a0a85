#include "renderer/pipeline/sheet_memory.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "base/memory_limit.h"
#include "renderer/exemplar/example_sheet.h"
#include "renderer/ground/cached_products.h"
#include "renderer/stages/stages.h"

namespace belvedere {
namespace {

// Measured: a world of 9 million cells has 1.0 GB, 24 million texels with their plan 2.0 GB.
constexpr double standing_bytes_per_cell = 115.0;
constexpr double standing_bytes_per_texel = 85.0;
constexpr int part_tile_px = 256;  // for small parts of a sheet
// Share of the memory limit.
constexpr double share_of_tiles = 0.15;
// Share of what copying and tiles leave, if ground that was fitted to the memory leaves less.
constexpr double min_share_of_windows = 0.2;

double cells_of(const TerrainModel& terrain) {
  auto cells = static_cast<double>(terrain.generalized_m.size());
  for (const TerrainWindow& window : terrain.windows) cells += cells_of(window.ground);
  return cells;
}

}  // namespace

double ground_bytes(const World& world) {
  return standing_bytes_per_cell * cells_of(world.terrain);
}

double copying_bytes(const std::vector<PaintedExemplar>& exemplars) {
  double texels = 0.0;
  for (const PaintedExemplar& exemplar : exemplars)
    texels += static_cast<double>(exemplar.picture.size());
  return standing_bytes_per_texel * texels;
}

double copying_bytes(const Scene& scene, double painting_texels) {
  double texels = painting_texels;
  const auto add_sheet = [&](const SceneExemplar& settings) {
    const glm::ivec2 size = example_sheet_size(settings, scene.output);
    texels += static_cast<double>(size.x) * size.y;
  };
  for (const SceneExemplar& exemplar : scene.exemplars)
    if (exemplar.model.empty() && exemplar.picture.empty()) add_sheet(exemplar);
  // A scene that copies without exemplars does so from a sheet that the program paints.
  if (texels == 0.0) add_sheet({});
  return standing_bytes_per_texel * texels;
}

std::uint64_t kept_tile_bytes() {
  return static_cast<std::uint64_t>(share_of_tiles * static_cast<double>(memory_budget_bytes()));
}

int choose_block_px(const Scene& scene, double pixels_per_unit, const StandingBytes& standing,
                    int min_px, const Style* style) {
  const double without_ground =
      (1.0 - share_of_tiles) * static_cast<double>(memory_budget_bytes()) - standing.besides;
  const double available =
      std::max(without_ground - standing.ground, min_share_of_windows * without_ground);
  TileStore::Place nowhere;
  StageGraph graph(nowhere, silent_progress());
  const GroundStages ground = add_ground_stages(
      graph, estimate_ground_inputs(scene, pixels_per_unit, style), largest_block_px);
  const PictureStages picture = add_picture_stages(graph, ground, nullptr);
  const auto bytes = [&](int side) { return graph.bytes_to_make(*picture.picture, side); };
  int block = largest_block_px;
  while (block > min_px && bytes(block) > available) block /= 2;
  if (bytes(block) > available)
    throw Error(ErrorKind::limit, "output",
                fmt::format("a picture of {}×{} pixels needs about {:.0f} MiB", scene.output.width,
                            scene.output.height,
                            (bytes(block) + standing.ground + standing.besides) /
                                (1.0 - share_of_tiles) / 1048576.0),
                fmt::format("at most {} MiB: a smaller output.width, or --memory",
                            memory_budget_bytes() >> 20));
  return block;
}

int choose_tile_px(int block_px, PixelRect region) {
  // Small parts need little beyond their margins: coarse tiles would make much that is not visible.
  int tile = block_px;
  while (tile > part_tile_px && tile > std::max(region.width(), region.height()) / 4) tile /= 2;
  return tile;
}

}  // namespace belvedere
