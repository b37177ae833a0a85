#pragma once

#include <string>

#include "base/run.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/joined_pieces.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/valley_view.h"

namespace belvedere {

// Writes the requested files of layers, layer after layer from the pieces, a band of rows at a
// time. If the scene has labels, they are a hidden layer on top: the others make the panorama, with
// it they make panorama_names. A scene without roads and lifts has no layer of them. `painted`: of
// region_with_halos; `luminance`: of PictureLegend.
void write_layer_files(const LoadedScene& loaded, const SheetRequest& request,
                       const JoinedPieces& joined, const PaintedRows& painted,
                       const Grid<float>& luminance, const LazyValue<BareView>& bare,
                       const std::string& out_folder, const Run& run);

}  // namespace belvedere
