#pragma once

#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/land_cover_class.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"
#include "texture/composite/make_composite.h"

namespace belvedere {

// The classes that the labels of a composite paint: their numbers, as in masks of paintings.
// Error(usage) that names `path` for a composite with other labels.
std::vector<LandCoverClass> classes_of_labels(const CompositeModel& composite,
                                              const std::string& path);

struct GroundTextureParameters {
  double texel_m = 10.0;  // side of the composite's pixels on the ground, > 0
  TextureParameters make{};
};

// The ground painted by a composite learnt from above, as the landscapes of Zalesny et al. (2005):
// each class by its label's texture, with their transition along borders. Classes that no label
// paints stay unknown. Texels lie on a lattice through the origin of the CRS and are made in its
// fixed tiles, so that a place has the same texel whatever the frame, if the cover is the same.
// `classes`: of the composite's labels. Error(limit) for more than 2^30 texels.
Raster<GroundColour> paint_ground_texture(const CompositeModel& composite,
                                          const std::vector<LandCoverClass>& classes,
                                          const LandCover& cover, const RasterFrame& frame,
                                          const GroundTextureParameters& parameters,
                                          Progress& progress = silent_progress());

// The composite of a scene on its ground. Windows have none of their own: its texels are as fine
// for the whole.
Raster<GroundColour> make_scene_texture(const LoadedScene& loaded, const LandCover& cover,
                                        const Dem& dem, Progress& progress, const Cache& cache);

}  // namespace belvedere
