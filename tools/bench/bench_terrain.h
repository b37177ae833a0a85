#pragma once

#include <vector>

#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"

namespace belvedere::bench {

// Ridged noise of size × size cells of 30 m.
Dem make_bench_dem(int size);
// That terrain undeformed, exaggerated 1.6 times, vertices relative to its centre.
DeformedSurface make_bench_surface(const Dem& dem);
// A view of the whole terrain from beyond its northern rim; its size is a multiple of 4.
CameraParameters bench_view(const Dem& dem, int width, int height);
// The rays of a view, each 16 a bundle of 4 × 4 pixels.
std::vector<Ray> bundle_rays(const Camera& camera);

}  // namespace belvedere::bench
