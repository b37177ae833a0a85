#pragma once

#include <string>

#include "base/run.h"
#include "renderer/pipeline/scene_paint.h"
#include "renderer/pipeline/sheet_pieces.h"
#include "renderer/scene/scene_file.h"
#include "renderer/sheet/work_folder.h"
#include "renderer/stages/stages.h"
#include "renderer/world/scene_values.h"
#include "renderer/world/world.h"

namespace belvedere {

struct SheetWorkParameters {
  std::string scratch_folder;  // for tiles beyond kept_tile_bytes(); empty: temporary files
  bool rock_relief = true;     // false, for previews: slopes as smooth as the DEM, without ribs
  int tile_px = 0;             // of the stages, 64…4096; 0: by memory. Changes no pixel
  ValueStore* kept = nullptr;  // values of the previous world, to reuse; may be null
  ValueStore* kept_paint = nullptr;  // the same of its paint, if the scene copies nothing
  bool keep_rays = false;            // of the whole sheet, in `kept`; needs rock_relief off
};

// Everything that the stages of a sheet are made of, and the ground stages. The members refer to
// each other by address. `run` reports the preparation, `stage_run` the stages. Error as
// read_scene_paint and make_world.
struct SheetWork {
  SheetWork(const LoadedScene& loaded, const SheetRequest& request,
            const SheetWorkParameters& parameters, const Run& run, const Run& stage_run);
  SheetWork(const SheetWork&) = delete;
  SheetWork& operator=(const SheetWork&) = delete;

  ScenePaint paint;
  World world;
  TileStore::Place scratch;
  SheetView view;
  int block_px;  // side of the squares painted at once
  StageGraph graph;
  GroundStages ground = {};

 private:
  SheetWork(const LoadedScene& loaded, const SheetRequest& request,
            const SheetWorkParameters& parameters, const Run& run, const Run& stage_run,
            const Value<ScenePaint>& read);
};

// Whether the ground of a request is copied from paintings.
bool is_copied(const Scene& scene, const SheetRequest& request);

}  // namespace belvedere
