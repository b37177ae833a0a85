#include "renderer/pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_limit.h"
#include "renderer/exemplar/exemplars.h"
#include "renderer/image/color.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/output_color.h"
#include "renderer/pipeline/stage_notes.h"
#include "renderer/world/lit_picture.h"
#include "texture/strokes/stroke_painter.h"
#include "texture/synthesis/class_supply.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

std::string join(const std::string& folder, const char* file) { return folder.empty() ? file : folder + "/" + file; }

// Bytes a whole picture takes while it is painted: buffers, paint ground, canvases, strokes.
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

SynthesisParameters to_synthesis_parameters(const Scene& scene) {
  SynthesisParameters parameters;
  parameters.seed = scene.seed;
  parameters.levels = scene.synthesis.levels;
  // What a scene says of one guide leaves the defaults of the others.
  parameters.weights = SceneSynthesis{}.weights;
  for (const auto& wanted : scene.synthesis.weights) {
    const auto known = std::find_if(parameters.weights.begin(), parameters.weights.end(),
                                    [&](const auto& weight) { return weight.first == wanted.first; });
    if (known != parameters.weights.end())
      known->second = wanted.second;
    else
      parameters.weights.push_back(wanted);
  }
  parameters.reuse = scene.synthesis.reuse;
  parameters.copy_cap = scene.synthesis.copy_cap;
  for (const auto& [from, to] : scene.synthesis.fallback)
    parameters.fallback[static_cast<std::uint8_t>(from)] = static_cast<std::uint8_t>(to);
  return parameters;
}

// The ground of the picture in the exemplars' hand: synthesized texture as a residual over the base picture.
Grid<glm::vec3> synthesize_ground(const LoadedScene& loaded, const Stage& stage, const LitPicture& picture,
                                  std::vector<ScannedPainting> scans, Progress& progress) {
  const std::vector<PaintedExemplar> painted = make_exemplars(loaded, stage, std::move(scans), progress);
  std::vector<Exemplar> exemplars;
  exemplars.reserve(painted.size());
  for (const PaintedExemplar& p : painted) exemplars.push_back(p.exemplar);
  // A first painting of strokes tells where each class's paint would lie: borders get the shape of strokes.
  const Painting draft = paint_strokes(picture.ground.colour, picture.guidance, picture.ground,
                                       {.sky = false, .breaks = false, .upright = false}, to_stroke_parameters(stage), progress);
  const PaintedClasses classes = find_painted_classes(draft.sources, picture.guidance, picture.ground.colour);
  const GuideStack guides = make_guide_stack(picture.guidance, classes.land_cover);
  const SynthesisParameters parameters = to_synthesis_parameters(stage.scene);
  const std::string scarcity = describe_scarcity(class_supply(exemplars, guides.label, parameters.fallback), [](std::uint8_t label) {
    return std::string(class_name(static_cast<LandCoverClass>(label)));
  });
  if (!scarcity.empty()) progress.note(scarcity);
  const MatchField matches = synthesize(exemplars, guides, parameters, progress);
  const Grid<glm::vec3> copied = transfer_residual(matches, painted, classes.base, picture.ground.haze, stage.scene.synthesis.residual);
  return mix_borders(copied, draft, classes.land_cover, picture.guidance.land_cover, picture.ground.colour);
}

// Colours may be a painting's even where its strokes are not used.
bool reads_paintings(const Scene& scene) { return scene.synthesis.enabled || scene.synthesis.colours == "painting"; }

void write_panorama(const Grid<glm::vec3>& picture, const Scene& scene, const OutputColor& color, const FileNotes& notes,
                    const std::string& folder, Progress& progress) {
  progress.begin("writing the panorama", 0.0);
  const Image linear = decode_srgb(picture);
  const Grid<glm::vec3> display = to_display(linear, color.display);
  PictureFileOptions options;
  options.dots_per_inch = scene.output.width / scene.output.sheet_width_mm * 25.4;
  options.notes = notes;
  options.icc_profile = srgb_profile();
  write_png8(join(folder, "panorama.png"), display, options);
  if (color.profile.empty()) {
    write_tiff16(join(folder, "panorama.tif"), display, options);
  } else {
    options.icc_profile = color.profile;
    write_tiff16(join(folder, "panorama.tif"), to_profile(display, options.icc_profile), options);
  }
  write_exr(join(folder, "panorama.exr"), linear, notes);
}

}  // namespace

void render(const LoadedScene& loaded, const RenderOptions& options, Progress& progress) {
  const ThreadLimit threads(options.threads);
  require_scene_files(loaded);
  check_memory(loaded.scene);
  const OutputColor color = read_output_color(loaded);
  if (reads_paintings(loaded.scene)) check_paintings(loaded);
  check_output_folder(options.out_folder);

  Stage stage = set_stage(loaded, progress);
  std::vector<ScannedPainting> scans;
  if (reads_paintings(loaded.scene)) scans = read_scans(loaded, progress);
  if (loaded.scene.synthesis.colours == "painting") stage.palette = take_colours(stage.palette, scans, loaded.scene.synthesis.fallback);
  const FileNotes notes = make_stage_notes(loaded, stage);
  const PixelRect whole{0, 0, loaded.scene.output.width, loaded.scene.output.height};
  const LitPicture picture = make_lit_picture(stage, whole, options.tile_size, progress);
  progress.begin("writing guidance", 0.0);
  write_guidance(join(options.out_folder, "guidance.exr"), picture.guidance, notes);

  const bool copied = stage.scene.synthesis.enabled;
  Grid<glm::vec3> ground = copied ? synthesize_ground(loaded, stage, picture, std::move(scans), progress) : picture.ground.colour;
  // What the exemplar cannot give is painted last, far to near: sky, trees, houses; without an exemplar everything is.
  const StrokeLayers layers{.sky = true, .ground = !copied, .accents = true, .breaks = true, .upright = true};
  const Painting painted =
      paint_strokes(std::move(ground), picture.guidance, picture.ground, layers, to_stroke_parameters(stage), progress);
  const Grid<glm::vec3> panorama = blend_edges(painted.picture, picture.guidance);
  write_panorama(panorama, stage.scene, color, notes, options.out_folder, progress);
}

void render_guidance(const LoadedScene& loaded, const RenderOptions& options, Progress& progress) {
  const ThreadLimit threads(options.threads);
  require_scene_files(loaded);
  const int band_rows = choose_band_rows(loaded.scene);
  check_output_folder(options.out_folder);

  Stage stage = set_stage(loaded, progress);
  if (loaded.scene.synthesis.colours == "painting")
    stage.palette = take_colours(stage.palette, read_scans(loaded, progress), loaded.scene.synthesis.fallback);
  const int width = loaded.scene.output.width;
  const int height = loaded.scene.output.height;
  const int margin = lit_margin_px(stage.scene);
  GuidanceWriter writer(join(options.out_folder, "guidance.exr"), width, height, make_stage_notes(loaded, stage));
  for (int y0 = 0; y0 < height; y0 += band_rows) {
    const int y1 = std::min(height, y0 + band_rows);
    const PixelRect band{0, std::max(0, y0 - margin), width, std::min(height, y1 + margin)};
    const LitPicture picture = make_lit_picture(stage, band, options.tile_size, progress);
    writer.write_rows(picture.guidance, y0 - band.y0, y1 - y0, y0);
  }
  writer.finish();
}

}  // namespace belvedere
