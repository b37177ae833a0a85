#include "renderer/pipeline/named_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>

#include "renderer/image/output_file.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/labels/drawing_svg.h"
#include "renderer/labels/label_drawing.h"
#include "renderer/labels/sheet_painter.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/scene_labels.h"

namespace belvedere {
namespace {

constexpr int rows_per_copy = 64;

glm::vec3 colour_of(const std::string& hex) {
  unsigned value = 0;
  std::from_chars(hex.data() + 1, hex.data() + hex.size(), value, 16);
  return glm::vec3((value >> 16) & 255U, (value >> 8) & 255U, value & 255U) / 255.0F;
}

MarginContent content_of(const LoadedScene& loaded, const BareView& bare, const LabelSheet& sheet,
                         const PictureLegend& legend) {
  const Scene& scene = loaded.scene;
  const SceneMargin& asked = *scene.margin;
  MarginContent content;
  content.title = asked.title.empty() ? scene.title : asked.title;
  content.subtitle = asked.subtitle;
  if (asked.legend) {
    content.classes = legend.classes;
    content.features = legend.features;
  }
  const GeoMap map = bare.geo_map();
  const CameraParameters& camera = bare.view.camera;
  if (asked.scale_bars) {
    const std::vector<double> skyline = find_skyline(map, sheet.size_px);
    content.scales =
        find_scales(map, glm::dvec2(camera.eye), skyline[skyline.size() / 2], sheet.size_px);
  }
  content.directions = asked.directions;
  content.view_azimuth_deg = camera.azimuth_deg;
  content.sun_azimuth_deg = bare.view.sun.azimuth_deg;
  content.sun_altitude_deg = bare.view.sun.altitude_deg;
  if (asked.sources) content.sources = source_credits(loaded);
  return content;
}

// The sheet's drawing on paper: names over the picture, the margin around it.
Drawing on_paper(const Drawing& names, const Margin& margin) {
  Drawing all = margin.drawing;
  const glm::dvec2 by(margin.left, margin.top);
  for (DrawnShape shape : names.shapes) {
    move_shape(shape, by);
    all.shapes.push_back(std::move(shape));
  }
  return all;
}

}  // namespace

std::string second_picture(const Scene& scene, bool whole_sheet) {
  if (scene.labels.in_picture && scene.labels.any()) return "panorama_names";
  return scene.margin && whole_sheet ? "panorama_margin" : "";
}

void write_named_picture(const LoadedScene& loaded, PixelRect region, const SheetRows& rows,
                         const PictureLegend& legend, const OutputColour& colour,
                         const FileNotes& notes, const std::string& out_folder, const Run& run) {
  const Scene& scene = loaded.scene;
  const bool whole = region == PixelRect{0, 0, scene.output.width, scene.output.height};
  const std::string stem = second_picture(scene, whole);
  if (!scene.labels.any() && stem.empty()) return;
  const BareView bare = make_bare_view(loaded, run.progress, run.cache);
  const LabelJob job = label_job(loaded, run.progress);
  LabelSheet sheet;
  if (!job.empty()) {
    sheet = make_label_sheet(loaded, job, bare, run.progress);
    const std::vector<std::string>& formats = scene.output.formats;
    const bool has_png = std::find(formats.begin(), formats.end(), "png") != formats.end();
    write_label_files(sheet, bare.dem.crs, out_folder, has_png && whole ? "panorama.png" : "",
                      run.progress);
  } else {
    sheet = empty_label_sheet(load_label_style(job.style), bare.camera->size(),
                              scene.output.sheet_width_mm);
  }
  if (stem.empty()) return;

  Margin margin;
  if (scene.margin && whole)
    margin =
        lay_out_margin(content_of(loaded, bare, sheet, legend), sheet.style.margin, sheet.size_px,
                       sheet.px_per_mm, scene.margin->frame_mm * sheet.px_per_mm);
  const Drawing drawing =
      on_paper(scene.labels.in_picture ? label_drawing(sheet) : Drawing(), margin);
  const SheetPainter painter(drawing);
  const int width = margin.left + region.width() + margin.right;
  const int height = margin.top + region.height() + margin.bottom;
  if (scene.margin && whole) {
    const double mm = scene.output.sheet_width_mm / scene.output.width;
    write_text_file((std::filesystem::path(out_folder) / "margin.svg").string(),
                    drawing_svg(margin.drawing, width * mm));
  }
  run.progress.begin("writing " + stem, height);
  PictureFiles files((std::filesystem::path(out_folder) / stem).string(), scene.output.formats,
                     width, height, {colour.display, colour.profile},
                     scene.output.width / scene.output.sheet_width_mm * 25.4, notes);
  const glm::vec3 paper = colour_of(sheet.style.margin.paper);
  // Bands of paper above and below, between them those of the picture.
  for (int y0 = 0; y0 < height; y0 += rows_per_copy) {
    const int y1 = std::min(height, y0 + rows_per_copy);
    Grid<glm::vec3> band(width, y1 - y0, paper);
    const int first = std::max(y0, margin.top);
    const int end = std::min(y1, margin.top + region.height());
    if (first < end) {
      const Grid<glm::vec3> picture =
          rows(region.y0 + first - margin.top, region.y0 + end - margin.top);
      for (int y = first; y < end; ++y)
        std::copy_n(picture.row(y - first), region.width(), band.row(y - y0) + margin.left);
    }
    painter.paint(band, {region.x0, region.y0 + y0});
    files.write_rows(decode_srgb(band));
    run.progress.advance(y1 - y0);
  }
  files.finish();
}

}  // namespace belvedere
