#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "renderer/compose/view_score.h"
#include "renderer/paint/composite.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/scene_light.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover_patches.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Evaluates the composition of any scene's picture, by the measures and the table that views are
// proposed by.
struct ViewEvaluation {
  std::vector<ScoreTerm> terms;  // empty if not evaluated
  std::string why_not;           // the reason, if not evaluated
  double merit = 0.0;            // 0…10
  std::string subject;           // description of the main subject
  double near_m = 0.0;           // where level ground meets the lower edge
  double far_m = 0.0;            // the horizon

  bool evaluated() const { return !terms.empty(); }
};

// Evaluates a view on the ground as changed by handles, summits and valleys wider by
// `widen_valleys_m`, under the scene's own bend and exaggeration. Parallel projections are not
// evaluated: they have neither sky nor horizon.
ViewEvaluation evaluate_view(const CoarseAltitudes& region, const View& view,
                             double widen_valleys_m = 0.0);

// Findings on a scene before it is rendered.
struct SceneReport {
  std::vector<SceneInput> inputs;
  std::string crs;
  int cells_wide = 0;
  int cells_high = 0;
  double cell_m = 0.0;
  std::string larger_than_memory;  // cells that the picture would be made from, if coarser than the
                                   // data's; else empty
  View view;
  std::vector<std::pair<LandCoverClass, double>>
      classes;  // visible in the picture, with their share of its area
  std::vector<ClassArea>
      land_cover;  // where small patches are removed: each class before and after
  std::vector<std::string> exemplars;
  std::vector<std::vector<LandCoverClass>> exemplar_classes;  // visible ones, of each exemplar
  ViewEvaluation evaluation;                                  // evaluation of the composition
  std::vector<SeenRange> ranges;  // light on its ranges, by falling share; without their slopes
  std::vector<ProposedLight> proposed;  // regions of light that would help, if requested
};

// Checks everything about a scene that can be checked without rendering it: files, data, terrain,
// the camera's position, the palette, and, by a small trace of the view, whether some exemplar has
// texels of each class in the picture. Nothing is painted, and the ground is the picture's own, so
// that rendering finds it in the cache. Throws what rendering would throw, and Error(usage) for
// classes that have neither texels nor a fallback with texels. `propose`: whether to look for
// regions of light that would help ranges in shade.
SceneReport check_scene(const LoadedScene& scene, Progress& progress,
                        const Cache& cache = no_cache(), bool propose = false);

// The exemplars of a scene as for rendering (the program's own sheet if the scene copies nothing),
// and the demand of its picture on them, from a small trace of the view.
struct SceneExemplars {
  std::vector<PaintedExemplar> exemplars;
  GuideStack view;                 // of the small trace
  double pixels_of_picture = 1.0;  // that each pixel of `view` represents
};
// Throws what check_scene throws for files; classes without texels are not an error here.
SceneExemplars look_at_exemplars(const LoadedScene& scene, Progress& progress,
                                 const Cache& cache = no_cache());

}  // namespace belvedere
