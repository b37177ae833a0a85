#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/run.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/world/world.h"

namespace belvedere {

// Makes the pieces that are not in the work folder yet, and the notes of the headers. Makes the
// world only if a piece is missing, and then returns its bare view, if the picture has names or a
// margin and its ground no finer windows.
std::optional<BareView> make_pieces(const LoadedScene& loaded, const SheetRequest& request,
                                    std::span<const PixelRect> pieces, const WorkFolder& work,
                                    const Run& run);
// Makes the values that all pieces share, so that others can make the pieces: notes, and how the
// ground is copied.
void make_plan(const LoadedScene& loaded, const SheetRequest& request, const WorkFolder& work,
               const Run& run);

// Names in the work folder. The pictures that matches copy from:
constexpr const char* matched_bytes = "matched";
// The classes of the whole picture, for a margin's legend:
constexpr const char* legend_bytes = "legend";
// The luminance of a small copy of the whole picture, for names:
constexpr const char* luminance_bytes = "luminance";
// The kinds of features, for a margin's legend:
constexpr const char* feature_legend_bytes = "legend_features";

// The plan's parts, so that missing pieces are reported as the parts to run again.
struct PlanOfParts {
  std::string folder;
  int parts = 0;  // 0: no plan
};
// Joins the pieces of a request to its files in `out_folder`, row by row. Error(input) naming the
// pieces that are missing. `seen`: the bare view of the pieces' world, if it is known.
void write_sheet_files(const LoadedScene& loaded, const SheetRequest& request,
                       const WorkFolder& work, const std::string& out_folder, const Run& run,
                       const PlanOfParts& plan = {}, std::optional<BareView> seen = {});

}  // namespace belvedere
