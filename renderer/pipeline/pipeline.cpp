#include "renderer/pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "renderer/exemplar/exemplars.h"
#include "renderer/image/color.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/output_file.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/copied_ground.h"
#include "renderer/pipeline/output_color.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/world/lit_picture.h"
#include "renderer/world/world.h"
#include "renderer/world/world_notes.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {
namespace {

std::string join(const std::string& folder, const char* file) { return folder.empty() ? file : folder + "/" + file; }

// Bytes a whole picture takes while it is painted: buffers, base picture, canvases, strokes.
constexpr std::uint64_t render_bytes_per_pixel = 320;

void check_memory(const Scene& scene) {
  const std::uint64_t need =
      static_cast<std::uint64_t>(scene.output.width) * static_cast<std::uint64_t>(scene.output.height) * render_bytes_per_pixel;
  if (need > memory_budget_bytes())
    throw Error(ErrorKind::limit, "output",
                fmt::format("a picture of {}×{} pixels needs about {} MiB", scene.output.width, scene.output.height, need >> 20),
                fmt::format("at most {} MiB: a smaller output.width, or --memory", memory_budget_bytes() >> 20));
}

// Rows of guidance that are made at once: as many as memory allows, a multiple of the file's tiles. Changes no pixel.
int choose_band_rows(const Scene& scene) {
  constexpr int tile_rows = 64;
  constexpr int most_rows = 512;
  const auto bytes = [&](int rows) {
    const int held = std::min(scene.output.height, rows + 2 * lit_margin_px(scene));
    return static_cast<double>(scene.output.width) * held * render_bytes_per_pixel;
  };
  int rows = most_rows;
  while (rows > tile_rows && bytes(rows) > static_cast<double>(memory_budget_bytes())) rows /= 2;
  if (bytes(rows) > static_cast<double>(memory_budget_bytes()))
    throw Error(ErrorKind::limit, "output",
                fmt::format("guidance {} pixels wide needs about {:.0f} MiB", scene.output.width, bytes(rows) / 1048576.0),
                fmt::format("at most {} MiB: a smaller output.width, or --memory", memory_budget_bytes() >> 20));
  return rows;
}

PixelRect whole_picture(const Scene& scene) { return {0, 0, scene.output.width, scene.output.height}; }

void write_panorama(const Grid<glm::vec3>& picture, const Scene& scene, const OutputColor& color, const FileNotes& notes,
                    const std::string& folder, Progress& progress) {
  progress.begin("writing the panorama", 0.0);
  for (const std::string& note : reduction_notes("panorama", scene.output.formats, picture.width(), picture.height())) progress.note(note);
  const double dots_per_inch = scene.output.width / scene.output.sheet_width_mm * 25.4;
  write_pictures(join(folder, "panorama"), scene.output.formats, decode_srgb(picture), {color.display, color.profile}, dots_per_inch,
                 notes);
}

}  // namespace

void render(const LoadedScene& loaded, const std::string& out_folder, const Run& run) {
  const RunLimits limits(run);
  Progress& progress = run.progress;
  check_memory(loaded.scene);
  require_inputs(loaded);
  const OutputColor color = read_output_color(loaded);
  check_output_folder(out_folder);

  ScenePaint paint = read_scene_paint(loaded, progress);
  const Palette& palette = paint.palette;
  const World world(loaded, progress, run.cache);  // world.h names what it is made of, one from the other:
  const auto& [scene, dem, view, camera, land_cover, deformation, terrain, surface, tracer, horizon_px] = world;
  const FileNotes notes = make_world_notes(loaded, world);

  const LitPicture lit = make_lit_picture(world, palette, whole_picture(scene), run);  // traced guidance → tone → base picture
  progress.begin("writing guidance", 0.0);
  write_guidance(join(out_folder, "guidance.exr"), lit.guidance, notes);

  const bool copied = scene.synthesis.enabled;
  // Its scene and view are named because clang 14 captures no bindings by itself.
  const auto copy_exemplars = [&, &scene = scene, &view = view] {
    const std::vector<PaintedExemplar> exemplars = make_exemplars(loaded, view, palette, std::move(paint.paintings), progress, run.cache);
    const PaintDraft draft = draft_paint(world, palette, lit, progress);
    const MatchField matches = match_exemplars(exemplars, scene, lit, draft, progress);
    return copy_ground(matches, exemplars, scene, lit, draft);
  };
  Grid<glm::vec3> canvas = copied ? copy_exemplars() : lit.base.colour;
  // What the exemplar cannot give is painted last, far to near: sky, trees, houses; without an exemplar everything is.
  const StrokeLayers layers{.sky = true, .ground = !copied, .accents = true, .breaks = true, .upright = true};
  const Painting strokes = paint_strokes(std::move(canvas), lit.guidance, lit.base, layers, to_stroke_parameters(world, palette), progress);
  const Grid<glm::vec3> panorama = blend_edges(strokes.picture, lit.guidance);
  write_panorama(panorama, scene, color, notes, out_folder, progress);
}

void render_guidance(const LoadedScene& loaded, const std::string& out_folder, const Run& run) {
  const RunLimits limits(run);
  const int band_rows = choose_band_rows(loaded.scene);
  require_inputs(loaded);
  check_output_folder(out_folder);

  const Palette palette = read_scene_palette(loaded, run.progress);
  const World world(loaded, run.progress, run.cache);
  const PixelRect whole = whole_picture(world.scene);
  const int margin = lit_margin_px(world.scene);
  GuidanceWriter writer(join(out_folder, "guidance.exr"), whole.x1, whole.y1, make_world_notes(loaded, world));
  for (int y0 = 0; y0 < whole.y1; y0 += band_rows) {
    const int y1 = std::min(whole.y1, y0 + band_rows);
    const PixelRect band{0, std::max(0, y0 - margin), whole.x1, std::min(whole.y1, y1 + margin)};
    const LitPicture lit = make_lit_picture(world, palette, band, run);
    writer.write_rows(lit.guidance, y0 - band.y0, y1 - y0, y0);
  }
  writer.finish();
}

}  // namespace belvedere
