#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/cache/cache.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "renderer/paint/composite.h"
#include "renderer/pipeline/view_judgement.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/light/seen_ranges.h"
#include "renderer/world/view.h"
#include "terrain/cover/land_cover_patches.h"

namespace belvedere {

// What is known of a scene before it is rendered.
struct SceneReport {
  std::vector<SceneInput> inputs;
  std::string crs;
  int cells_wide = 0;
  int cells_high = 0;
  double cell_m = 0.0;
  std::string larger_than_memory;  // cells that the picture would be made from, where it cannot be those of the data; else empty
  View view;
  std::vector<std::pair<LandCoverClass, double>> classes;  // seen in the picture, with their share of its area
  std::vector<ClassArea> land_cover;                       // where small patches are taken out: each class before and after
  std::vector<std::string> exemplars;
  ViewJudgement judgement;              // of the picture's composition
  std::vector<SeenRange> ranges;        // how the light falls on what it shows, by falling share; without their slopes
  std::vector<ProposedLight> proposed;  // regions of light that would help, where they were asked for
};

// Everything about a scene that shows without rendering it: files, data, terrain, the camera's place, the palette, and, from a small trace
// of the view, whether some exemplar has texels of each class in the picture. Nothing is painted, and the ground is the picture's own, so
// that with a cache rendering finds it made. Throws what rendering would throw, and Error(usage) for classes that have neither texels nor a
// fallback that has. `propose`: whether to look for regions of light that would help ranges in shade.
SceneReport check_scene(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache(), bool propose = false);

// The exemplars of a scene as rendering would have them, and what its picture asks of them, from a small trace of the view.
struct SceneExemplars {
  std::vector<PaintedExemplar> exemplars;
  GuideStack view;                 // of the small trace
  double pixels_of_picture = 1.0;  // that each pixel of `view` stands for
};
// Throws what check_scene throws for files; classes without texels are no error here.
SceneExemplars look_at_exemplars(const LoadedScene& scene, Progress& progress, const Cache& cache = no_cache());

}  // namespace belvedere
