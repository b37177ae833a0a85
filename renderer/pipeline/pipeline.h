#pragma once

#include <string>

#include "base/run.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// The whole main job: pieces of the sheet, one after the other in a folder of their own, joined to guidance.exr and the panorama in the
// formats of output.formats, and to match.exr where it is asked for. Memory does not grow with the sheet. Where it is stopped, the finished
// pieces stay, and a request that resumes goes on from them to the same bytes.
void render(const LoadedScene& scene, const std::string& out_folder, const Run& run, const SheetRequest& request = {});
// The same, guidance alone.
void render_guidance(const LoadedScene& scene, const std::string& out_folder, const Run& run, const SheetRequest& request = {});

// One sheet by many: a folder that all of them see gets the plan, then anyone makes parts 1 … `parts` in any order and any number at once,
// and one joins them. Each may be run again: what is there and whole is not made twice. The same bytes as render() with this request,
// which is the same for all of them.
void plan_sheet(const LoadedScene& scene, const std::string& folder, const Run& run, const SheetRequest& request = {});
// Error(usage) for a part that is none, and where scene, inputs, request or program are not those of the plan.
void make_part(const LoadedScene& scene, const std::string& folder, int part, int parts, const Run& run, const SheetRequest& request = {});
// Of a plan of `parts`. Error(input) naming the parts that are missing or not whole.
void join_parts(const LoadedScene& scene, const std::string& folder, int parts, const std::string& out_folder, const Run& run,
                const SheetRequest& request = {});

// Where the pieces of a run lie.
std::string work_folder_of(const std::string& out_folder);

}  // namespace belvedere
