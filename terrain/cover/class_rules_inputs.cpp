#include "terrain/cover/class_rules_inputs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>

#include "base/filter.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/rising_queue.h"
#include "terrain/cover/ground_lakes.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/shape/derivatives.h"
#include "terrain/shape/mask_pieces.h"

namespace belvedere::class_rules {
namespace {

template <class T, class F>
void each_cell(Grid<T>& grid, F&& f) {
  parallel_rows(grid.height(), [&](int y) {
    for (int x = 0; x < grid.width(); ++x) grid(x, y) = f(x, y);
  });
}

// Rise towards the east and towards the south, metres per metre.
glm::vec2 rise(const Grid<float>& z, int x, int y, double cell_x, double cell_y) {
  const double gx = static_cast<double>(z.clamped(x + 1, y) - z.clamped(x - 1, y)) / (2.0 * cell_x);
  const double gy = static_cast<double>(z.clamped(x, y + 1) - z.clamped(x, y - 1)) / (2.0 * cell_y);
  return {static_cast<float>(gx), static_cast<float>(gy)};
}

TownParameters to_town_parameters(const Parameters& parameters, const std::vector<KnownTown>& known,
                                  std::uint64_t seed) {
  TownParameters towns;
  towns.amount = parameter_or(parameters, "settlement", 0.0);
  towns.inferred = std::clamp(parameter_or(parameters, "inferred_villages", 0.0), 0.0, 1.0);
  towns.highest_m = parameter_or(parameters, "town_highest_m", 1300.0);
  towns.seed = seed;
  towns.known = known;
  return towns;
}

// Agricultural suitability of each cell, from its climate and the scene's dryness.
Grid<float> suitability_map(const Dem& dem, const Parameters& parameters,
                            const RuleClimate& climate) {
  const auto drier = static_cast<float>(0.3 * parameter_or(parameters, "dryness", 0.0));
  Grid<float> suitability(dem.width(), dem.height());
  parallel_rows(dem.height(), [&](int y) {
    std::vector<float> moisture(static_cast<std::size_t>(dem.width()));
    std::vector<float> temperature(moisture.size());
    const float* altitude_m = dem.altitude_m.row(y);
    fill_climate_row(climate, ClimateVariable::moisture, dem.transform, y, dem.width(), altitude_m,
                     moisture.data());
    fill_climate_row(climate, ClimateVariable::temperature, dem.transform, y, dem.width(),
                     altitude_m, temperature.data());
    for (int x = 0; x < dem.width(); ++x)
      suitability(x, y) = agricultural_suitability(moisture[static_cast<std::size_t>(x)] - drier,
                                                   temperature[static_cast<std::size_t>(x)]);
  });
  return suitability;
}

// 1 at sea, and the distance of land from it, m.
void make_sea_inputs(const Dem& dem, const Sea& found, const std::vector<bool>& needed,
                     std::vector<Grid<float>>& inputs) {
  if (needed[sea]) {
    inputs[sea] = Grid<float>(dem.width(), dem.height(), 0.F);
    if (!found.empty())
      each_cell(inputs[sea], [&](int x, int y) { return found.mask(x, y) != 0 ? 1.F : 0.F; });
  }
  if (needed[coast])
    inputs[coast] = found.empty() ? Grid<float>(dem.width(), dem.height(), 1e6F)
                                  : distance_to_marked_m(found.mask, dem.cell_m());
}

// The distance of each cell from streams that carry water all the year where it rains at all, m.
Grid<float> distance_from_streams_m(const Grid<float>& catchment_km2, double cell_m) {
  constexpr float min_catchment_km2 = 20.F;  // as of inferred rivers
  Grid<std::uint8_t> streams(catchment_km2.width(), catchment_km2.height());
  each_cell(streams, [&](int x, int y) {
    return static_cast<std::uint8_t>(catchment_km2(x, y) >= min_catchment_km2 ? 1 : 0);
  });
  return distance_to_marked_m(streams, cell_m);
}

// Lakes of the ground around a window, in the window's cells; empty if unknown.
Grid<std::uint8_t> known_lakes(const RuleGround* around, const Dem& dem) {
  if (around == nullptr || around->inputs[lake].empty()) return {};
  Grid<std::uint8_t> known(dem.width(), dem.height());
  each_cell(known, [&](int x, int y) {
    const glm::dvec2 position = dem.transform.to_crs(x, y);
    const glm::dvec2 at = around->transform.to_cell(position.x, position.y);
    return static_cast<std::uint8_t>(sample_bilinear(around->inputs[lake], at.x, at.y) > 0.5F ? 1
                                                                                              : 0);
  });
  return known;
}

// Grids that rules share with layers. Slopes and reliefs are made together, from shared blurs.
void make_layer_inputs(const Dem& dem, const Dem* whole, const std::vector<bool>& needed,
                       std::vector<Grid<float>>& inputs) {
  std::vector<std::string> names;
  std::vector<std::size_t> slots;
  for (const int v :
       {north, south, east, relief_4000, above_valley, log_catchment, flatness, roughness}) {
    const auto slot = static_cast<std::size_t>(v);
    if (!needed[slot]) continue;
    slots.push_back(slot);
    names.push_back(variable_names()[slot]);
  }
  if (names.empty()) return;
  std::vector<Grid<float>> made = layer_inputs(make_layer_ground(dem, {}, names, whole));
  for (std::size_t i = 0; i < slots.size(); ++i) inputs[slots[i]] = std::move(made[i]);
}

// The grids that depend only on the shape of the ground, not on its drainage.
void make_shape_inputs(const Dem& dem, const Sea& found, const std::vector<bool>& needed,
                       const Parameters& parameters, const RuleClimate& climate,
                       const RuleGround* around, std::vector<Grid<float>>& inputs,
                       Grid<float>& faces_south) {
  const double cell = dem.cell_m();
  const double cell_x = dem.transform.cell_x;
  const double cell_y = dem.transform.cell_y;
  const Grid<float>& z = dem.altitude_m;
  const auto is_needed = [&](int v) {
    return static_cast<bool>(needed[static_cast<std::size_t>(v)]);
  };
  const auto grid = [&](int v) -> Grid<float>& { return inputs[static_cast<std::size_t>(v)]; };

  if (is_needed(altitude)) grid(altitude) = z;
  const bool needs_floor = is_needed(valley_floor) || is_needed(town);
  if (is_needed(valley_height) || needs_floor)
    grid(valley_height) = height_above_valley(z, cell, 900.0);
  {
    const Grid<float> smooth = gaussian_blur(z, dem.blur_cells(slope_smooth_m));
    const bool needs_sun = is_needed(sun) && climate.sun.empty();
    if (is_needed(slope) || is_needed(slope_smooth) || needs_floor || needs_sun)
      grid(slope) = slope_deg(smooth, cell_x, cell_y);
    if (is_needed(slope_smooth)) grid(slope_smooth) = gaussian_blur(grid(slope), 90.0 / cell);
    if (is_needed(town) || needs_sun) {
      faces_south = Grid<float>(z.width(), z.height());
      each_cell(faces_south, [&](int x, int y) {
        // Ground that rises to the north (against the rows) faces south, even if it is nearly
        // level: settlements prefer any exposure to the south.
        const glm::vec2 g = rise(smooth, x, y, cell_x, cell_y);
        return -g.y / (std::sqrt(g.x * g.x + g.y * g.y) + 1e-3F);
      });
    }
    if (is_needed(sun)) {
      grid(sun) = climate.sun;
      // Approximately a year's sun at 47° N: a third more on a steep southern slope than on level
      // ground.
      if (needs_sun) {
        grid(sun) = Grid<float>(z.width(), z.height());
        each_cell(grid(sun), [&](int x, int y) {
          return 1.F + faces_south(x, y) * std::clamp(grid(slope)(x, y) / 25.F, 0.F, 1.F) / 2.6F;
        });
      }
    }
  }
  if (is_needed(relief_180) || is_needed(relief_750)) {
    const Grid<float> inner = gaussian_blur(z, dem.blur_cells(30.0));
    for (const auto& [variable, outer_m] :
         {std::pair{relief_180, 180.0}, std::pair{relief_750, 750.0}}) {
      if (!is_needed(variable)) continue;
      grid(variable) = gaussian_blur(z, dem.blur_cells(outer_m));
      each_cell(grid(variable),
                [&, v = variable](int x, int y) { return inner(x, y) - grid(v)(x, y); });
    }
  }
  if (is_needed(relief_1800))
    grid(relief_1800) = relief(z, 1.0, dem.blur_cells(120.0), dem.blur_cells(1800.0));
  if (needs_floor) {
    const auto steepest = static_cast<float>(parameter_or(parameters, "floor_slope_deg", 5.5));
    const auto highest = static_cast<float>(parameter_or(parameters, "floor_highest_m", 1450.0));
    const auto rise_m = static_cast<float>(parameter_or(parameters, "floor_height_m", 70.0));
    Grid<float> flat(z.width(), z.height());
    each_cell(flat, [&](int x, int y) {
      if (!found.empty() && found.mask(x, y) != 0) return 0.F;
      return grid(slope)(x, y) < steepest && grid(valley_height)(x, y) < rise_m && z(x, y) < highest
                 ? 1.F
                 : 0.F;
    });
    grid(valley_floor) = gaussian_blur(flat, 60.0 / cell);
  }
  if (is_needed(lake) || is_needed(shore)) {
    LakeParameters lakes;
    lakes.max_range_m = static_cast<float>(parameter_or(parameters, "lake_range_m", 0.25));
    lakes.min_cells = static_cast<int>(parameter_or(parameters, "lake_min_cells", 150.0));
    const Grid<std::uint8_t> mask = ground_lakes(dem, lakes, found, known_lakes(around, dem));
    grid(lake) = Grid<float>(z.width(), z.height());
    each_cell(grid(lake), [&](int x, int y) { return mask(x, y) != 0 ? 1.F : 0.F; });
    if (is_needed(shore)) {
      Grid<std::uint8_t> land(z.width(), z.height());
      each_cell(land,
                [&](int x, int y) { return static_cast<std::uint8_t>(mask(x, y) != 0 ? 0 : 1); });
      grid(shore) = distance_to_marked_m(land, cell);
    }
  }
}

}  // namespace

const std::vector<std::string>& variable_names() {
  static const std::vector<std::string> names = expression_names(KnownTo::rules);
  return names;
}

double parameter_or(const Parameters& parameters, const std::string& name, double otherwise) {
  for (const auto& [key, value] : parameters)
    if (key == name) return value;
  return otherwise;
}

void resolve_altitudes(Parameters& parameters, const RuleClimate& climate, const Dem& dem) {
  struct Below {
    const char* parameter;
    double treeline_m;
  };
  constexpr std::array<Below, 2> open = {{{"town_highest_m", 520.0}, {"floor_highest_m", 370.0}}};
  double line = parameter_or(parameters, "treeline_m", 0.0);
  if (line <= 0.0) {
    std::vector<float> row(static_cast<std::size_t>(dem.width()));
    const int centre = dem.height() / 2;
    fill_climate_row(climate, ClimateVariable::treeline, dem.transform, centre, dem.width(),
                     dem.altitude_m.row(centre), row.data());
    line = row[static_cast<std::size_t>(dem.width() / 2)];
  }
  for (auto& [name, value] : parameters)
    for (const Below& below : open)
      if (name == below.parameter && value == 0.0) value = line - below.treeline_m;
}

std::vector<Grid<float>> make_terrain_inputs(const Dem& dem, const std::vector<bool>& needed,
                                             const Parameters& parameters,
                                             const SettlementInputs& settlement_inputs,
                                             const SeaParameters& sea_parameters,
                                             const RuleClimate& climate, Catchments* catchments,
                                             std::vector<TownSite>* settlements,
                                             const RuleGround* around, const Dem* whole) {
  const Grid<float>& z = dem.altitude_m;
  std::vector<Grid<float>> inputs(first_noise);
  const bool needs_town = needed[town];
  // Only for rules that refer to the sea.
  const Sea found = needed[sea] || needed[coast] ? find_sea(dem, sea_parameters) : Sea();
  make_sea_inputs(dem, found, needed, inputs);
  make_layer_inputs(dem, whole, needed, inputs);
  Grid<float> faces_south;
  Catchments own(dem);
  Catchments& waters = catchments != nullptr ? *catchments : own;
  // Drainage is sequential and runs on one thread; the rest is computed meanwhile.
  parallel_ranges(2, 1, [&](int begin, int end) {
    for (int part = begin; part != end; ++part) {
      if (part == 1)
        make_shape_inputs(dem, found, needed, parameters, climate, around, inputs, faces_south);
      else if (needed[river] || needed[riverside] || needs_town)
        waters.km2();
    }
  });
  if (needed[riverside]) inputs[riverside] = distance_from_streams_m(waters.km2(), dem.cell_m());
  if (needed[river]) inputs[river] = river_mask(waters.km2(), dem.cell_m());
  if (needs_town) {
    const bool inferred =
        settlement_inputs.sites == nullptr && parameter_or(parameters, "settlement", 0.0) > -1.0;
    const Grid<float> suitability =
        inferred ? suitability_map(dem, parameters, climate) : Grid<float>();
    const TownGround ground{z,
                            inputs[valley_floor],
                            waters.km2(),
                            inputs[slope],
                            faces_south,
                            dem.transform,
                            inferred ? &suitability : nullptr};
    const std::vector<TownSite> sites =
        settlement_inputs.sites != nullptr
            ? *settlement_inputs.sites
            : find_town_sites(ground, to_town_parameters(parameters, settlement_inputs.known,
                                                         settlement_inputs.seed));
    inputs[town] = town_field(sites, ground);
    if (settlements != nullptr) *settlements = sites;
  }
  return inputs;
}

Grid<float> rock_above(const Grid<LandCoverClass>& classes, const Dem& dem, double reach_m) {
  const int width = classes.width();
  const int height = classes.height();
  const int steps = static_cast<int>(reach_m / dem.cell_m());
  Grid<float> above(width, height);
  each_cell(above, [&](int x, int y) { return classes(x, y) == LandCoverClass::rock ? 1.F : 0.F; });
  if (steps < 1) return above;
  const Grid<float> near =
      window_maximum(above, steps + 1);  // most of a map has no rock near and can be skipped

  // Unit vectors uphill, one cell long; 0 on flat ground.
  const Grid<float> smooth = gaussian_blur(dem.altitude_m, dem.blur_cells(60.0));
  Grid<glm::vec2> uphill(width, height);
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const glm::vec2 g = rise(smooth, x, y, dem.transform.cell_x, dem.transform.cell_y);
      const float length = std::sqrt(g.x * g.x + g.y * g.y);
      uphill(x, y) = length < 0.02F ? glm::vec2(0.F) : g / length;
    }
  });
  each_cell(above, [&](int x, int y) {
    if (near(x, y) == 0.F || classes(x, y) == LandCoverClass::rock) return near(x, y);
    // Half a cell is added, so that truncation rounds to the nearest cell.
    glm::vec2 position(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    glm::vec2 direction = uphill(x, y);
    for (int k = 0; k < steps; ++k) {
      if (direction == glm::vec2(0.F)) return 0.F;
      position += direction;
      if (position.x < 0.F || position.y < 0.F) return 0.F;
      const int ux = static_cast<int>(position.x);
      const int uy = static_cast<int>(position.y);
      if (!classes.contains(ux, uy)) return 0.F;
      if (classes(ux, uy) == LandCoverClass::rock)
        return 1.F - static_cast<float>(k) / static_cast<float>(steps);
      direction = uphill(ux, uy);
    }
    return 0.F;
  });
  return above;
}

void remove_specks(Grid<LandCoverClass>& classes, int window) {
  const int radius = window / 2;
  if (radius < 1) return;
  const int window_size = 2 * radius + 1;
  const int majority = (window_size * window_size + 1) / 2;
  const int width = classes.width();
  const int height = classes.height();
  const auto holds_on = [](LandCoverClass id) {
    return id == LandCoverClass::water || id == LandCoverClass::settlement;
  };
  Grid<std::uint8_t> keeps(width, height);
  parallel_ranges(height, 16, [&](int y0, int y1) {
    // Rows with replicated ends, and the number of cells in the window that equal its centre.
    const int padded = width + 2 * radius;
    std::vector<std::vector<LandCoverClass>> window_rows(static_cast<std::size_t>(window_size),
                                                         std::vector<LandCoverClass>(padded));
    std::vector<std::uint16_t> same(static_cast<std::size_t>(width));
    const auto row_of = [&](int y) -> std::vector<LandCoverClass>& {
      return window_rows[static_cast<std::size_t>((y + window_size) % window_size)];
    };
    const auto load = [&](int y) {
      const LandCoverClass* from = classes.row(std::clamp(y, 0, height - 1));
      std::vector<LandCoverClass>& to = row_of(y);
      std::fill_n(to.begin(), radius, from[0]);
      std::copy_n(from, width, to.begin() + radius);
      std::fill_n(to.begin() + radius + width, radius, from[width - 1]);
    };
    for (int y = y0 - radius; y < y0 + radius; ++y) load(y);
    for (int y = y0; y != y1; ++y) {
      load(y + radius);
      const LandCoverClass* own = classes.row(y);
      std::fill(same.begin(), same.end(), std::uint16_t{0});
      for (int dy = -radius; dy <= radius; ++dy) {
        const LandCoverClass* line = row_of(y + dy).data();
        for (int dx = 0; dx <= 2 * radius; ++dx)
          for (int x = 0; x < width; ++x)
            same[static_cast<std::size_t>(x)] += line[x + dx] == own[x] ? 1 : 0;
      }
      for (int x = 0; x < width; ++x)
        keeps(x, y) = own[x] != LandCoverClass::sky &&
                              (same[static_cast<std::size_t>(x)] >= majority || holds_on(own[x]))
                          ? 1
                          : 0;
    }
  });

  // Water and settlement keep their cells but do not spread into holes. The nearest source cell is
  // almost always a few cells away, so offsets are tried in the order of their distance, ties in
  // the order of the grid.
  struct Offset {
    int x;
    int y;
  };
  constexpr int near = 12;
  std::vector<Offset> offsets;
  for (int y = -near; y <= near; ++y)
    for (int x = -near; x <= near; ++x)
      if (x * x + y * y <= near * near) offsets.push_back({x, y});
  std::stable_sort(offsets.begin(), offsets.end(), [](Offset a, Offset b) {
    return a.x * a.x + a.y * a.y < b.x * b.x + b.y * b.y;
  });
  const Grid<LandCoverClass> before = classes;
  const auto gives = [&](int x, int y) { return keeps(x, y) != 0 && !holds_on(before(x, y)); };
  std::vector<std::vector<int>> far(
      static_cast<std::size_t>(height));  // cells without a source, by rows
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (keeps(x, y) != 0) continue;
      const auto found = std::find_if(offsets.begin(), offsets.end(), [&](Offset o) {
        return keeps.contains(x + o.x, y + o.y) && gives(x + o.x, y + o.y);
      });
      if (found != offsets.end())
        classes(x, y) = before(x + found->x, y + found->y);
      else
        far[static_cast<std::size_t>(y)].push_back(x);
    }
  });
  if (std::all_of(far.begin(), far.end(), [](const std::vector<int>& row) { return row.empty(); }))
    return;
  Grid<std::uint8_t> giving(width, height);
  each_cell(giving, [&](int x, int y) { return static_cast<std::uint8_t>(gives(x, y) ? 1 : 0); });
  const Grid<std::int32_t> nearest = nearest_marked(giving);
  for (int y = 0; y < height; ++y)
    for (const int x : far[static_cast<std::size_t>(y)])
      if (nearest(x, y) >= 0) classes(x, y) = before[static_cast<std::size_t>(nearest(x, y))];
}

}  // namespace belvedere::class_rules
