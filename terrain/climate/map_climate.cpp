#include "terrain/climate/map_climate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/climate/water_balance.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/block_means.h"
#include "terrain/shape/valley_floor.h"

namespace belvedere {
namespace {

constexpr double open_gathering =
    1.3;  // factor on snowfall: open ground with hollows keeps this much in summer
constexpr double lowest_level_m = -500.0;
constexpr double highest_level_m = 9000.0;
constexpr double level_step_m = 500.0;

float round_to(double value, double part) {
  return static_cast<float>(std::round(value / part) * part);
}

// Grid of posts from the first cell of a map to its last, or beyond an only one: a distance between
// posts of 0 has no position.
struct Posts {
  int columns;
  int rows;
  double across;  // cells between posts
  double down;
};
Posts place_posts(const Dem& dem, glm::dvec2 cell_m, double apart_m, int max) {
  const auto along = [&](int cells, double cell) {
    return std::clamp(static_cast<int>(std::ceil(static_cast<double>(cells) * cell / apart_m)) + 1,
                      2, max);
  };
  Posts posts{along(dem.width(), cell_m.x), along(dem.height(), cell_m.y), 0.0, 0.0};
  posts.across = static_cast<double>(std::max(1, dem.width() - 1)) / (posts.columns - 1);
  posts.down = static_cast<double>(std::max(1, dem.height() - 1)) / (posts.rows - 1);
  return posts;
}
GeoTransform transform_of(const Posts& posts, GeoTransform cells) {
  GeoTransform transform = cells;
  transform.cell_x *= posts.across;
  transform.cell_y *= posts.down;
  transform.origin_x += 0.5 * (cells.cell_x - transform.cell_x);
  transform.origin_y -= 0.5 * (cells.cell_y - transform.cell_y);
  return transform;
}

// Means of blocks of cells: they resolve the ridges that throw shadows over kilometres and the
// slopes of 90 m that matter to plants and snow.
int block_of(const Dem& dem, const SunShareParameters& parameters) {
  return std::max(1, static_cast<int>(std::floor(parameters.cell_m / dem.cell_m() + 0.5)));
}

// On all cells of a terrain.
Grid<float> share_of_cells(const Grid<float>& coarse, const MapPosition& coarse_place,
                           const SunShareParameters& given, Progress& progress) {
  const int columns = coarse.width();
  const int rows = coarse.height();
  const RadiationParameters parameters{.azimuths = given.azimuths,
                                       .sun = {.sunshine = given.sunshine}};
  const Grid<float> direct =
      potential_radiation(coarse, coarse_place, parameters, progress).direct_mj_m2;
  // Level open ground at the rows' latitudes: maps of one column at three altitudes with a parabola
  // between them, because the air gets thinner with altitude.
  const auto [lowest, highest] = std::minmax_element(coarse.begin(), coarse.end());
  const float bottom = *lowest;
  const float half = std::max(1.F, 0.5F * (*highest - bottom));
  MapPosition column_place = coarse_place;
  column_place.width = 1;
  std::array<Grid<float>, 3> open;
  for (std::size_t k = 0; k < open.size(); ++k)
    open[k] = potential_radiation(Grid<float>(1, rows, bottom + half * static_cast<float>(k)),
                                  column_place, parameters)
                  .direct_mj_m2;

  Grid<float> coarse_share(columns, rows);
  parallel_rows(rows, [&](int y) {
    const float a = open[0](0, y);
    const float b = open[1](0, y);
    const float c = open[2](0, y);
    for (int x = 0; x < columns; ++x) {
      const float t = (coarse(x, y) - bottom) / half;
      const float level = a + t * (b - a) + 0.5F * t * (t - 1.F) * (a - 2.F * b + c);
      coarse_share(x, y) = std::min(2.F, direct(x, y) / level);
    }
  });
  return coarse_share;
}

}  // namespace

Grid<float> sun_share(const Dem& dem, const MapPosition& position, const SunShareParameters& given,
                      Progress& progress) {
  const int block = block_of(dem, given);
  const Grid<float> coarse = block_means(dem.altitude_m, block);
  MapPosition coarse_place = position;
  coarse_place.width = coarse.width();
  coarse_place.height = coarse.height();
  coarse_place.cell_m = position.cell_m * static_cast<double>(block);
  const double centre = 0.5 * (block - 1);
  for (MapPlane* plane :
       {&coarse_place.longitude_deg, &coarse_place.latitude_deg, &coarse_place.grid_north_deg})
    *plane = {plane->at(centre, centre), plane->per_column * block, plane->per_row * block};
  const Grid<float> coarse_share = share_of_cells(coarse, coarse_place, given, progress);
  Grid<float> share(dem.width(), dem.height());
  parallel_rows(dem.height(), [&](int y) {
    for (int x = 0; x < dem.width(); ++x)
      share(x, y) = sample_bilinear(coarse_share, (x - centre) / block, (y - centre) / block);
  });
  return share;
}

Grid<float> sun_share(const Dem& window, const Dem& whole, std::optional<double> latitude_deg,
                      const SunShareParameters& given, Progress& progress) {
  // Ground 2000 m higher beyond this distance hides five degrees of sky, a fiftieth of a year's
  // sun.
  constexpr double reach_m = 24000.0;
  const int block = block_of(window, given);
  const double centre = 0.5 * (block - 1);
  const GeoTransform& t = window.transform;
  const Surrounded coarse =
      surround(block_means(window.altitude_m, block),
               {t.origin_x, t.origin_y, block * t.cell_x, block * t.cell_y}, whole, reach_m);
  const MapPosition position =
      make_map_position(coarse.transform, window.crs, coarse.altitude_m.width(),
                        coarse.altitude_m.height(), latitude_deg);
  const Grid<float> coarse_share = share_of_cells(coarse.altitude_m, position, given, progress);
  Grid<float> share(window.width(), window.height());
  parallel_rows(window.height(), [&](int y) {
    for (int x = 0; x < window.width(); ++x)
      share(x, y) = sample_bilinear(coarse_share, (x - centre) / block + coarse.left,
                                    (y - centre) / block + coarse.top);
  });
  return share;
}

RuleClimate make_map_lines(const Dem& dem, const Climate& climate,
                           const MapClimateParameters& parameters) {
  RuleClimate out;
  const Posts lines = place_posts(dem, climate.position.cell_m, 10000.0, 12);
  out.line_posts = transform_of(lines, dem.transform);
  for (Grid<float>* line : {&out.treeline_m, &out.ice_line_m, &out.snow_line_m, &out.season_snow_m})
    *line = Grid<float>(lines.columns, lines.rows, no_season_snow_m);
  parallel_ranges(lines.columns * lines.rows, 1, [&](int begin, int end) {
    constexpr double part = 1.0 / 16.0;
    for (int post = begin; post != end; ++post) {
      const int x = post % lines.columns;
      const int y = post / lines.columns;
      const PlaceClimate here = climate.at(x * lines.across, y * lines.down);
      out.treeline_m(x, y) = round_to(treeline_m(here), part);
      out.ice_line_m(x, y) = round_to(snow_line_m(here), part);
      out.snow_line_m(x, y) =
          round_to(snow_line_m(here, {.gathering = open_gathering, .warmer_k = 0.0}), part);
      if (parameters.day_of_season)
        out.season_snow_m(x, y) =
            round_to(snow_line_of_day_m(here, *parameters.day_of_season), part);
    }
  });
  return out;
}

RuleClimate make_map_climate(const Dem& dem, const Climate& climate,
                             const MapClimateParameters& parameters) {
  RuleClimate out = make_map_lines(dem, climate, parameters);
  const Posts tables = place_posts(dem, climate.position.cell_m, 2000.0, 48);
  out.table_posts = transform_of(tables, dem.transform);
  out.lowest_m = lowest_level_m;
  out.step_m = level_step_m;
  const auto levels =
      static_cast<std::size_t>((highest_level_m - lowest_level_m) / level_step_m) + 1;
  for (auto* table : {&out.moisture, &out.temperature_c, &out.rain_mm})
    table->assign(levels, Grid<float>(tables.columns, tables.rows));
  parallel_ranges(tables.columns * tables.rows, 8, [&](int begin, int end) {
    constexpr double part = 1.0 / 65536.0;
    for (int post = begin; post != end; ++post) {
      const int x = post % tables.columns;
      const int y = post / tables.columns;
      const PlaceClimate here = climate.at(x * tables.across, y * tables.down);
      for (std::size_t k = 0; k < levels; ++k) {
        const double altitude_m = lowest_level_m + level_step_m * static_cast<double>(k);
        double year_c = 0.0;
        for (const double month_c : monthly_c(here, altitude_m)) year_c += month_c / 12.0;
        out.moisture[k](x, y) = round_to(plant_water_share(here, altitude_m), part);
        out.temperature_c[k](x, y) = round_to(year_c, part);
        out.rain_mm[k](x, y) = round_to(rain_mm(here, altitude_m), part);
      }
    }
  });
  return out;
}

}  // namespace belvedere
