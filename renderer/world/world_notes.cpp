#include "renderer/world/world_notes.h"

#include <fmt/core.h>

#include <string>

#include "renderer/image/provenance.h"
#include "renderer/scene/input_hash.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

FileNotes make_world_notes(const LoadedScene& loaded, const World& world) {
  Provenance provenance = make_provenance(write_scene(loaded.scene), {});
  for (const SceneInput& input : scene_inputs(loaded))
    if (!input.path.empty()) provenance.inputs[input.file] = hash_input(input.path).hash;
  provenance.instruction_set = world.tracer.description();
  FileNotes notes = to_notes(provenance);
  const CameraParameters& camera = world.view.camera;
  notes["belvedere:camera"] =
      fmt::format("{} eye {:.3f} {:.3f} {:.3f} azimuth {:.6f} pitch {:.6f} field {:.4f}",
                  camera.projection, camera.eye.x, camera.eye.y, camera.eye.z, camera.azimuth_deg,
                  camera.pitch_deg, camera.field_of_view_deg);
  notes["belvedere:crs"] = world.dem->crs.empty() ? "none" : describe_crs(world.dem->crs);
  notes["belvedere:sun"] = fmt::format("azimuth {:.4f} altitude {:.4f}", world.view.sun.azimuth_deg,
                                       world.view.sun.altitude_deg);
  return notes;
}

}  // namespace belvedere
