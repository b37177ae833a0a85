#include "renderer/pipeline/sheet_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/grid_part.h"
#include "base/repeated_stages.h"
#include "renderer/image/exr/match_file.h"
#include "renderer/image/guidance_io.h"
#include "renderer/pipeline/copy_plan.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/picture_legend.h"
#include "renderer/pipeline/scene_labels.h"
#include "renderer/pipeline/sheet_memory.h"
#include "renderer/pipeline/sheet_work.h"
#include "renderer/sheet/guidance_pack.h"
#include "renderer/sheet/piece_writer.h"
#include "renderer/stages/stages.h"
#include "renderer/world/scene_features.h"
#include "renderer/world/world_notes.h"

namespace belvedere {
namespace {

constexpr const char* notes_bytes = "notes";
constexpr const char* origin_note = "origin";  // origin of positions

// Headers of all files.
void keep_notes(const LoadedScene& loaded, const World& world, const WorkFolder& work) {
  FileNotes notes = make_world_notes(loaded, world);
  if (work.has_bytes(notes_bytes)) {
    const JobIdentity known = job_from_text(work.read_bytes(notes_bytes));
    const auto inputs = known.find("belvedere:inputs");
    if ((inputs == known.end() ? std::string() : inputs->second) != notes["belvedere:inputs"])
      throw Error(ErrorKind::input, work.folder(), "the existing pieces were made from other data",
                  "a run without --resume");
    return;
  }
  const glm::dvec3 origin = world.surface->origin;
  notes[origin_note] = fmt::format("{:.17g} {:.17g} {:.17g}", origin.x, origin.y, origin.z);
  work.keep_bytes(notes_bytes, to_text(notes));
}

// The rectangle of the pieces from number `next` on.
PixelRect remaining_rect(std::span<const PixelRect> pieces, std::size_t next) {
  PixelRect all;
  for (const PixelRect& piece : pieces.subspan(next)) all = bounding_rect(all, piece);
  return all;
}

bool is_made(const WorkFolder& work, const SheetRequest& request, PixelRect piece) {
  const std::vector<std::string> products = products_of(request);
  return std::all_of(products.begin(), products.end(),
                     [&](const std::string& product) { return work.has(product, piece); });
}

// Whether one of the grids that layers are made of is missing, or the picture that they were cut
// from.
bool lacks_layers(const WorkFolder& work, PixelRect piece) {
  return !work.has("panorama", piece) ||
         std::any_of(layer_plane_names().begin(), layer_plane_names().end(),
                     [&](std::string_view name) { return !work.has(std::string(name), piece); });
}

// What every piece needs besides the stages: names that can be placed, notes, and the legend.
void prepare_work(const LoadedScene& loaded, const SheetRequest& request, const SheetWork& sheet,
                  const WorkFolder& work, const Run& run) {
  if (request.panorama) check_names(loaded, *sheet.world.dem);
  keep_notes(loaded, sheet.world, work);
  const Scene& scene = sheet.world.scene;
  const bool shows_legend = scene.margin && scene.margin->legend;
  const bool needed = (request.panorama && shows_legend) || shows_names(scene, request);
  if (!needed || work.has_bytes(luminance_bytes)) return;
  const PictureOverview overview = make_overview(sheet.world, sheet.paint.palette, run);
  work.keep_bytes(luminance_bytes, luminance_to_bytes(overview));
  const glm::dvec2 swatch_px = legend_swatch_px(loaded);
  work.keep_bytes(legend_bytes, legend_to_text(find_legend(overview, swatch_px)));
}

std::vector<MatchedPicture> pictures_of(const CopyPlan& plan) {
  std::vector<MatchedPicture> pictures;
  for (const PaintedExemplar& painted : plan.exemplars)
    pictures.push_back({painted.exemplar.name, painted.picture.width(), painted.picture.height()});
  return pictures;
}

CopyPlan plan_copies(const LoadedScene& loaded, SheetWork& sheet, const WorkFolder& work,
                     const Run& run, bool ground_tells) {
  return make_copy_plan(loaded, sheet.world, sheet.paint, sheet.ground, sheet.position, work, run,
                        ground_tells);
}

// Largest part of a piece that memory allows to paint at once.
Grid<glm::vec3> paint_in_blocks(Stage<SheetPicture>& picture, PixelRect piece, int block_px) {
  if (piece.width() <= block_px && piece.height() <= block_px) return picture.read(piece).colour;
  Grid<glm::vec3> whole(piece.width(), piece.height());
  for (int y = piece.y0; y < piece.y1; y += block_px)
    for (int x = piece.x0; x < piece.x1; x += block_px)
      copy_part(
          whole,
          picture.read({x, y, std::min(x + block_px, piece.x1), std::min(y + block_px, piece.y1)})
              .colour,
          x - piece.x0, y - piece.y0);
  return whole;
}

}  // namespace

std::optional<BareView> make_pieces(const LoadedScene& loaded, const SheetRequest& request,
                                    std::span<const PixelRect> pieces, const WorkFolder& work,
                                    const Run& run) {
  std::vector<PixelRect> missing;
  std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(missing),
               [&](const PixelRect& piece) { return !is_made(work, request, piece); });
  if (missing.empty() && work.has_bytes(notes_bytes)) return std::nullopt;

  const bool few = pieces.size() <= 4;
  RepeatedStages progress(run.progress, few);
  const Run stage_run{run.threads, run.memory_bytes, run.tile_px, progress, run.cache};
  SheetWork sheet(loaded, request, {.scratch_folder = work.folder()}, run, stage_run);
  prepare_work(loaded, request, sheet, work, run);
  const bool copied = is_copied(sheet.world.scene, request);
  CopyPlan plan = copied ? plan_copies(loaded, sheet, work, run, few) : CopyPlan{};
  const DrawnFeatures features =
      request.panorama ? draw_scene_features(loaded, sheet.world,
                                             sheet.ground.inputs->strokes.winter, run.progress)
                       : DrawnFeatures{};
  const std::optional<SceneMargin>& margin = sheet.world.scene.margin;
  if (margin && margin->legend && !features.empty() && !work.has_bytes(feature_legend_bytes))
    work.keep_bytes(feature_legend_bytes,
                    swatches_to_text(find_feature_legend(features, sheet.paint.palette)));
  const PictureStages picture =
      add_picture_stages(sheet.graph, sheet.ground, copied ? &plan : nullptr, features);

  if (request.matches) work.keep_bytes(matched_bytes, to_note(pictures_of(plan)));
  const std::vector<std::string> products = products_of(request);
  const auto makes = [&](const char* product) {
    return std::find(products.begin(), products.end(), product) != products.end();
  };

  PieceWriter writer(work);
  const double all = static_cast<double>(missing.size());
  if (!few) run.progress.begin(request.panorama ? "painting the sheet" : "tracing the sheet", all);
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const PixelRect piece = missing[i];
    // Tiles that no later piece needs are released.
    const PixelRect still = remaining_rect(missing, i);
    std::vector<StageGraph::Request> requests;
    if (makes("guidance")) requests.push_back({sheet.ground.guidance, still});
    if (request.panorama) requests.push_back({picture.picture, still});
    if (request.matches) requests.push_back({picture.matches, still});
    sheet.graph.keep_only(requests);
    if (makes("guidance") && !work.has("guidance", piece)) {
      GuidanceBuffers guidance = sheet.ground.guidance->read(piece);
      keep_chosen(guidance, request.channels);
      const auto packed = std::make_shared<PackedGuidance>(pack_guidance(guidance));
      writer.keep("guidance", piece, packed->planes, packed);
    }
    if (makes("layer_ground") && lacks_layers(work, piece)) {
      const auto painted =
          std::make_shared<SheetPicture>(picture.picture->read(piece, with_layers));
      for (std::size_t k = 0; k < layer_plane_count; ++k)
        writer.keep(std::string(layer_plane_names()[k]), piece,
                    {plane_of(painted->layers->planes[k])}, painted);
      writer.keep("panorama", piece, {plane_of(painted->colour)}, painted);
    } else if (request.panorama && !work.has("panorama", piece)) {
      const auto painted = std::make_shared<Grid<glm::vec3>>(
          paint_in_blocks(*picture.picture, piece, sheet.block_px));
      writer.keep("panorama", piece, {plane_of(*painted)}, painted);
    }
    if (request.matches && !work.has("matches", piece)) {
      const auto matches = std::make_shared<MatchField>(picture.matches->read(piece));
      writer.keep("matches", piece, {plane_of(*matches)}, matches);
    }
    if (!few) run.progress.advance(1.0);
  }
  writer.finish();
  const bool names = request.panorama && (loaded.scene.labels.any() || loaded.scene.margin);
  if (!names || !sheet.world.terrain.windows.empty()) return std::nullopt;
  return bare_view_of(sheet.world);
}

void make_plan(const LoadedScene& loaded, const SheetRequest& request, const WorkFolder& work,
               const Run& run) {
  SheetWork sheet(loaded, request, {.scratch_folder = work.folder()}, run, run);
  prepare_work(loaded, request, sheet, work, run);
  if (is_copied(sheet.world.scene, request)) plan_copies(loaded, sheet, work, run, true);
}

}  // namespace belvedere
