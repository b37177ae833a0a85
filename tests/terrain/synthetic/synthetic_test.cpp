#include "terrain/synthetic/synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/shape/derivatives.h"
#include "terrain/synthetic/synthetic_erosion.h"
#include "terrain/synthetic/synthetic_valleys.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// As large as the default, with coarse cells: a main valley, side valleys and ranges.
SyntheticParameters quick() { return {.width = 300, .height = 320, .cell_m = 120.0}; }

const Dem& terrain() {
  static const Dem dem = make_synthetic_terrain(quick(), silent_progress());
  return dem;
}

template <class F>
void for_neighbours(const Grid<float>& z, int x, int y, F&& f) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if ((dx != 0 || dy != 0) && z.contains(x + dx, y + dy)) f(z.index(x + dx, y + dy));
}

// Sizes of level areas, found by a simple search for equal neighbours.
std::vector<std::size_t> level_areas(const Grid<float>& z, std::vector<std::uint8_t>& in_lake,
                                     std::size_t smallest) {
  std::vector<std::size_t> sizes;
  std::vector<std::uint8_t> seen(z.size(), 0);
  in_lake.assign(z.size(), 0);
  for (std::size_t start = 0; start < z.size(); ++start) {
    if (seen[start] != 0) continue;
    std::vector<std::size_t> area = {start};
    seen[start] = 1;
    for (std::size_t k = 0; k < area.size(); ++k)
      for_neighbours(z, static_cast<int>(area[k]) % z.width(),
                     static_cast<int>(area[k]) / z.width(), [&](std::size_t j) {
                       if (seen[j] != 0 || z[j] != z[start]) return;
                       seen[j] = 1;
                       area.push_back(j);
                     });
    if (area.size() < smallest) continue;
    sizes.push_back(area.size());
    for (const std::size_t i : area) in_lake[i] = 1;
  }
  return sizes;
}

TEST(SyntheticTerrain, EveryCellDrainsToTheRimOrALake) {
  const Grid<float>& z = terrain().altitude_m;
  std::vector<std::uint8_t> lake;
  level_areas(z, lake, 12);
  int pits = 0;
  for (int y = 1; y + 1 < z.height(); ++y)
    for (int x = 1; x + 1 < z.width(); ++x) {
      if (lake[z.index(x, y)] != 0) continue;
      bool falls = false;
      for_neighbours(z, x, y, [&](std::size_t j) { falls = falls || z[j] < z(x, y); });
      pits += falls ? 0 : 1;
    }
  EXPECT_EQ(pits, 0);
}

TEST(SyntheticTerrain, LakesExistAndAreLevelAndSmall) {
  std::vector<std::uint8_t> lake;
  const std::vector<std::size_t> sizes = level_areas(terrain().altitude_m, lake, 24);
  EXPECT_GE(sizes.size(), 2U);
  const std::size_t cells = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  EXPECT_LT(cells, terrain().altitude_m.size() / 25);
}

TEST(SyntheticTerrain, HasTheFormOfTheAlps) {
  const Dem& dem = terrain();
  const auto [low, high] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  EXPECT_FLOAT_EQ(*low, 500.F);
  EXPECT_LE(*high, 3400.F);
  EXPECT_GE(*high, 0.7F * 3400.F);
  const Grid<float> slope = slope_deg(dem.altitude_m, 120.0, 120.0);
  const auto share = [&](auto&& holds) {
    return static_cast<double>(std::count_if(slope.begin(), slope.end(), holds)) /
           static_cast<double>(slope.size());
  };
  // The Karwendel and the Inn valley: 8 % flatter than 5°, 24 % steeper than 35° at 30 m.
  const double flat = share([](float s) { return s < 5.F; });
  const double steep = share([](float s) { return s > 35.F; });
  EXPECT_GT(flat, 0.04);
  EXPECT_LT(flat, 0.25);
  EXPECT_GT(steep, 0.08);
  EXPECT_LT(steep, 0.45);
  EXPECT_LT(share([](float s) { return s > 65.F; }), 0.002);  // no needles
  // A main valley: a tenth of the map lies within 250 m of the lowest ground; and high ground for
  // ice.
  const auto within = [&](float from, float to) {
    return static_cast<double>(std::count_if(dem.altitude_m.begin(), dem.altitude_m.end(),
                                             [&](float z) { return z >= from && z < to; })) /
           static_cast<double>(dem.altitude_m.size());
  };
  EXPECT_GT(within(500.F, 750.F), 0.04);
  EXPECT_GT(within(2400.F, 3400.F), 0.02);
}

TEST(SyntheticTerrain, IsTheSameForAnyNumberOfThreadsAndDiffersBySeed) {
  SyntheticParameters p = quick();
  p.width = 100;
  p.height = 110;
  const Dem two = make_synthetic_terrain(p, silent_progress());
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(make_synthetic_terrain(p, silent_progress()).altitude_m, two.altitude_m);
  }
  p.seed = 2;
  EXPECT_NE(make_synthetic_terrain(p, silent_progress()).altitude_m, two.altitude_m);
}

TEST(SyntheticTerrain, SmallAndOddSizesWork) {
  for (const auto& [width, height, cell] : {std::tuple{16, 16, 30.0}, std::tuple{57, 33, 30.0},
                                            std::tuple{40, 90, 1000.0}, std::tuple{64, 64, 1.0}}) {
    const SyntheticParameters p{.width = width, .height = height, .cell_m = cell};
    const Dem dem = make_synthetic_terrain(p, silent_progress());
    ASSERT_EQ(dem.width(), width);
    ASSERT_EQ(dem.height(), height);
    EXPECT_TRUE(std::all_of(dem.altitude_m.begin(), dem.altitude_m.end(), [](float z) {
      return z >= 500.F && z <= 3400.F;
    })) << width;
    EXPECT_LT(*std::min_element(dem.altitude_m.begin(), dem.altitude_m.end()),
              *std::max_element(dem.altitude_m.begin(), dem.altitude_m.end()));
  }
}

TEST(SyntheticTerrain, RefusesNonsense) {
  const auto refused = [](auto&& change) {
    SyntheticParameters p = quick();
    change(p);
    try {
      make_synthetic_terrain(p, silent_progress());
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::usage);
      return e.where();
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refused([](auto& p) { p.width = 8; }), "synthetic.width");
  EXPECT_EQ(refused([](auto& p) { p.height = 20000; }), "synthetic.height");
  EXPECT_EQ(refused([](auto& p) { p.cell_m = std::nan(""); }), "synthetic.cell_m");
  EXPECT_EQ(refused([](auto& p) { p.highest_m = 400.0; }), "synthetic.highest_m");
}

TEST(RidgedNoise, KeepsItsRangeAtAnySize) {
  const SyntheticParameters p{.width = 333, .height = 100};
  const Dem dem = make_ridged_noise(p);
  const auto [low, high] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  EXPECT_GE(*low, 500.F);
  EXPECT_LE(*high, 3400.F);
  EXPECT_GT(*high - *low, 1000.F);
  const ThreadLimit limit(1);
  EXPECT_EQ(make_ridged_noise(p).altitude_m, dem.altitude_m);
}

Grid<float> random_ground(int width, int height, std::uint64_t seed) {
  return test::grid_of(width, height, [&](int x, int y) {
    return 100.F * static_cast<float>(random_uniform(seed, x, y));
  });
}

TEST(Drainage, CarriesAllWaterToTheOutletAndReceiversComeFirst) {
  Grid<float> z = random_ground(40, 30, 5);
  const std::vector<std::int32_t> outlets = {7};
  const synthetic::Drainage drainage = synthetic::find_drainage(z, outlets, 1);
  ASSERT_EQ(drainage.order.size(), z.size());
  std::vector<std::size_t> rank(z.size());
  for (std::size_t k = 0; k < drainage.order.size(); ++k)
    rank[static_cast<std::size_t>(drainage.order[k])] = k;
  for (std::size_t i = 0; i < z.size(); ++i) {
    const std::int32_t r = drainage.receiver[i];
    if (i == 7) {
      EXPECT_EQ(r, -1);
      continue;
    }
    ASSERT_GE(r, 0);
    EXPECT_LT(rank[static_cast<std::size_t>(r)], rank[i]);
    EXPECT_LE(z[static_cast<std::size_t>(r)], z[i]);
  }
  Grid<float> inflow(40, 30, 0.F);
  inflow(39, 29) = 5.F;
  EXPECT_NEAR(synthetic::catchments_km2(drainage, inflow, 100.0)[7], 40 * 30 * 0.01 + 5.0, 1e-3);
}

TEST(Erosion, SlopesDoNotPreferTheGridsDirections) {
  // Steady ground around a single outlet at the centre is a cone with the same slope all around.
  constexpr int size = 101;
  Grid<float> z = random_ground(size, size, 9);
  const std::int32_t centre = (size / 2) * size + size / 2;
  z[static_cast<std::size_t>(centre)] = 0.F;
  const Grid<float> uplift(size, size, 10.F);
  const Grid<float> softness(size, size, 1.F);
  synthetic::ErosionParameters p;
  p.hillslope_km2 = 10000.F;  // no catchment matters: every place is hillslope
  p.steepest = 100.F;
  const Grid<float> no_inflow(size, size, 0.F);
  for (int step = 0; step < 60; ++step) {
    const synthetic::Drainage drainage = synthetic::find_drainage(z, {centre}, 1);
    Grid<synthetic::ErosionCell> cells;
    synthetic::erode(z, drainage, synthetic::catchments_km2(drainage, no_inflow, 30.0), uplift,
                     softness, p, cells);
  }
  const auto height_at = [&](int dx, int dy) { return z(size / 2 + dx, size / 2 + dy); };
  const float straight = height_at(40, 0) / 40.F;
  const float diagonal = height_at(28, 28) / std::hypot(28.F, 28.F);
  const float between = height_at(37, 15) / std::hypot(37.F, 15.F);
  EXPECT_NEAR(straight, 10.F / (8.F * std::pow(10000.F, 0.6F)),
              0.1F * straight);  // U / (K A^m) a cell
  EXPECT_NEAR(diagonal / straight, 1.F, 0.06F);
  EXPECT_NEAR(between / straight, 1.F, 0.06F);
}

TEST(FillPits, LargeHollowsBecomeLevelLakesAndSmallOnesDrain) {
  Grid<float> z(30, 20);
  for (const auto [x, y] : test::cells(30, 20))
    z(x, y) = 100.F + static_cast<float>(x);  // falls to the west
  for (const auto [x, y] : test::cells({10, 5, 18, 11})) z(x, y) = 90.F - static_cast<float>(y);
  z(25, 5) = 80.F;
  const Grid<std::uint8_t> lake = synthetic::fill_pits(z, 20);
  EXPECT_EQ(std::count(lake.begin(), lake.end(), 1), 48);
  EXPECT_EQ(lake(12, 7), 1);
  for (const auto [x, y] : test::cells({10, 5, 18, 11})) EXPECT_EQ(z(x, y), z(10, 5));
  EXPECT_NEAR(z(10, 5), 109.F, 0.1F);  // the sill is its western shore
  EXPECT_EQ(lake(25, 5), 0);
  EXPECT_GT(z(25, 5), 124.F);
}

}  // namespace
}  // namespace belvedere
