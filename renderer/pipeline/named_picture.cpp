#include "renderer/pipeline/named_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <glm/common.hpp>
#include <iterator>
#include <memory>
#include <string_view>

#include "base/files/output_file.h"
#include "base/text/hex_colour.h"
#include "renderer/image/layers/layer_file.h"
#include "renderer/image/rows/picture_files.h"
#include "renderer/labels/drawing_svg.h"
#include "renderer/labels/label_files.h"
#include "renderer/labels/margin_blocks.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/scene_labels.h"
#include "renderer/stages/picture_layers.h"

namespace belvedere {
namespace {

constexpr int rows_per_copy = 128;

// A picture in another size, by linear interpolation; of its own size, itself.
Grid<glm::vec3> scaled(const Grid<glm::vec3>& picture, int width, int height) {
  Grid<glm::vec3> out(width, height);
  const auto at = [](int i, int to, int from) {
    return std::clamp((i + .5) * from / to - .5, 0.0, from - 1.0);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::dvec2 p(at(x, width, picture.width()), at(y, height, picture.height()));
      const glm::ivec2 a(p);
      const glm::ivec2 b = glm::min(a + 1, glm::ivec2(picture.width(), picture.height()) - 1);
      const glm::vec2 share(p - glm::dvec2(a));
      out(x, y) = glm::mix(glm::mix(picture(a.x, a.y), picture(b.x, a.y), share.x),
                           glm::mix(picture(a.x, b.y), picture(b.x, b.y), share.x), share.y);
    }
  return out;
}

// Those rows of a swatch that lie in a band of paper which begins with row y0.
void copy_swatch(const Grid<glm::vec3>& swatch, PixelRect to, int y0, Grid<glm::vec3>& band) {
  for (int y = std::max(to.y0, y0); y < std::min(to.y1, y0 + band.height()); ++y)
    std::copy_n(swatch.row(y - to.y0), swatch.width(), band.row(y - y0) + to.x0);
}

// The scale of the scene's style, without names.
LabelSheet bare_sheet(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  return empty_label_sheet(read_label_style(loaded), {scene.output.width, scene.output.height},
                           scene.output.sheet_width_mm);
}

// The piece of the picture below features: snow in winter, else a meadow.
PixelRect open_ground(const PictureLegend& legend) {
  const bool winter = luminance(colour_of_hex(legend.features.front().ground).value()) > .6;
  for (const char* name : {winter ? "snow" : "pasture", winter ? "glacier" : "alpine grass"})
    for (const LegendEntry& entry : legend.classes)
      if (entry.name == name && !entry.at.empty()) return entry.at;
  return {};
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
    if (!legend.features.empty()) content.features_at = open_ground(legend);
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

}  // namespace

NamedSheet lay_out_names(const LoadedScene& loaded, const BareView& bare,
                         const PictureLegend& legend, bool whole, Progress& progress) {
  const Scene& scene = loaded.scene;
  NamedSheet out;
  const LabelJob job = label_job(loaded, progress);
  if (!job.empty()) {
    out.names = make_label_sheet(loaded, job, bare, progress);
    if (legend.luminance.size() > 0) choose_inks(out.names, legend.luminance);
  } else {
    out.names = empty_label_sheet(read_label_style(loaded), bare.camera->size(),
                                  scene.output.sheet_width_mm);
  }
  if (scene.margin && whole)
    out.margin = lay_out_margin(content_of(loaded, bare, out.names, legend), out.names.style.margin,
                                out.names.size_px, out.names.px_per_mm,
                                scene.margin->frame_mm * out.names.px_per_mm);
  return out;
}

std::string second_picture(const Scene& scene, bool whole_sheet) {
  if (scene.labels.in_picture && scene.labels.any()) return "panorama_names";
  return scene.margin && whole_sheet ? "panorama_margin" : "";
}

NamedWindow::NamedWindow(const PaintedRows& painted, PixelRect rect, int reach_px)
    : from_y(std::max(rect.y0 - reach_px, painted.region.y0)),
      rows(painted.rows(from_y, std::min(rect.y1 + reach_px, painted.region.y1))),
      part(part_of(rows, moved(rect, -painted.region.x0, -from_y))),
      around{rows, {painted.region.x0, from_y}} {}

glm::dvec2 legend_swatch_px(const LoadedScene& loaded) {
  const LabelSheet names = bare_sheet(loaded);
  return swatch_size_mm(names.style.margin) *
         MarginSetter(names.style.margin, names.px_per_mm, names.size_px.x).mm(1.0);
}

bool shows_names(const Scene& scene, const SheetRequest& request) {
  return request.panorama && scene.labels.any() &&
         (scene.labels.in_picture || !request.layers.empty());
}

PixelRect region_with_halos(const LoadedScene& loaded, const SheetRequest& request) {
  const Scene& scene = loaded.scene;
  const PixelRect region = region_of(scene, request);
  const PixelRect sheet{0, 0, scene.output.width, scene.output.height};
  if (region == sheet || !shows_names(scene, request)) return region;
  const LabelSheet names = bare_sheet(loaded);
  double halo_mm = 0.0;
  for (const LabelKindStyle& kind : names.style.kinds) halo_mm = std::max(halo_mm, kind.halo_mm);
  return intersection(sheet, grown(region, halo_reach_px(halo_blur_px(halo_mm * names.px_per_mm))));
}

void write_named_picture(const LoadedScene& loaded, PixelRect region, const PaintedRows& painted,
                         const PictureLegend& legend, const OutputColour& colour,
                         const FileNotes& notes, const LazyValue<BareView>& lazy_bare,
                         const std::string& out_folder, const Run& run) {
  const Scene& scene = loaded.scene;
  const bool whole = region == PixelRect{0, 0, scene.output.width, scene.output.height};
  const std::string stem = second_picture(scene, whole);
  if (!scene.labels.any() && stem.empty()) return;
  const BareView& bare = lazy_bare.get();
  const auto [sheet, margin] = lay_out_names(loaded, bare, legend, whole, run.progress);
  if (!label_job(loaded, silent_progress()).empty()) {
    const std::vector<std::string>& formats = scene.output.formats;
    const bool has_png = std::find(formats.begin(), formats.end(), "png") != formats.end();
    write_label_files(sheet, bare.dem->crs, out_folder, has_png && whole ? "panorama.png" : "",
                      run.progress);
  }
  if (stem.empty()) return;

  const SheetPainter names(scene.labels.in_picture ? label_drawing(sheet) : Drawing());
  const SheetPainter paper_painter(margin.drawing);
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
  const glm::vec3 paper = colour_of_hex(sheet.style.margin.paper).value();
  std::vector<Grid<glm::vec3>> swatches;
  for (const LegendCrop& crop : margin.crops) {
    const Grid<glm::vec3> rows = painted.rows(crop.from.y0, crop.from.y1);
    swatches.push_back(scaled(part_of(rows, moved(crop.from, -painted.region.x0, -crop.from.y0)),
                              crop.to.width(), crop.to.height()));
  }
  // Bands of paper above and below, between them those of the picture.
  for (int y0 = 0; y0 < height; y0 += rows_per_copy) {
    const int y1 = std::min(height, y0 + rows_per_copy);
    Grid<glm::vec3> band(width, y1 - y0, paper);
    for (std::size_t i = 0; i < swatches.size(); ++i)
      copy_swatch(swatches[i], margin.crops[i].to, y0, band);
    paper_painter.paint(band, {0, y0});
    const int first = std::max(y0, margin.top);
    const int end = std::min(y1, margin.top + region.height());
    if (first < end) {
      const int from = region.y0 + first - margin.top;
      const PixelRect part{region.x0, from, region.x1, from + end - first};
      const NamedWindow window(painted, part, names.halo_reach());
      Grid<glm::vec3> picture = window.part;
      names.paint(picture, {part.x0, part.y0}, &window.around);
      for (int y = first; y < end; ++y)
        std::copy_n(picture.row(y - first), region.width(), band.row(y - y0) + margin.left);
    }
    files.write_rows(decode_srgb(band));
    run.progress.advance(y1 - y0);
  }
  files.finish();
}

namespace {

// Nothing where the scene names nothing, or all its files are optional and missing.
std::shared_ptr<const SheetPainter> names_of(const LoadedScene& loaded,
                                             const Grid<float>& luminance,
                                             const LazyValue<BareView>& bare, const Run& run) {
  if (!loaded.scene.labels.any()) return nullptr;
  const LabelJob job = label_job(loaded, run.progress);
  if (job.empty()) return nullptr;
  LabelSheet sheet = make_label_sheet(loaded, job, bare.get(), run.progress);
  if (luminance.size() > 0) choose_inks(sheet, luminance);
  return std::make_shared<SheetPainter>(label_drawing(sheet));
}

// A drawing without what is below it, but with halos of the painting. Drawn over black it shows its
// colour times its opacity; over white the transmitted white is added.
Grid<LayerPixel> paint_alone(const SheetPainter& painter, const PaintedRows& painted,
                             PixelRect rect) {
  const NamedWindow window(painted, rect, painter.halo_reach());
  Grid<glm::vec3> black(rect.width(), rect.height(), glm::vec3(0.0F));
  Grid<glm::vec3> white(rect.width(), rect.height(), glm::vec3(1.0F));
  painter.paint(black, {rect.x0, rect.y0}, &window.around);
  painter.paint(white, {rect.x0, rect.y0}, &window.around);
  Grid<LayerPixel> out(rect.width(), rect.height(), LayerPixel{});
  for (std::size_t i = 0; i < out.size(); ++i) {
    const glm::vec3 left = white[i] - black[i];
    const float opacity = 1.0F - (left.x + left.y + left.z) / 3.0F;
    if (opacity < 0.5F / 65535.0F) continue;
    const auto whole = [](float value) {
      return static_cast<std::uint16_t>(std::clamp(value, 0.0F, 1.0F) * 65535.0F + 0.5F);
    };
    const glm::vec3 colour = black[i] / opacity;
    out[i] = {whole(colour.x), whole(colour.y), whole(colour.z), whole(opacity)};
  }
  return out;
}

}  // namespace

void write_layer_files(const LoadedScene& loaded, const SheetRequest& request,
                       const JoinedPieces& joined, const PaintedRows& painted,
                       const Grid<float>& luminance, const LazyValue<BareView>& bare,
                       const std::string& out_folder, const Run& run) {
  if (request.layers.empty()) return;
  const Scene& scene = loaded.scene;
  const PixelRect region = joined.region;
  const auto rows_of = [&](std::string_view product, int y0, int y1) {
    Grid<LayerPixel> rows(region.width(), y1 - y0);
    joined.read(std::string(product), region.y0 + y0, region.y0 + y1, {plane_of(rows)});
    return rows;
  };
  LayeredSheet sheet{region.width(),
                     region.height(),
                     scene.output.width / scene.output.sheet_width_mm * 25.4,
                     {},
                     {}};
  for (const PictureLayer& layer : picture_layers()) {
    const bool none = (layer.of == LayerOf::features && !scene.any_features()) ||
                      (layer.of == LayerOf::mist && scene.air.mist.empty());
    if (none) continue;
    sheet.layers.push_back(
        {layer.name, layer.title, layer.mask, [&rows_of, &layer](int y0, int y1) {
           const Grid<LayerPixel> plane = rows_of(layer_plane_names()[layer.plane], y0, y1);
           return make_layer(layer, plane, rows_of(layer_plane_names()[about_plane], y0, y1));
         }});
  }
  if (const std::shared_ptr<const SheetPainter> painter = names_of(loaded, luminance, bare, run)) {
    sheet.layers.push_back({"names", "Names", true, [painter, region, painted](int y0, int y1) {
                              return paint_alone(
                                  *painter, painted,
                                  {region.x0, region.y0 + y0, region.x1, region.y0 + y1});
                            }});
  }
  sheet.merged = [&](int y0, int y1) {
    Grid<glm::vec3> rows(region.width(), y1 - y0);
    joined.read("panorama", region.y0 + y0, region.y0 + y1, {plane_of(rows)});
    return opaque_pixels(rows);
  };
  for (const std::string& extension : request.layers) {
    const LayerFormat& format = layer_format(extension);
    format.write((std::filesystem::path(out_folder) / format.file).string(), sheet, run.progress);
  }
}

}  // namespace belvedere
