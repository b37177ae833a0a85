#include "renderer/pipeline/sheet_pieces.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/memory_limit.h"
#include "renderer/exemplar/example_sheet.h"
#include "renderer/ground/cached_products.h"
#include "renderer/image/provenance.h"
#include "renderer/scene/scene_lock.h"
#include "renderer/stages/picture_layers.h"
#include "renderer/stages/stages.h"
#include "terrain/io/http_access.h"
#include "texture/sheet/synthesis_sheet.h"

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

double ground_bytes(const World& world) { return ground_bytes(cells_of(world.terrain)); }

double ground_bytes(double cells) { return standing_bytes_per_cell * cells; }

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

namespace {

// Side of a piece: a tile of synthesis, so that each of its tiles is made for one piece.
constexpr int usual_piece_px = SynthesisSheet{}.tile_px;

}  // namespace

PixelRect region_of(const Scene& scene, const SheetRequest& request) {
  const PixelRect sheet{0, 0, scene.output.width, scene.output.height};
  if (!request.part) return sheet;
  const PixelRect& part = *request.part;
  if (part.empty() || intersection(part, sheet) != part)
    throw Error(
        ErrorKind::usage, "--part",
        fmt::format("{},{},{},{}", part.x0, part.y0, part.width(), part.height()),
        fmt::format("x,y,width,height of at least one pixel inside the sheet of {} × {} pixels",
                    sheet.x1, sheet.y1));
  return part;
}

std::vector<std::string> products_of(const SheetRequest& request) {
  std::vector<std::string> products;
  if (!request.channels || !request.channels->empty()) products.emplace_back("guidance");
  if (is_for_blender(request.channels)) products.emplace_back("matte");
  if (request.panorama) products.emplace_back("panorama");
  if (request.matches) products.emplace_back("matches");
  if (request.panorama && !request.layers.empty())
    products.insert(products.end(), layer_plane_names().begin(), layer_plane_names().end());
  return products;
}

std::vector<PixelRect> pieces_of(PixelRect region, const SheetRequest& request) {
  const int piece_px = request.piece_px > 0 ? request.piece_px : usual_piece_px;
  const int column0 = region.x0 / piece_px;
  const int column1 = (region.x1 - 1) / piece_px;
  const int row0 = region.y0 / piece_px;
  const int row1 = (region.y1 - 1) / piece_px;
  std::vector<PixelRect> pieces;
  const auto add = [&](int column, int row) {
    pieces.push_back(intersection(region, {column * piece_px, row * piece_px,
                                           (column + 1) * piece_px, (row + 1) * piece_px}));
  };
  if (region.width() > region.height()) {
    for (int column = column0; column <= column1; ++column)
      for (int row = row0; row <= row1; ++row) add(column, row);
  } else {
    for (int row = row0; row <= row1; ++row)
      for (int column = column0; column <= column1; ++column) add(column, row);
  }
  return pieces;
}

double piece_bytes_of(const Scene& scene, const SheetRequest& request) {
  if (!request.panorama || request.layers.empty()) return 0.0;
  const PixelRect region = region_of(scene, request);
  const int piece_px = request.piece_px > 0 ? request.piece_px : usual_piece_px;
  const bool thinned = !scene.air.mist.empty() && scene.any_features();
  const double bytes_per_pixel = layer_bytes_per_pixel + (thinned ? thinned_bytes_per_pixel : 0.0);
  return bytes_per_pixel * std::min(region.width(), piece_px) * std::min(region.height(), piece_px);
}

int min_block_px_of(const SheetRequest& request) {
  return request.layers.empty() ? min_block_px : largest_block_px;
}

PieceSpan pieces_of_part(std::size_t count, int part, int parts) {
  const auto before = [&](int i) {
    return count * static_cast<std::size_t>(i) / static_cast<std::size_t>(parts);
  };
  return {before(part - 1), before(part)};
}

JobIdentity identify(const LoadedScene& loaded, const SheetRequest& request) {
  JobIdentity identity;
  const PixelRect region = region_of(loaded.scene, request);
  identity["program"] = program_version() + ", " + library_versions();
  identity["scene"] = write_scene(loaded.scene);
  identity["part"] =
      fmt::format("{},{},{},{}", region.x0, region.y0, region.width(), region.height());
  identity["results"] = fmt::format("{}", fmt::join(products_of(request), ", "));
  if (request.channels) identity["channels"] = fmt::format("{}", fmt::join(*request.channels, ","));
  identity["piece"] = fmt::format("{} px", request.piece_px);
  // A file on a server is read before it is hashed, so that an unsuitable server is found:
  // keep_notes compares it.
  for (const SceneInput& input : scene_inputs(loaded))
    if (!input.path.empty())
      identity[input.file] = is_address(input.path) ? input.path : hash_input(input.path).hash;
  return identity;
}

}  // namespace belvedere
