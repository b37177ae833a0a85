#include "renderer/pipeline/sheet_job.h"

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/grid.h"
#include "base/progress.h"
#include "renderer/features/feature_matte.h"
#include "renderer/image/exr/compositing_file.h"
#include "renderer/image/exr/match_file.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/copy_plan.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/picture_legend.h"
#include "renderer/pipeline/scene_labels.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_work.h"
#include "renderer/rock/rock_ground.h"
#include "renderer/sheet/piece_file.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/stages/lit_picture.h"
#include "renderer/stages/stages.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/scene_features.h"

namespace belvedere {
namespace {

constexpr const char* notes_bytes = "notes";
constexpr const char* origin_note = "origin";       // origin of positions
constexpr const char* matte_bytes = "matte_names";  // a line for each kind of features

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

// Prepares what every piece needs besides the stages: names that can be placed, notes, and the
// legend.
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
  return make_copy_plan(loaded, sheet.world, sheet.paint, sheet.ground, sheet.scratch, work, run,
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
  const bool for_blender = is_for_blender(request.channels);
  const DrawnFeatures features =
      request.panorama || for_blender
          ? draw_scene_features(loaded, sheet.world, sheet.ground.inputs->strokes.winter,
                                run.progress)
          : DrawnFeatures{};
  const std::optional<SceneMargin>& margin = sheet.world.scene.margin;
  if (margin && margin->legend && !features.empty() && !work.has_bytes(feature_legend_bytes))
    work.keep_bytes(feature_legend_bytes,
                    swatches_to_text(find_feature_legend(features, sheet.paint.palette)));
  const PictureStages picture =
      add_picture_stages(sheet.graph, sheet.ground, copied ? &plan : nullptr, features);

  if (for_blender) {
    std::string names;
    for (const FeatureKind& kind : features.style.kinds) names += kind.name + "\n";
    work.keep_bytes(matte_bytes, names);
  }
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
    const bool shifted = for_blender && !features.empty() && sheet.ground.crests != nullptr;
    if (shifted) requests.push_back({sheet.ground.crests, still});
    if (request.panorama) requests.push_back({picture.picture, still});
    if (request.matches) requests.push_back({picture.matches, still});
    sheet.graph.keep_only(requests);
    if (makes("guidance") && !work.has("guidance", piece)) {
      GuidanceBuffers guidance = sheet.ground.guidance->read(piece);
      keep_chosen(guidance, request.channels);
      const auto packed = std::make_shared<PackedGuidance>(pack_guidance(guidance));
      writer.keep("guidance", piece, packed->planes, packed);
    }
    if (for_blender && !work.has("matte", piece)) {
      const auto depths = with_channels({&GuidanceBuffers::depth_m}, sheet.world.surface->origin);
      const CrestShift crests =
          shifted ? sheet.ground.crests->read(piece, with_grids(&CrestShift::rows)) : CrestShift();
      const auto matte = std::make_shared<Grid<MattePixel>>(
          make_feature_matte(features, sheet.ground.guidance->read(piece, depths).depth_m, piece,
                             shifted ? &crests.rows : nullptr));
      writer.keep("matte", piece, {plane_of(*matte)}, matte);
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

namespace {

std::string join(const std::string& folder, const char* file) {
  return folder.empty() ? file : folder + "/" + file;
}

// Rows that are joined at once: a row of tiles of the files.
constexpr int band_rows = 64;

// Origin of positions, as the notes give it.
glm::dvec3 parse_origin(const FileNotes& notes) {
  std::istringstream text(notes.at("origin"));
  glm::dvec3 origin(0.0);
  text >> origin.x >> origin.y >> origin.z;
  return origin;
}

// Numbers as 1, 3–5, 9; a long list is truncated.
std::string list_numbers(const std::vector<int>& numbers) {
  constexpr int max = 12;
  std::string list;
  int ranges = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (ranges++ == max) return list + " …";
    list += fmt::format("{}{}", list.empty() ? "" : ", ", numbers[i]);
    if (last > i) list += fmt::format("{}{}", last == i + 1 ? ", " : "–", numbers[last]);
    i = last;
  }
  return list;
}

void require_pieces(const WorkFolder& work, const SheetRequest& request,
                    const std::vector<PixelRect>& pieces, Progress& progress,
                    const PlanOfParts& plan) {
  std::string missing;
  std::size_t count = 0;
  std::vector<int> parts;
  const std::vector<std::string> products = products_of(request);
  progress.begin("checking the pieces", static_cast<double>(pieces.size() * products.size()));
  int part = 1;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const std::string& product : products) {
      progress.advance(1.0);
      if (work.has(product, pieces[i])) continue;
      if (count++ < 5)
        missing += fmt::format("{}{} at {},{}", missing.empty() ? "" : ", ", product, pieces[i].x0,
                               pieces[i].y0);
      while (part < plan.parts && pieces_of_part(pieces.size(), part, plan.parts).end <= i) ++part;
      if (plan.parts > 0 && (parts.empty() || parts.back() != part)) parts.push_back(part);
    }
  if (count == 0) return;
  std::string found = fmt::format("{} of {} pieces are missing: {}{}", count,
                                  pieces.size() * products.size(), missing, count > 5 ? " …" : "");
  if (parts.empty())
    throw Error(ErrorKind::input, work.folder(), found, "run the parts that make them again");
  found = fmt::format("part{} {} of {} {} missing or incomplete ({})", parts.size() > 1 ? "s" : "",
                      list_numbers(parts), plan.parts, parts.size() > 1 ? "are" : "is", found);
  throw Error(ErrorKind::input, work.folder(), found,
              fmt::format("belvedere part {} {}{}, then join again", plan.folder, parts.front(),
                          parts.size() > 1 ? " and so on" : ""));
}

bool asks_for(const SheetRequest& request, const std::string& product) {
  const std::vector<std::string> products = products_of(request);
  return std::find(products.begin(), products.end(), product) != products.end();
}

// Calls use(guidance, y0, y1) for one row of tiles of the guidance file after the other.
template <class Use>
void read_guidance_rows(const SheetRequest& request, const JoinedPieces& joined,
                        const FileNotes& notes, const Run& run, Use use) {
  const PixelRect region = joined.region;
  run.progress.begin("writing guidance", region.height());
  GuidanceBuffers like = sheet_guidance_like(parse_origin(notes));
  keep_chosen(like, request.channels);
  for (int y0 = region.y0; y0 < region.y1; y0 += band_rows) {
    const int y1 = std::min(region.y1, y0 + band_rows);
    const PackedGuidance packed = blank_packed(like, region.width(), y1 - y0);
    joined.read("guidance", y0, y1, packed.planes);
    use(unpack_guidance(packed, like), y0, y1);
    run.progress.advance(y1 - y0);
  }
}

// Files under their temporary names, which are renamed together with the panorama's. Nothing where
// they are not requested.
std::optional<GuidanceWriter> write_guidance_file(const SheetRequest& request,
                                                  const JoinedPieces& joined,
                                                  const FileNotes& notes,
                                                  const FileNotes& file_notes,
                                                  const std::string& out_folder, const Run& run) {
  if (!asks_for(request, "guidance") || is_for_blender(request.channels)) return std::nullopt;
  const PixelRect region = joined.region;
  std::optional<GuidanceWriter> writer(std::in_place, join(out_folder, "guidance.exr"),
                                       region.width(), region.height(), file_notes);
  read_guidance_rows(request, joined, notes, run,
                     [&](const GuidanceBuffers& guidance, int y0, int y1) {
                       writer->write_rows(guidance, 0, y1 - y0, y0 - region.y0);
                     });
  writer->complete();
  return writer;
}

// The rows of a painting in encoded sRGB.
Grid<glm::vec3> painted_rows(const JoinedPieces& joined, int y0, int y1) {
  Grid<glm::vec3> rows(joined.region.width(), y1 - y0);
  joined.read("panorama", y0, y1, {plane_of(rows)});
  return rows;
}

// Guidance for compositing programs, with the painting where it is made.
std::optional<CompositingWriter> write_compositing_file(const SheetRequest& request,
                                                        const JoinedPieces& joined,
                                                        const FileNotes& notes,
                                                        const std::string& out_folder,
                                                        const Run& run) {
  if (!is_for_blender(request.channels)) return std::nullopt;
  const PixelRect region = joined.region;
  std::vector<std::string> features;
  std::istringstream names(joined.work.read_bytes(matte_bytes));
  for (std::string name; std::getline(names, name);) features.push_back(name);
  std::optional<CompositingWriter> writer(std::in_place, join(out_folder, "guidance.exr"),
                                          region.width(), region.height(), features, notes);
  read_guidance_rows(
      request, joined, notes, run, [&](const GuidanceBuffers& guidance, int y0, int y1) {
        Grid<MattePixel> matte(region.width(), y1 - y0);
        joined.read("matte", y0, y1, {plane_of(matte)});
        const Image picture =
            request.panorama ? decode_srgb(painted_rows(joined, y0, y1)) : guidance.base;
        writer->write_rows({guidance, picture, matte}, y0 - region.y0);
      });
  writer->complete();
  return writer;
}

std::optional<MatchWriter> write_match_file(const SheetRequest& request, const JoinedPieces& joined,
                                            const FileNotes& file_notes,
                                            const std::string& out_folder, const Run& run) {
  if (!asks_for(request, "matches")) return std::nullopt;
  const PixelRect region = joined.region;
  run.progress.begin("writing matches", region.height());
  std::optional<MatchWriter> writer(std::in_place, join(out_folder, "match.exr"), region.width(),
                                    region.height(), joined.work.read_bytes(matched_bytes),
                                    file_notes);
  for (int y0 = region.y0; y0 < region.y1; y0 += band_rows) {
    const int y1 = std::min(region.y1, y0 + band_rows);
    MatchField rows(region.width(), y1 - y0);
    joined.read("matches", y0, y1, {plane_of(rows)});
    writer->write_rows(rows, y0 - region.y0);
    run.progress.advance(y1 - y0);
  }
  writer->complete();
  return writer;
}

}  // namespace

void write_sheet_files(const LoadedScene& loaded, const SheetRequest& request,
                       const WorkFolder& work, const std::string& out_folder, const Run& run,
                       const PlanOfParts& plan, std::optional<BareView> seen) {
  const Scene& scene = loaded.scene;
  const PixelRect region = region_of(scene, request);
  const PixelRect made = region_with_halos(loaded, request);
  const JoinedPieces joined{work, pieces_of(made, request), region};
  require_pieces(work, request, joined.pieces, run.progress, plan);
  const FileNotes notes = job_from_text(work.read_bytes("notes"));
  FileNotes file_notes = notes;
  file_notes.erase("origin");  // of positions, which only guidance has

  std::optional<GuidanceWriter> guidance =
      write_guidance_file(request, joined, notes, file_notes, out_folder, run);
  std::optional<CompositingWriter> compositing =
      write_compositing_file(request, joined, notes, out_folder, run);
  std::optional<MatchWriter> matches =
      write_match_file(request, joined, file_notes, out_folder, run);
  const auto commit = [&] {
    if (guidance) guidance->commit();
    if (compositing) compositing->commit();
    if (matches) matches->commit();
  };
  if (!request.panorama) return commit();

  run.progress.begin("writing the panorama", region.height());
  const OutputColour colour = read_output_colour(loaded);
  const double dots_per_inch = scene.output.width / scene.output.sheet_width_mm * 25.4;
  for (const std::string& note :
       reduction_notes("panorama", scene.output.formats, region.width(), region.height()))
    run.progress.note(note);
  PictureFiles panorama(join(out_folder, "panorama"), scene.output.formats, region.width(),
                        region.height(),
                        {colour.display, colour.profile, colour.device, colour.ink_limit_percent},
                        dots_per_inch, file_notes);
  for (int y0 = region.y0; y0 < region.y1; y0 += band_rows) {
    const int y1 = std::min(region.y1, y0 + band_rows);
    panorama.write_rows(decode_srgb(painted_rows(joined, y0, y1)));
    run.progress.advance(y1 - y0);
  }
  panorama.finish();
  PictureLegend legend;
  if (work.has_bytes(legend_bytes))
    legend.classes = legend_from_text(work.read_bytes(legend_bytes));
  if (work.has_bytes(luminance_bytes))
    legend.luminance = luminance_from_bytes(work.read_bytes(luminance_bytes));
  if (work.has_bytes(feature_legend_bytes))
    legend.features = swatches_from_text(work.read_bytes(feature_legend_bytes));
  const JoinedPieces around{work, joined.pieces, made};
  const PaintedRows painted{made, [&](int y0, int y1) { return painted_rows(around, y0, y1); }};
  const LazyValue<BareView> bare(
      [&] { return seen ? std::move(*seen) : make_bare_view(loaded, run.progress, run.cache); });
  write_layer_files(loaded, request, joined, painted, legend.luminance, bare, out_folder, run);
  if (const std::optional<InkCoverage> ink = panorama.ink())
    run.progress.note(ink_note("panorama.tif", *ink));
  commit();
  write_named_picture(loaded, region, painted, legend, colour, file_notes, bare, out_folder, run);
}

}  // namespace belvedere
