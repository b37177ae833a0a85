#include "renderer/exemplar/exemplar_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/memory_limit.h"
#include "renderer/exemplar/example_sheet.h"
#include "renderer/image/display_conversion.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "renderer/image/provenance.h"
#include "renderer/world/scene_season.h"
#include "renderer/world/scene_style.h"
#include "renderer/world/world.h"

namespace belvedere {
namespace {

// Bytes per pixel while it is painted: buffers, base picture, canvases and strokes of both layers.
constexpr double paint_bytes_per_pixel = 420.0;
constexpr double kept_bytes_per_pixel =
    24.0;  // of the example sheet's pixels outside the current row: both layers

std::string join(const std::string& folder, const char* file) { return folder + "/" + file; }

// 16 bit for copying, 8 bit for viewing. An exemplar is in sRGB, whatever the colour space of a
// scene's prints.
void write_layers(const ExamplePainting& example, double dots_per_inch, const FileNotes& notes,
                  const std::string& folder, Progress& progress) {
  progress.begin("writing the painting", 0.0);
  PictureFileOptions options{
      .dots_per_inch = dots_per_inch, .icc_profile = srgb_profile(), .notes = notes};
  options.notes[exemplar_layer_note] = "painting";
  write_tiff16(join(folder, "painting.tif"), example.painting, options);
  write_png8(join(folder, "painting.png"), example.painting, options);
  options.notes[exemplar_layer_note] = exemplar_ground_layer;
  write_tiff16(join(folder, "ground.tif"), example.ground_layer, options);
}

// Counts the class of the paint, which is what synthesis copies by. `first` is the index of the
// part's first pixel in the picture.
void count(AvailableTexels& available, const GuidanceBuffers& guidance, std::uint32_t first) {
  Grid<LandCoverClass> classes = guidance.land_cover;
  for (std::size_t i = 0; i < classes.size(); ++i)
    classes[i] = guidance.land_cover[guidance.ground_from[i] - first];
  add_available(available, guidance, classes);
}

void write_available(const AvailableTexels& available, const std::string& folder) {
  write_text_file(join(folder, "coverage.json"),
                  available_json(available, find_gaps(available, built_in_needed_texels(), {})));
}

}  // namespace

AvailableTexels write_scene_exemplar(const LoadedScene& loaded, const std::string& out_folder,
                                     const Run& run) {
  const RunLimits limits(run);
  Progress& progress = run.progress;
  require_scene_files(loaded);
  const SceneOutput& output = loaded.scene.output;
  check_memory("output", paint_bytes_per_pixel * output.width * output.height);
  check_output_folder(out_folder);

  const Palette named = named_palette(loaded);
  const World world = make_world(loaded, progress, run.cache);
  const Palette palette = palette_for_location(named, loaded, *world.dem);
  const FileNotes notes = make_world_notes(loaded, world);
  LitPicture picture = make_lit_picture(world, palette, {0, 0, output.width, output.height}, run);
  const ExamplePainting example = paint_example(world, palette, std::move(picture), {}, progress);
  AvailableTexels available;
  count(available, example.guidance, 0);
  write_layers(example, output.width / output.sheet_width_mm * 25.4, notes, out_folder, progress);
  progress.begin("writing guidance", 0.0);
  write_guidance(join(out_folder, "guidance.exr"), example.guidance, notes);
  write_text_file(join(out_folder, "scene.toml"), write_scene(loaded.scene));
  write_available(available, out_folder);
  return available;
}

AvailableTexels write_example_sheet(const ExampleSheetPlan& plan, const std::string& out_folder,
                                    const Run& run) {
  const RunLimits limits(run);
  Progress& progress = run.progress;
  const Palette palette = read_palette(plan.palette);
  const double rows = static_cast<double>(plan.panels.size()) / plan.columns;
  if (plan.height < ExrWriter::band_rows * rows)
    throw Error(ErrorKind::usage, "sheet",
                fmt::format("{} rows of panels in a height of {} pixels", rows, plan.height),
                fmt::format("at least {} pixels per row", ExrWriter::band_rows));
  check_memory("sheet",
               (paint_bytes_per_pixel / rows + kept_bytes_per_pixel) * plan.width * plan.height);
  check_output_folder(out_folder);

  const std::string text = write_example_sheet_plan(plan);
  std::map<std::string, std::string> inputs;
  if (plan.palette.ends_with(".toml")) inputs[plan.palette] = plan.palette;
  Provenance provenance = make_provenance(text, inputs);
  ExampleSheetPainter painter(plan, {palette, std::nullopt});
  ExamplePainting whole;
  whole.painting = whole.ground_layer = Grid<glm::vec3>(plan.width, plan.height);
  AvailableTexels available;
  std::optional<GuidanceWriter> writer;
  FileNotes notes;
  progress.begin("painting the sheet", static_cast<double>(plan.panels.size()));
  for (int row = 0; row < painter.rows(); ++row) {
    const auto [y0, y1] = painter.row_span(row);
    const ExamplePainting part = painter.paint_row(row, {}, run);
    if (!writer) {
      provenance.instruction_set = painter.instruction_set();
      notes = to_notes(provenance);
      writer.emplace(join(out_folder, "guidance.exr"), plan.width, plan.height, notes);
    }
    count(available, part.guidance,
          static_cast<std::uint32_t>(y0) * static_cast<std::uint32_t>(plan.width));
    std::copy(part.painting.begin(), part.painting.end(), whole.painting.row(y0));
    std::copy(part.ground_layer.begin(), part.ground_layer.end(), whole.ground_layer.row(y0));
    writer->write_rows(part.guidance, 0, y1 - y0, y0);
  }
  writer->finish();
  write_layers(whole, plan.dots_per_inch, notes, out_folder, progress);
  write_text_file(join(out_folder, "sheet.toml"), text);
  write_available(available, out_folder);
  return available;
}

}  // namespace belvedere
