#include "renderer/pipeline/layer_files.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>

#include "renderer/image/layers/layer_file.h"
#include "renderer/labels/label_drawing.h"
#include "renderer/labels/sheet_painter.h"
#include "renderer/pipeline/scene_labels.h"
#include "renderer/stages/picture_layers.h"
#include "renderer/world/valley_view.h"

namespace belvedere {
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
