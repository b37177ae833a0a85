#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/run.h"
#include "renderer/image/image_file.h"
#include "renderer/labels/labels.h"
#include "renderer/labels/margin.h"
#include "renderer/labels/sheet_painter.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/world.h"

namespace belvedere {

// Content of a margin's legend, and the luminance that names stand on.
struct PictureLegend {
  std::vector<LegendEntry> classes;
  std::vector<FeatureSwatch> features;
  Grid<float> luminance = {};  // of a small copy of the whole picture; empty: not known
};

// Everything that is drawn over the picture and around it.
struct NamedSheet {
  LabelSheet names;
  Margin margin;  // empty without [margin], and for a part of the sheet
};
// Error as of make_label_sheet. `whole`: the whole sheet is shown.
NamedSheet lay_out_names(const LoadedScene& loaded, const BareView& bare,
                         const PictureLegend& legend, bool whole, Progress& progress);

// Rows [y0, y1) of the sheet over the width of `region`, encoded sRGB.
struct PaintedRows {
  PixelRect region;
  std::function<Grid<glm::vec3>(int y0, int y1)> rows;
};

// A rectangle of the picture, and the rows around it that halos of names in it read.
struct NamedWindow {
  NamedWindow(const PaintedRows& painted, PixelRect rect, int reach_px);
  NamedWindow(const NamedWindow&) = delete;
  NamedWindow& operator=(const NamedWindow&) = delete;

  int from_y;
  Grid<glm::vec3> rows;
  Grid<glm::vec3> part;
  PictureWindow around;
};

// Stem of the second picture of a scene: with names drawn in if [labels] has in_picture, in a
// margin if there is [margin]; empty without both, and for a part of the sheet that would show
// neither.
std::string second_picture(const Scene& scene, bool whole_sheet = true);

// Whether names are painted, into the second picture or a layer.
bool shows_names(const Scene& scene, const SheetRequest& request);
// The requested pixels, and those around a part that the halos of its names are made from.
PixelRect region_with_halos(const LoadedScene& loaded, const SheetRequest& request);

// The size of a swatch of its margin's legend, px.
glm::dvec2 legend_swatch_px(const LoadedScene& loaded);

// Writes the results of [labels] and [margin] besides the panorama: labels.svg and the tables, and
// the second picture. A part of a sheet has no margin; its names are where the whole sheet has
// them. `painted`: the rows of region_with_halos.
void write_named_picture(const LoadedScene& loaded, PixelRect region, const PaintedRows& painted,
                         const PictureLegend& legend, const OutputColour& colour,
                         const FileNotes& notes, const LazyValue<BareView>& lazy_bare,
                         const std::string& out_folder, const Run& run);

// Writes the requested files of layers, layer after layer from the pieces, a band of rows at a
// time. If the scene has labels, they are a hidden layer on top: the other layers make the
// panorama, all together panorama_names. A scene without roads and lifts has no layer of them.
// `painted`: the rows of region_with_halos; `luminance`: of PictureLegend.
void write_layer_files(const LoadedScene& loaded, const SheetRequest& request,
                       const JoinedPieces& joined, const PaintedRows& painted,
                       const Grid<float>& luminance, const LazyValue<BareView>& bare,
                       const std::string& out_folder, const Run& run);

}  // namespace belvedere
