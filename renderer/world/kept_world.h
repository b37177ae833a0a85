#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "renderer/ground/cached_products.h"
#include "renderer/scene/scene_file.h"
#include "renderer/trace/ground_surroundings.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "renderer/trace/water/water_ground.h"
#include "renderer/world/generalize_view.h"
#include "renderer/world/lazy_value.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// A value with the text of everything that it was made from, and what was noted on the way.
template <class T>
struct Kept {
  std::string key;
  std::shared_ptr<T> value;
  std::vector<std::string> notes = {};
};

// Values of a world that the next one takes over if what they are made from has not changed, for
// programs that make many pictures of one scene. Results never depend on it. The world must be
// destroyed before the next is made, because values are changed in place. Not thread-safe.
struct KeptWorld {
  Kept<SceneDem> dem;
  Kept<LandCover> bare_cover;  // before a map and rivers are laid over it for a camera
  Kept<LandCover> land_cover;
  Kept<GroundSurroundings> surroundings;
  Kept<GroundMasks> masks;
  Kept<GeneralizedTerrain> generalized;
  Kept<TerrainModel> terrain;
  Kept<const LazyValue<std::shared_ptr<const WaterGround>>> waters;
  Kept<const DeformedSurface> surface;
  Kept<const Tracer> tracer;
};

// What has this key, with its notes told again, or what `make(progress)` returns, which is then
// kept. Without a place nothing is.
template <class T, class Make>
std::shared_ptr<T> keep_or_make(Kept<T>* kept, const std::string& key, Progress& progress,
                                const Make& make) {
  if (kept == nullptr) return std::make_shared<T>(make(progress));
  if (kept->value != nullptr && kept->key == key) {
    for (const std::string& note : kept->notes) progress.note(note);
    return kept->value;
  }
  *kept = {};  // before memory is taken for the next
  KeptNotes watcher(progress);
  auto made = std::make_shared<T>(make(watcher));
  *kept = {key, std::move(made), watcher.notes()};
  return kept->value;
}

// The keys: texts that are equal only if the values are.
std::string dem_key(const LoadedScene& loaded);    // settings, and their files' sizes and times
std::string files_key(const LoadedScene& loaded);  // of all files
std::string cover_key(const LoadedScene& loaded);  // of the land cover on a DEM of that key
std::string generalize_key(const LoadedScene& loaded, const View& view);
std::string masks_key(const LoadedScene& loaded);  // of the masks on a ground of these keys
std::string camera_key(const LoadedScene& loaded, const View& view);
std::string deform_key(const View& view);

}  // namespace belvedere
