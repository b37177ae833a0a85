#pragma once

#include <span>
#include <string>

#include "base/run.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/work_folder.h"

namespace belvedere {

// Makes those of the pieces that are not in the work folder yet, and what the files of the whole need besides them (the notes of their
// headers). Makes the world only where a piece is missing.
void make_pieces(const LoadedScene& loaded, const SheetRequest& request, std::span<const PixelRect> pieces, const WorkFolder& work,
                 const Run& run);
// What all pieces share, for others to make them: notes, and how the ground is copied.
void make_plan(const LoadedScene& loaded, const SheetRequest& request, const WorkFolder& work, const Run& run);

// What the work folder keeps the pictures under that matches copy from.
constexpr const char* matched_bytes = "matched";
// … and the classes that the whole picture shows, for a margin's legend.
constexpr const char* legend_bytes = "legend";
// … and the kinds of features.
constexpr const char* feature_legend_bytes = "legend_features";

// Whose parts the pieces are, so that missing ones are told by the parts to run again.
struct PlanOfParts {
  std::string folder;
  int parts = 0;  // 0: no plan
};
// Joins the pieces of a request to its files in `out_folder`, row by row. Error(input) naming the pieces that are missing.
void write_sheet_files(const LoadedScene& loaded, const SheetRequest& request, const WorkFolder& work, const std::string& out_folder,
                       const Run& run, const PlanOfParts& plan = {});

}  // namespace belvedere
