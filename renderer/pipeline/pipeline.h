#pragma once

#include <string>
#include <vector>

#include "base/run.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"
#include "renderer/scene/scene_lock.h"

namespace belvedere {

// Renders a scene: makes the pieces of the sheet, one after the other in their own folder, and
// joins them to guidance.exr and the panorama in the formats of output.formats, and to match.exr if
// requested. Memory does not grow with the sheet. After an interruption the finished pieces remain,
// and a resumed run continues from them to the same bytes.
void render(const LoadedScene& scene, const std::string& out_folder, const Run& run,
            const SheetRequest& request = {});

// Renders one sheet by several processes or machines: a shared folder gets the plan, then anyone
// makes parts 1 … `parts` in any order and any number at once, and one joins them. Each may be run
// again: complete pieces are not made twice. The bytes are those of render() with the same request,
// which all of them must use.
void plan_sheet(const LoadedScene& scene, const std::string& folder, const Run& run,
                const SheetRequest& request = {});
// Makes one part. Error(usage) for an invalid part, and where scene, inputs, request or program
// differ from those of the plan.
void make_part(const LoadedScene& scene, const std::string& folder, int part, int parts,
               const Run& run, const SheetRequest& request = {});
// Joins the `parts` of a plan to the files of the sheet. Error(input) naming parts that are missing
// or incomplete.
void join_parts(const LoadedScene& scene, const std::string& folder, int parts,
                const std::string& out_folder, const Run& run, const SheetRequest& request = {});

// Names of the files that a request makes; further names of profiles follow from the data.
std::vector<std::string> result_names(const Scene& scene, const SheetRequest& request);
// The folder of the pieces of a run.
std::string work_folder_of(const std::string& out_folder);

// Names of the files that rendering a scene writes.
std::vector<std::string> product_names(const Scene& scene);

// The scene at another width, px, its height in proportion; strokes keep their size on the sheet.
LoadedScene at_width(const LoadedScene& scene, int width_px);

// Renders the unchanged scene into a folder and hashes the products. The picture formats are
// lossless, so all are hashed.
std::vector<LockedProduct> render_and_hash(const LoadedScene& scene, const std::string& out_folder,
                                           const Run& run, bool replace = false);

}  // namespace belvedere
