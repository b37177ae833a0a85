#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"
#include "terrain/deform/deform.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/io/dem.h"
#include "terrain/io/surface_raster.h"
#include "tools/cli/command_generalize.h"
#include "tools/python/arrays.h"
#include "tools/python/background.h"
#include "tools/python/module.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

using Cell = std::array<double, 2>;
using Altitudes = ArrayOf<float>;

// Its lower left corner is the origin. NaN are voids, which are filled in a copy.
Dem dem_of(const Altitudes& altitude_m, Cell cell_m) {
  Grid<float> cells = lent<float>(altitude_m);
  const GeoTransform transform{0.0, cells.height() * cell_m[1], cell_m[0], cell_m[1]};
  if (std::any_of(cells.begin(), cells.end(), [](float z) { return std::isnan(z); }))
    return make_dem({Grid<float>(cells), transform, {}});
  Grid<std::uint8_t> filled(cells.width(), cells.height());
  return {std::move(cells), std::move(filled), transform, {}, {}};
}

Grid<float> with_voids(Grid<float> cells, const Dem& dem) {
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (dem.filled[i] != 0) cells[i] = std::numeric_limits<float>::quiet_NaN();
  return cells;
}

tools::GeneralizeOptions options_of(const py::dict& given) {
  tools::GeneralizeOptions options;
  take(given, "preset", options.preset);
  take(given, "weights", options.global);
  take(given, "ridges", options.ridges);
  take(given, "valleys", options.valleys);
  take(given, "background_weights", options.background_global);
  take(given, "background_ridges", options.background_ridges);
  take(given, "background_valleys", options.background_valleys);
  take(given, "base", options.bands.base);
  take(given, "curvature", options.curvature);
  take(given, "full_curvature", options.bands.full_curvature);
  take(given, "blur_cells", options.bands.blur_cells);
  take(given, "exponent", options.bands.exponent);
  take(given, "viewer", options.viewer);
  take(given, "distances", options.distances);
  take(given, "mask_slope", options.mask_slope);
  take(given, "automatic_mask", options.automatic_mask);
  take(given, "change_lakes", options.change_lakes);
  take(given, "destripe", options.operators.destripe);
  take(given, "line_integral", options.operators.line_integral);
  take(given, "widen_valleys_m", options.operators.widen_valleys_m);
  return options;
}

py::array generalize_array(const Altitudes& altitude_m, Cell cell_m, const py::dict& given,
                           const std::optional<Altitudes>& mask, const py::tuple& run_request) {
  const tools::GeneralizeOptions options = options_of(given);
  const GeneralizeParameters bands = tools::resolve_bands(options);
  return array_of(in_background(run_request, [&](const Run& run) {
    Dem dem = dem_of(altitude_m, cell_m);
    const auto read_mask = [&] { return mask ? soften_mask(lent<float>(*mask)) : Grid<float>(); };
    return with_voids(
        tools::generalize_dem(options, bands, dem, {cell_m[0], cell_m[1]}, read_mask, run.progress)
            .altitude_m,
        dem);
  }));
}

// settings: keys of a scene's [deform], as of --set. Vertices, or heights on the same cells.
py::array deform_array(const Altitudes& altitude_m, Cell cell_m, std::array<double, 2> viewer,
                       const std::vector<std::string>& settings, bool raster,
                       const py::tuple& run_request) {
  const std::string text = "version = 1\n[terrain.synthetic]\n[camera]\nposition = [0, 0]\n";
  const SceneDeform asked =
      parse_scene(text, "deform", "", {.data_folders = {}, .settings = settings}).scene.deform;
  Grid<glm::vec3> vertices_m;
  Grid<float> heights_m;
  run_in_background(run_request, [&](const Run& run) {
    const Dem dem = dem_of(altitude_m, cell_m);
    const Deformation deformation(resolve_deform(asked, dem), {viewer[0], viewer[1]});
    run.progress.begin("deforming", 0.0);
    if (raster)
      heights_m = raster_of_moved(with_voids(dem.altitude_m, dem), dem.transform,
                                  [&](glm::dvec3 at) { return deformation.point(at); });
    else
      vertices_m = deform(dem.altitude_m, dem.transform, glm::dvec3(0.0), deformation).vertices_m;
  });
  return raster ? array_of(std::move(heights_m)) : array_of(std::move(vertices_m));
}

}  // namespace

void add_terrain(py::module_& module) {
  module.def("generalize", &generalize_array);
  module.def("generalize_presets", [] {
    py::dict out;
    for (const GeneralizePreset& preset : generalize_presets())
      out[py::str(std::string(preset.name))] = std::string(preset.meaning);
    return out;
  });
  module.def("deform", &deform_array);
}

}  // namespace belvedere::python
