#include "renderer/world/fold_check.h"

#include <fmt/core.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "terrain/deform/fold.h"

namespace belvedere {
namespace {

// The key of what folds the ground.
std::string place_of(const FoldSummary& summary, const SceneDeform& scene) {
  if (!summary.handle) return "deform.field";
  const std::string& name = scene.handles[*summary.handle].name;
  return fmt::format("deform.handles.{}{}", *summary.handle, name.empty() ? "" : " (" + name + ")");
}

}  // namespace

void check_folds(const SceneDeform& scene, const TerrainModel& terrain,
                 const Deformation& deformation, const Camera& camera, Progress& progress) {
  const std::vector<Fold> folds =
      find_folds(terrain.generalized_m, terrain.dem->transform, deformation);
  if (folds.empty()) return;
  std::vector<Fold> in_picture;
  for (const Fold& fold : folds) {
    const double altitude = static_cast<double>(terrain.generalized_m(fold.column, fold.row));
    const auto at = camera.project(deformation.point({fold.position, altitude}));
    if (at && at->x >= 0.0 && at->y >= 0.0 && at->x <= camera.size().x && at->y <= camera.size().y)
      in_picture.push_back(fold);
  }
  const bool refuse = !in_picture.empty() && !scene.allow_folds;
  for (const FoldSummary& summary :
       summarize_folds(refuse ? in_picture : folds, deformation.parameters())) {
    const std::string where = place_of(summary, scene);
    const std::string found = fmt::format("folds the ground{} around E {:.0f} N {:.0f}, {} facets",
                                          refuse ? " in the picture" : "", summary.centre.x,
                                          summary.centre.y, summary.facets);
    if (refuse)
      throw Error(ErrorKind::usage, where, found,
                  summary.handle ? "a smaller move_m, rotate_deg or scale, a larger radius_m, a "
                                   "smaller core_m, or deform.allow_folds = true"
                                 : "places that are displaced less unlike their neighbours, or "
                                   "deform.allow_folds = true");
    progress.note(where + " " + found);
  }
}

}  // namespace belvedere
