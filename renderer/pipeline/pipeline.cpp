#include "renderer/pipeline/pipeline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "renderer/image/layers/layer_file.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_job.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_style.h"

namespace belvedere {

std::string work_folder_of(const std::string& out_folder) {
  return (std::filesystem::path(out_folder) / ".belvedere").string();
}

namespace {

void check_request(const Scene& scene, const SheetRequest& request) {
  if (request.matches && !scene.copies())
    throw Error(ErrorKind::usage, "--match",
                "nothing is copied: the scene paints its strokes directly",
                "a scene with an [[exemplar]] or synthesis.enabled = true, or no --match");
  for (const std::string& extension : request.layers) layer_format(extension);
  if (!request.layers.empty() && !scene.output.ocio_config.empty())
    throw Error(ErrorKind::usage, "--layers",
                "output.ocio_config changes the colours of the whole picture",
                "layers without it: they are sRGB");
  if (products_of(request).empty())
    throw Error(ErrorKind::usage, "--channels", "is none, but only guidance is rendered",
                "at least one channel");
}

// Before the work: paintings and ground count by their headers.
void refuse_beyond_memory(const LoadedScene& loaded, const SheetRequest& request) {
  const Scene& scene = loaded.scene;
  StandingBytes standing{.ground = ground_bytes(held_ground_cells(loaded)),
                         .besides = piece_bytes_of(scene, request)};
  if (request.panorama && scene.copies())
    standing.besides += copying_bytes(scene, painting_texels(loaded));
  const std::optional<Style> style = request.panorama ? named_style(loaded) : std::nullopt;
  choose_block_px(scene, scene.pixels_per_unit(), standing, min_block_px_of(request),
                  style ? &*style : nullptr);
}

}  // namespace

std::vector<std::string> result_names(const Scene& scene, const SheetRequest& request) {
  std::vector<std::string> names;
  if (request.panorama) {
    const bool whole =
        region_of(scene, request) == PixelRect{0, 0, scene.output.width, scene.output.height};
    const std::string second = second_picture(scene, whole);
    for (const std::string& extension : scene.output.formats)
      names.push_back("panorama." + extension);
    if (scene.labels.any())
      names.insert(names.end(), {"labels.svg", "labels.csv", "labels.geojson"});
    if (!second.empty())
      for (const std::string& extension : scene.output.formats)
        names.push_back(second + "." + extension);
    if (scene.margin && whole) names.emplace_back("margin.svg");
  }
  if (!request.channels || !request.channels->empty()) names.emplace_back("guidance.exr");
  if (request.matches) names.emplace_back("match.exr");
  for (const std::string& extension : request.layers) names.push_back(layer_format(extension).file);
  return names;
}

void render(const LoadedScene& loaded, const std::string& out_folder, const Run& run,
            const SheetRequest& request) {
  const RunLimits limits(run);
  check_request(loaded.scene, request);
  require_inputs(loaded);
  refuse_beyond_memory(loaded, request);
  read_output_colour(loaded);
  const std::vector<PixelRect> pieces = pieces_of(region_with_halos(loaded, request), request);
  guard_inputs(loaded);
  file_guard().writes_into(out_folder, "--out", request.replace,
                           result_names(loaded.scene, request));

  if (!request.resume && holds_work(work_folder_of(out_folder)))
    run.progress.note(
        "the pieces of an interrupted run are discarded; --resume would have continued from them");
  WorkFolder work(work_folder_of(out_folder), identify(loaded, request),
                  request.resume ? WorkMode::resume : WorkMode::begin);
  std::optional<BareView> seen = make_pieces(loaded, request, pieces, work, run);
  write_sheet_files(loaded, request, work, out_folder, run, {}, std::move(seen));
  work.clear();
}

void plan_sheet(const LoadedScene& loaded, const std::string& folder, const Run& run,
                const SheetRequest& request) {
  const RunLimits limits(run);
  check_request(loaded.scene, request);
  require_inputs(loaded);
  read_output_colour(loaded);
  check_output_folder(folder);
  const JobIdentity identity = identify(loaded, request);
  begin_shared_work(work_folder_of(folder), identity);
  make_plan(loaded, request, WorkFolder(work_folder_of(folder), identity, WorkMode::join), run);
}

void make_part(const LoadedScene& loaded, const std::string& folder, int part, int parts,
               const Run& run, const SheetRequest& request) {
  const RunLimits limits(run);
  if (part < 1 || part > parts)
    throw Error(ErrorKind::usage, "part", fmt::format("{}", part),
                fmt::format("1 to {}, the parts of the plan", parts));
  const std::vector<PixelRect> pieces = pieces_of(region_with_halos(loaded, request), request);
  const PieceSpan own = pieces_of_part(pieces.size(), part, parts);
  const WorkFolder work(work_folder_of(folder), identify(loaded, request), WorkMode::join);
  make_pieces(loaded, request, std::span(pieces).subspan(own.first, own.end - own.first), work,
              run);
}

void join_parts(const LoadedScene& loaded, const std::string& folder, int parts,
                const std::string& out_folder, const Run& run, const SheetRequest& request) {
  const RunLimits limits(run);
  require_inputs(loaded);
  guard_inputs(loaded);
  file_guard().writes_into(out_folder, "--out", request.replace,
                           result_names(loaded.scene, request));
  const WorkFolder work(work_folder_of(folder), identify(loaded, request), WorkMode::join);
  write_sheet_files(loaded, request, work, out_folder, run, {.folder = folder, .parts = parts});
}

std::vector<std::string> product_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const std::string& extension : scene.output.formats)
    names.push_back("panorama." + extension);
  names.emplace_back("guidance.exr");
  return names;
}

LoadedScene at_width(const LoadedScene& scene, int width_px) {
  constexpr int min_px = 16;  // limit of a scene
  LoadedScene out = scene;
  const double scale = static_cast<double>(width_px) / scene.scene.output.width;
  out.scene.output.width = width_px;
  out.scene.output.height =
      std::max(min_px, static_cast<int>(std::lround(scene.scene.output.height * scale)));
  return out;
}

std::vector<LockedProduct> render_and_hash(const LoadedScene& scene, const std::string& out_folder,
                                           const Run& run, bool replace) {
  SheetRequest request;
  request.replace = replace;
  render(scene, out_folder, run, request);
  std::vector<LockedProduct> products;
  for (const std::string& name : product_names(scene.scene))
    products.push_back({.file = name, .channels = hash_picture(out_folder + "/" + name).channels});
  std::sort(products.begin(), products.end(),
            [](const LockedProduct& a, const LockedProduct& b) { return a.file < b.file; });
  return products;
}

}  // namespace belvedere
