#include "renderer/pipeline/sheet_pieces.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "renderer/image/provenance.h"
#include "renderer/pipeline/sheet_memory.h"
#include "renderer/scene/input_hash.h"
#include "renderer/stages/picture_layers.h"
#include "terrain/io/http_access.h"
#include "texture/sheet/synthesis_plan.h"

namespace belvedere {
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
