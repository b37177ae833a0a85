#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "base/grid_part.h"
#include "renderer/image/exr/match_file.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/layer_files.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/output_colour.h"
#include "renderer/pipeline/picture_legend.h"
#include "renderer/pipeline/sheet_job.h"
#include "renderer/sheet/guidance_pack.h"
#include "renderer/sheet/joined_pieces.h"
#include "renderer/world/lazy_value.h"

namespace belvedere {
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

// Files under their temporary names, which are renamed together with the panorama's. Nothing where
// they are not requested.
std::optional<GuidanceWriter> write_guidance_file(const SheetRequest& request,
                                                  const JoinedPieces& joined,
                                                  const FileNotes& notes,
                                                  const FileNotes& file_notes,
                                                  const std::string& out_folder, const Run& run) {
  if (!asks_for(request, "guidance")) return std::nullopt;
  const PixelRect region = joined.region;
  run.progress.begin("writing guidance", region.height());
  std::optional<GuidanceWriter> guidance(std::in_place, join(out_folder, "guidance.exr"),
                                         region.width(), region.height(), file_notes);
  GuidanceBuffers like = sheet_guidance_like(parse_origin(notes));
  keep_chosen(like, request.channels);
  for (int y0 = region.y0; y0 < region.y1; y0 += band_rows) {
    const int y1 = std::min(region.y1, y0 + band_rows);
    const PackedGuidance packed = blank_packed(like, region.width(), y1 - y0);
    joined.read("guidance", y0, y1, packed.planes);
    guidance->write_rows(unpack_guidance(packed, like), 0, y1 - y0, y0 - region.y0);
    run.progress.advance(y1 - y0);
  }
  guidance->complete();
  return guidance;
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
  std::optional<MatchWriter> matches =
      write_match_file(request, joined, file_notes, out_folder, run);
  const auto commit = [&] {
    if (guidance) guidance->commit();
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
  const auto encoded_rows = [&](int y0, int y1) {
    Grid<glm::vec3> rows(region.width(), y1 - y0);
    joined.read("panorama", y0, y1, {plane_of(rows)});
    return rows;
  };
  for (int y0 = region.y0; y0 < region.y1; y0 += band_rows) {
    const int y1 = std::min(region.y1, y0 + band_rows);
    panorama.write_rows(decode_srgb(encoded_rows(y0, y1)));
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
  const PaintedRows painted{made, [&](int y0, int y1) {
                              Grid<glm::vec3> rows(made.width(), y1 - y0);
                              around.read("panorama", y0, y1, {plane_of(rows)});
                              return rows;
                            }};
  const LazyValue<BareView> bare(
      [&] { return seen ? std::move(*seen) : make_bare_view(loaded, run.progress, run.cache); });
  write_layer_files(loaded, request, joined, painted, legend.luminance, bare, out_folder, run);
  if (const std::optional<InkCoverage> ink = panorama.ink())
    run.progress.note(ink_note("panorama.tif", *ink));
  commit();
  write_named_picture(loaded, region, painted, legend, colour, file_notes, bare, out_folder, run);
}

}  // namespace belvedere
