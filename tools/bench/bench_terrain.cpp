#include "tools/bench/bench_terrain.h"

#include "terrain/synthetic/synthetic.h"

namespace belvedere::bench {

Dem make_bench_dem(int size) {
  SyntheticParameters parameters;
  parameters.width = size;
  parameters.height = size;
  return make_ridged_noise(parameters);
}

DeformedSurface make_bench_surface(const Dem& dem) {
  const glm::dvec2 centre = dem.transform.to_crs(0.5 * dem.width(), 0.5 * dem.height());
  DeformParameters parameters;
  parameters.exaggeration = 1.6;
  return deform(dem.altitude_m, dem.transform, centre, {centre, 0.0}, parameters);
}

CameraParameters bench_view(const Dem& dem, int width, int height) {
  const double side_m = dem.width() * dem.cell_m();
  const glm::dvec2 north = dem.transform.to_crs(0.5 * dem.width(), 0.0);
  CameraParameters parameters;
  parameters.width = width;
  parameters.height = height;
  parameters.eye = {north.x, north.y + 0.4 * side_m, 6000.0 + 0.25 * side_m};
  parameters.azimuth_deg = 180.0;
  parameters.pitch_deg = -22.0;
  parameters.field_of_view_deg = 50.0;
  return parameters;
}

std::vector<Ray> bundle_rays(const Camera& camera) {
  std::vector<Ray> rays;
  for (int y = 0; y < camera.size().y; y += 4) {
    for (int x = 0; x < camera.size().x; x += 4) {
      for (int k = 0; k < 16; ++k) rays.push_back(camera.ray({x + k % 4 + 0.5, y + k / 4 + 0.5}));
    }
  }
  return rays;
}

}  // namespace belvedere::bench
