#include "terrain/layers/layer_climate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/climate/map_climate.h"
#include "terrain/cover/ground_lakes.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/io/raster_io.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {
namespace {

constexpr double smoothing_m =
    45.0;                          // standard deviation; slopes of scanned DEMs show their stripes
constexpr double parts = 65536.0;  // per unit, for rounding
// Surroundings of a window that cast shadows into it: beyond its halo, ground 2000 m higher hides
// at most eight degrees of sky.
constexpr double shadow_reach_m = 9000.0;

bool named(const std::vector<std::string>& names, LayerInputKind kind) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return layer_input_kind(name) == kind; });
}

struct Computed {
  bool temperature, rain, radiation, sky_view, treeline;
};
Computed computed(const std::vector<std::string>& names, const LayerClimateFiles& files) {
  using enum LayerInputKind;
  return {named(names, temperature) && files.temperature.empty(),
          named(names, rain) && files.rain.empty(),
          named(names, radiation) && files.radiation.empty(),
          named(names, sky_view) && files.sky_view.empty(), named(names, treeline)};
}

Grid<float> read_grid(const std::string& path, const Dem& dem, Progress& progress) {
  RasterSource source;
  source.path = path;
  source.unit_to_m = 1.0;  // values, not altitudes
  // Voids are filled as a DEM's are: smoothly from their borders.
  return make_dem(
             warp_rasters({source}, {dem.transform, dem.width(), dem.height(), dem.crs}, progress))
      .altitude_m;
}

// A value of the climate at each cell's position and altitude.
template <class Value>
Grid<float> from_climate(const Dem& dem, const Dem& of_climate, const Climate& climate,
                         Value&& value) {
  Grid<float> out(dem.width(), dem.height());
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x != dem.width(); ++x) {
      glm::dvec2 at(x, y);
      if (&dem != &of_climate) {
        const glm::dvec2 position = dem.transform.to_crs(x, y);
        at = of_climate.transform.to_cell(position.x, position.y);
      }
      out(x, y) = static_cast<float>(
          std::round(value(climate.at(at.x, at.y), static_cast<double>(dem.altitude_m(x, y))) *
                     parts) /
          parts);
    }
  });
  return out;
}

double year_c(const PlaceClimate& position, double altitude_m) {
  double sum = 0.0;
  for (const double month_c : monthly_c(position, altitude_m)) sum += month_c;
  return sum / 12.0;
}

// As for class rules, from the same posts.
Grid<float> treelines(const Dem& dem, const Dem& of_climate, const Climate& climate) {
  const RuleClimate lines = make_map_lines(of_climate, climate, {});
  const ClimateColumns columns = plan_climate_columns(lines, dem.transform, dem.width());
  Grid<float> out(dem.width(), dem.height());
  parallel_rows(dem.height(), [&](int y) {
    fill_climate_row(lines, columns, ClimateVariable::treeline, dem.transform, y,
                     dem.altitude_m.row(y), out.row(y));
  });
  return out;
}

Grid<float> to_share(const Grid<std::uint8_t>& mask) {
  Grid<float> out(mask.width(), mask.height());
  for (std::size_t i = 0; i < mask.size(); ++i) out[i] = mask[i] != 0 ? 1.F : 0.F;
  return out;
}

// A mask of a larger terrain at the cells of a window.
Grid<std::uint8_t> carried_over(const Grid<std::uint8_t>& mask, const GeoTransform& transform,
                                const Dem& window) {
  Grid<std::uint8_t> out(window.width(), window.height());
  parallel_rows(window.height(), [&](int y) {
    for (int x = 0; x < window.width(); ++x) {
      const glm::dvec2 position = window.transform.to_crs(x, y);
      const glm::dvec2 at = transform.to_cell(position.x, position.y);
      out(x, y) =
          mask.clamped(static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)));
    }
  });
  return out;
}

// A window uses its part of the whole's sea; the whole finds its own.
SeaParameters sea_of_whole(SeaParameters parameters) {
  parameters.known = nullptr;
  return parameters;
}

}  // namespace

LayerClimate LayerClimateGrids::view() const {
  const auto known = [](const Grid<float>& grid) { return grid.empty() ? nullptr : &grid; };
  return {known(temperature_c), known(rain_mm), known(radiation), known(sky_view),
          known(treeline_m),    known(lake),    known(sea)};
}

bool needs_climate(const std::vector<std::string>& names, const LayerClimateFiles& files) {
  const Computed is = computed(names, files);
  return is.temperature || is.rain || is.treeline;
}

bool needs_place(const std::vector<std::string>& names, const LayerClimateFiles& files) {
  const Computed is = computed(names, files);
  return is.temperature || is.rain || is.radiation || is.sky_view || is.treeline;
}

LayerClimateGrids make_layer_climate(const Dem& dem, const std::vector<std::string>& names,
                                     const LayerClimateFiles& files,
                                     std::optional<double> latitude_deg,
                                     const ClimateMaker& climate, Progress& progress,
                                     const Dem* whole, const SeaParameters& sea_parameters,
                                     const MonthShares& sunshine) {
  using enum LayerInputKind;
  LayerClimateGrids grids;
  const auto read = [&](LayerInputKind kind, const std::string& file, Grid<float>& grid) {
    if (!file.empty() && named(names, kind)) grid = read_grid(file, dem, progress);
  };
  read(temperature, files.temperature, grids.temperature_c);
  read(rain, files.rain, grids.rain_mm);
  read(radiation, files.radiation, grids.radiation);
  read(sky_view, files.sky_view, grids.sky_view);
  const Computed is = computed(names, files);
  if (is.temperature || is.rain || is.treeline) {
    const Climate here = climate();
    grids.sources = here.sources;
    const Dem& of_climate = whole != nullptr ? *whole : dem;
    if (is.temperature) grids.temperature_c = from_climate(dem, of_climate, here, year_c);
    if (is.treeline) grids.treeline_m = treelines(dem, of_climate, here);
    if (is.rain)
      grids.rain_mm =
          from_climate(dem, of_climate, here, [](const PlaceClimate& position, double altitude_m) {
            return rain_mm(position, altitude_m);
          });
  }
  if (is.radiation || is.sky_view) {
    Surrounded ground{gaussian_blur(dem.altitude_m, smoothing_m / dem.cell_m()), dem.transform};
    if (whole != nullptr)
      ground = surround(ground.altitude_m, dem.transform, *whole, shadow_reach_m);
    const MapPosition position =
        make_map_position(ground.transform, dem.crs, ground.altitude_m.width(),
                          ground.altitude_m.height(), latitude_deg);
    Radiation sun =
        potential_radiation(ground.altitude_m, position, {.sun = {.sunshine = sunshine}}, progress);
    if (whole != nullptr)
      for (Grid<float>* grid : {&sun.direct_mj_m2, &sun.sky_view})
        *grid = part_of(
            *grid, {ground.left, ground.top, ground.left + dem.width(), ground.top + dem.height()});
    if (is.radiation) grids.radiation = std::move(sun.direct_mj_m2);
    if (is.sky_view) grids.sky_view = std::move(sun.sky_view);
  }
  if (named(names, lake) || named(names, sea)) {
    const Sea found = find_sea(dem, sea_parameters);
    if (named(names, sea))
      grids.sea =
          found.empty() ? Grid<float>(dem.width(), dem.height(), 0.F) : to_share(found.mask);
    if (named(names, lake)) {
      Grid<std::uint8_t> known;
      if (whole != nullptr)
        known =
            carried_over(ground_lakes(*whole, {}, find_sea(*whole, sea_of_whole(sea_parameters))),
                         whole->transform, dem);
      grids.lake = to_share(ground_lakes(dem, {}, found, known));
    }
  }
  return grids;
}

}  // namespace belvedere
