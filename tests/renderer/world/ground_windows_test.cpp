#include "renderer/world/ground_windows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/filter.h"
#include "base/memory_limit.h"
#include "base/parallel.h"
#include "renderer/trace/guidance.h"
#include "renderer/world/world.h"
#include "terrain/cover/map_cover.h"
#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::Notes;

// Synthetic mountains of 27 × 27 km in a file, seen from their southern edge. Values that would be
// derived from the region are written, so that whole and windows are the same view.
constexpr const char* few_cells = "terrain.max_mcells=0.6";

class GroundWindows : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::Folder;
    const Dem dem = make_synthetic_terrain(
        {.width = 900, .height = 900, .cell_m = 30, .lowest_m = 500, .highest_m = 3000, .seed = 5},
        silent_progress());
    GeoTransform transform = dem.transform;
    transform.origin_x = 600000;
    transform.origin_y = 5227000;
    write_raster(*folder_ / "terrain.tif",
                 Raster<float>{dem.altitude_m, transform, normalize_crs("EPSG:32632")});
  }
  static void TearDownTestSuite() {
    whole_.reset();
    parts_.reset();
    delete folder_;
    folder_ = nullptr;
  }

  static LoadedScene scene(const std::vector<std::string>& settings = {}) {
    constexpr const char* text = R"(version = 1
[[terrain.sources]]
file = "terrain.tif"
[camera]
position = [613500, 5200800]
height_m = 3600
azimuth_deg = 0
pitch_deg = -12
[generalize]
foreground = [1.1, 1.1, 1.0, 0.9, 0.9, 0.8]
background = [1.2, 1.1, 1.0, 0.7, 0.5, 0.3]
foreground_to_m = 6000
background_from_m = 20000
crest = 0.5
[deform]
exaggeration = 1.4
[deform.bend]
radius_m = 0
[sun]
azimuth_deg = 315
altitude_deg = 30
[air]
from_m = 34000
scale_m = 62000
rim_fade_m = 4000
[sampling]
pixel_samples = 1
shadow_rays = 2
sky_directions = 4
[output]
width = 320
height = 200
sheet_width_mm = 160
)";
    return parse_scene(text, "big.toml", *folder_ / "",
                       {.data_folders = {*folder_ / ""}, .settings = settings});
  }
  // The ground in one grid and in windows, each made once.
  static const World& in_one() { return made(whole_, {}); }
  static const World& in_windows() { return made(parts_, {few_cells}); }
  static GuidanceBuffers guidance_of(const World& world) {
    const GuidanceParameters parameters{.sampling = world.scene.sampling,
                                        .sun_direction = world.view.sun_direction};
    return trace_guidance(world.terrain, *world.surface, world.tracer, *world.camera, parameters,
                          {0, 0, 320, 200}, silent_progress());
  }

  static test::Folder* folder_;

 private:
  static const World& made(std::unique_ptr<World>& world,
                           const std::vector<std::string>& settings) {
    if (world == nullptr)
      world = std::unique_ptr<World>(new World(make_world(scene(settings), silent_progress())));
    return *world;
  }
  static inline std::unique_ptr<World> whole_, parts_;
};
test::Folder* GroundWindows::folder_ = nullptr;

// Inferred rivers of a window run where those of the same cells run in the whole, not where coarser
// cells have their valley.
TEST_F(GroundWindows, RiversLieInTheValleysOfTheirOwnCells) {
  const World& whole = in_one();
  const World& parts = in_windows();
  ASSERT_EQ(parts.terrain.windows.size(), 2U);
  const auto mean_apart_m = [&](const TerrainModel& ground, const Dem& dem, const PixelRect& part) {
    double sum = 0.0;
    int count = 0;
    if (ground.land_cover->inferred == nullptr) return std::pair(sum, count);
    for (const CoverRiver& river : whole.land_cover->inferred->centrelines())
      for (std::size_t i = 0; i < river.positions.size(); ++i) {
        const glm::dvec2 at = dem.transform.to_cell(river.positions[i].x, river.positions[i].y);
        const bool inside = at.x > part.x0 + 40 && at.y > part.y0 + 40 && at.x < part.x1 - 40 &&
                            at.y < part.y1 - 40;
        if (!inside || river.half_width_m[i] < 8.F) continue;
        double nearest = 1e9;
        for (const CoverRiver& other : ground.land_cover->inferred->centrelines())
          for (const glm::dvec2 position : other.positions)
            nearest = std::min(nearest, glm::distance(position, river.positions[i]));
        sum += nearest;
        ++count;
      }
    return std::pair(sum / std::max(count, 1), count);
  };
  const TerrainWindow& finest = parts.terrain.windows.back();
  const auto [own, positions] = mean_apart_m(finest.ground, *finest.ground.dem, finest.part);
  EXPECT_GT(positions, 30);
  EXPECT_LT(own, 15.0) << "half a cell";
  const auto [coarse, same_places] = mean_apart_m(parts.terrain, *finest.ground.dem, finest.part);
  EXPECT_GT(coarse, 2.0 * own)
      << "the whole's coarser cells know no better, or this test needs no windows";
}

bool is_sky(const GuidanceBuffers& seen, int x, int y) {
  return !std::isfinite(seen.depth_m(x, y));
}

TEST_F(GroundWindows, ShowWhatTheWholeShows) {
  Notes notes;
  const World& whole = in_one();
  const World parts = make_world(scene({few_cells}), notes);
  ASSERT_TRUE(whole.terrain.windows.empty());
  ASSERT_EQ(parts.terrain.windows.size(), 2U) << notes.text();
  EXPECT_EQ(parts.dem->halved, 2);
  EXPECT_NE(notes.text().find("30 m to"), std::string::npos) << notes.text();
  const GuidanceBuffers a = guidance_of(whole);
  const GuidanceBuffers b = guidance_of(parts);

  std::array<int, 3> pixels{};  // by the grid that was hit
  std::vector<double> altitude, depth, slope;
  int same_class = 0;
  int ground = 0;
  int skies_apart = 0;
  for (const auto [x, y] : test::cells(320, 200)) {
    if (is_sky(a, x, y) != is_sky(b, x, y)) ++skies_apart;
    if (is_sky(a, x, y) || is_sky(b, x, y)) continue;
    const Ray ray = parts.camera->ray({x + 0.5, y + 0.5});
    Hit hit;
    parts.tracer.intersect({&ray, 1}, {&hit, 1});
    ++pixels[static_cast<std::size_t>(hit.window)];
    // Behind an edge each may see another slope: only identical positions are compared.
    const double apart = std::abs(a.depth_m(x, y) - b.depth_m(x, y)) / a.depth_m(x, y);
    ++ground;
    depth.push_back(apart);
    if (apart > 0.02) continue;
    altitude.push_back(std::abs(a.altitude_m(x, y) - b.altitude_m(x, y)));
    slope.push_back(std::abs(a.slope_deg(x, y) - b.slope_deg(x, y)));
    same_class += a.land_cover(x, y) == b.land_cover(x, y) ? 1 : 0;
  }
  EXPECT_GT(pixels[2], 5000) << "the finest window is in the picture";
  EXPECT_GT(pixels[1], 1000);
  const auto part = [](std::vector<double> values, double share) {
    const auto at = values.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  RecordProperty("altitude_median_m", std::to_string(part(altitude, 0.5)));
  EXPECT_LE(skies_apart, 64000 / 200) << "skylines move by parts of a pixel";
  EXPECT_LT(part(depth, 0.5), 1e-3);
  EXPECT_LT(part(depth, 0.95), 0.01);
  EXPECT_LT(part(altitude, 0.5), 1.5);
  EXPECT_LT(part(altitude, 0.95), 15.0);
  EXPECT_LT(part(slope, 0.5), 1.0);
  EXPECT_GT(same_class, 0.9 * static_cast<double>(altitude.size()));
}

TEST_F(GroundWindows, NoCracksLetTheSkyThrough) {
  const World& parts = in_windows();
  const GuidanceBuffers seen = guidance_of(parts);
  for (int y = 1; y + 1 < 200; ++y)
    for (int x = 1; x + 1 < 320; ++x)
      EXPECT_TRUE(!is_sky(seen, x, y) || is_sky(seen, x, y - 1) || is_sky(seen, x - 1, y) ||
                  is_sky(seen, x + 1, y))
          << x << ' ' << y;
  // At vertices that only the finer side of a joint has, rays aim between that vertex and the
  // coarser side's edge: from either side they must hit ground there, and not continue below it.
  int aimed = 0;
  for (const TerrainWindow& window : parts.terrain.windows) {
    const Dem& dem = *window.ground.dem;
    const auto height = [&](int x, int y) {
      return parts.deformation
          .point(
              {dem.transform.to_crs(x, y), static_cast<double>(window.ground.generalized_m(x, y))})
          .z;
    };
    const double cell = dem.cell_m();
    for (const int y : {window.part.y0, window.part.y1 - 1})
      for (int x = window.part.x0 + 1; x < window.part.x1 - 1; x += 2) {
        const double edge = 0.5 * (height(x - 1, y) + height(x + 1, y));
        const double gap = std::abs(height(x, y) - edge);
        const bool level = std::abs(height(x, y + 1) - height(x, y - 1)) < 0.4 * cell &&
                           std::abs(height(x + 1, y) - height(x - 1, y)) < 0.4 * cell;
        if (gap < 0.5 || gap > 0.15 * cell || !level) continue;
        const glm::dvec3 aim(dem.transform.to_crs(x, y), 0.5 * (height(x, y) + edge));
        for (const double side : {-1.0, 1.0}) {
          const glm::dvec3 step(0.0, side * 0.4 * cell, 0.4 * cell);
          const Ray ray{aim + step, -glm::normalize(step)};
          Hit hit;
          parts.tracer.intersect({&ray, 1}, {&hit, 1});
          EXPECT_TRUE(hit.found && hit.distance_m < 2.0 * glm::length(step))
              << x << ' ' << y << ", gap " << gap;
          ++aimed;
        }
      }
  }
  EXPECT_GT(aimed, 20);
}

TEST_F(GroundWindows, MeetTheGroundAroundThemInAllTheyKnow) {
  const World& parts = in_windows();
  const TerrainModel* coarser = &parts.terrain;
  for (const TerrainWindow& window : parts.terrain.windows) {
    const auto expect_joined = [&](const Grid<float>& fine, const Grid<float>& coarse,
                                   const char* what) {
      for (int x = 0; x < window.part.width(); x += 2)
        for (const int y : {0, window.part.height() - 1})
          EXPECT_EQ(fine(window.part.x0 + x, window.part.y0 + y),
                    coarse(window.replaces.x0 + x / 2, window.replaces.y0 + y / 2))
              << what;
    };
    expect_joined(window.ground.generalized_m, coarser->generalized_m, "generalized");
    expect_joined(window.ground.dem->altitude_m, coarser->dem->altitude_m, "altitude");
    expect_joined(window.ground.flow, coarser->flow, "flow");
    expect_joined(window.ground.relief_l_m, coarser->relief_l_m, "relief");
    coarser = &window.ground;
  }
}

TEST_F(GroundWindows, SameBitsForAnyThreads) {
  const auto seen = [&](int threads) {
    const ThreadLimit limit(threads);
    return guidance_of(make_world(scene({few_cells}), silent_progress()));
  };
  const GuidanceBuffers one = seen(1);
  const GuidanceBuffers two = seen(2);
  EXPECT_EQ(one.depth_m, two.depth_m);
  EXPECT_EQ(one.normal, two.normal);
  EXPECT_EQ(one.land_cover, two.land_cover);
  EXPECT_EQ(one.flow, two.flow);
}

TEST_F(GroundWindows, RiversAreAsLargeAsTheWholeKnowsThem) {
  const World& whole = in_one();
  const World& parts = in_windows();
  const TerrainWindow& finest = parts.terrain.windows.back();
  const auto largest = [](const Grid<float>& flow, const PixelRect& rect) {
    float max = 0.F;
    for (const auto [x, y] : test::cells(rect)) max = std::max(max, flow(x, y));
    return max;
  };
  const glm::dvec2 first = finest.ground.dem->transform.to_crs(finest.part.x0, finest.part.y0);
  const glm::ivec2 at(glm::round(whole.dem->transform.to_cell(first.x, first.y)));
  const float of_whole = largest(
      whole.terrain.flow, {at.x, at.y, at.x + finest.part.width(), at.y + finest.part.height()});
  // A logarithm; within a factor of two, as coarse cells draw divides elsewhere, and a river along
  // the halo's edge may count twice.
  EXPECT_NEAR(largest(finest.ground.flow, finest.part), of_whole, 0.3);
}

TEST_F(GroundWindows, ADemThatFitsStaysWhole) {
  const World plenty = make_world(scene({"terrain.max_mcells=1"}), silent_progress());
  EXPECT_TRUE(plenty.terrain.windows.empty());
  EXPECT_EQ(plenty.terrain.generalized_m,
            make_world(scene(), silent_progress()).terrain.generalized_m);
}

// The same mountains sunk until the sea reaches far into them.
class GroundWindowsByTheSea : public GroundWindows {
 protected:
  static void SetUpTestSuite() {
    GroundWindows::SetUpTestSuite();
    RasterSource source;
    source.path = *folder_ / "terrain.tif";
    Raster<float> raster = read_raster(source);
    std::vector<float> sorted(raster.cells.begin(), raster.cells.end());
    const auto fourth = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 4);
    std::nth_element(sorted.begin(), fourth, sorted.end());
    for (float& z : raster.cells) z = std::max(0.F, z - *fourth);
    write_raster(*folder_ / "terrain.tif", raster);
  }
};

// Shares of the finest window's cells, in a frame of so many around its part's edge and inside of
// it, that have the class of the coarser ground below.
struct Agreement {
  double at_edge = 0.0;
  double inside = 0.0;
};
Agreement agreement_of(const World& parts, std::size_t index) {
  const TerrainWindow& window = parts.terrain.windows[index];
  const LandCover& fine = *window.ground.land_cover;
  const TerrainModel& before = index == 0 ? parts.terrain : parts.terrain.windows[index - 1].ground;
  const LandCover& coarser = *before.land_cover;
  const auto class_at = [](const LandCover& cover, glm::dvec2 position) {
    const glm::ivec2 at(glm::round(cover.classes.transform.to_cell(position.x, position.y)));
    return cover.classes.cells.clamped(at.x, at.y);
  };
  std::array<double, 2> same{};
  std::array<double, 2> all{};
  for (const auto [x, y] : test::cells(window.part.width(), window.part.height())) {
    const int from_edge =
        std::min({x, y, window.part.width() - 1 - x, window.part.height() - 1 - y});
    const std::size_t where = from_edge < 6 ? 0 : 1;
    const glm::dvec2 position =
        window.ground.dem->transform.to_crs(window.part.x0 + x, window.part.y0 + y);
    same[where] += class_at(fine, position) == class_at(coarser, position) ? 1.0 : 0.0;
    all[where] += 1.0;
  }
  return {same[0] / all[0], same[1] / all[1]};
}

TEST_F(GroundWindowsByTheSea, HaveTheWholesSeaAndClimate) {
  Notes notes;
  const World whole = make_world(scene(), notes);
  const World& parts = in_windows();
  EXPECT_NE(notes.text().find("sea: "), std::string::npos) << notes.text();
  const GuidanceBuffers a = guidance_of(whole);
  const GuidanceBuffers b = guidance_of(parts);
  int ground = 0;
  int same = 0;
  for (const auto [x, y] : test::cells(320, 200)) {
    if (is_sky(a, x, y) || is_sky(b, x, y) ||
        std::abs(a.depth_m(x, y) - b.depth_m(x, y)) > 0.02 * a.depth_m(x, y))
      continue;
    ++ground;
    same += a.land_cover(x, y) == b.land_cover(x, y) ? 1 : 0;
  }
  EXPECT_GE(same, 0.9 * ground);
  for (std::size_t i = 0; i < parts.terrain.windows.size(); ++i) {
    const Agreement agreement = agreement_of(parts, i);
    EXPECT_GT(agreement.at_edge, agreement.inside - 0.05)
        << "window " << i << ": a line would be seen at its joint";
    // Water at the sea's level is sea in the whole's cells and in the window's.
    const TerrainModel& ground_i = parts.terrain.windows[i].ground;
    int sea = 0;
    int wet = 0;
    for (const auto [x, y] : test::cells(*ground_i.dem)) {
      if (ground_i.dem->altitude_m(x, y) != 0.F) continue;
      ++sea;
      wet += ground_i.land_cover->classes.cells(x, y) == LandCoverClass::water ? 1 : 0;
    }
    EXPECT_GT(sea, 1000);
    EXPECT_GT(wet, 0.98 * sea);
  }
}

bool is_icy(LandCoverClass id) {
  return id == LandCoverClass::glacier || id == LandCoverClass::snow;
}

// The whole's class at a cell of a window.
LandCoverClass class_of(const World& whole, const TerrainWindow& window, int x, int y) {
  const Raster<LandCoverClass>& classes = whole.land_cover->classes;
  const glm::dvec2 position = window.ground.dem->transform.to_crs(x, y);
  const glm::ivec2 at(glm::round(classes.transform.to_cell(position.x, position.y)));
  return classes.cells.clamped(at.x, at.y);
}

TEST_F(GroundWindows, IceGoesOnAcrossJoints) {
  // Specks are removed on each side separately, in its own cells.
  const std::vector<std::string> settings = {"land_cover.settings.ice_line_m=1700",
                                             "land_cover.settings.snowline_m=2400",
                                             "land_cover.settings.speck_cells=0"};
  std::vector<std::string> with_few = settings;
  with_few.emplace_back(few_cells);
  const World whole = make_world(scene(settings), silent_progress());
  const World parts = make_world(scene(with_few), silent_progress());
  ASSERT_EQ(parts.terrain.windows.size(), 2U);
  const TerrainModel* coarser = &parts.terrain;
  for (std::size_t i = 0; i < 2; ++i) {
    const TerrainWindow& window = parts.terrain.windows[i];
    const Grid<LandCoverClass>& fine = window.ground.land_cover->classes.cells;
    const Grid<LandCoverClass>& coarse = coarser->land_cover->classes.cells;
    ASSERT_TRUE(fine.same_size(window.ground.dem->altitude_m));
    // At the posts that both sides of the joint have.
    int posts = 0, same = 0, icy = 0, same_ice = 0;
    const auto compare = [&](int x, int y) {
      const LandCoverClass here = fine(window.part.x0 + x, window.part.y0 + y);
      const LandCoverClass there = coarse(window.replaces.x0 + x / 2, window.replaces.y0 + y / 2);
      ++posts;
      same += here == there ? 1 : 0;
      icy += is_icy(here) || is_icy(there) ? 1 : 0;
      same_ice += is_icy(here) && is_icy(there) ? 1 : 0;
    };
    for (int x = 0; x < window.part.width(); x += 2)
      compare(x, 0), compare(x, window.part.height() - 1);
    for (int y = 0; y < window.part.height(); y += 2)
      compare(0, y), compare(window.part.width() - 1, y);
    EXPECT_GT(icy, posts / 20);
    EXPECT_GT(same, 0.98 * posts) << "window " << i;
    EXPECT_GT(same_ice, 0.95 * icy) << "window " << i;
    // And farther in, where the window's own cells apply, ice is where the whole has it: within the
    // accuracy of cells of twice the width.
    double both = 0.0, either = 0.0;
    for (const auto [x, y] : test::cells({window.part.x0 + 32, window.part.y0 + 32,
                                          window.part.x1 - 32, window.part.y1 - 32})) {
      const bool here = is_icy(fine(x, y));
      const bool there = is_icy(class_of(whole, window, x, y));
      both += here && there ? 1.0 : 0.0;
      either += here || there ? 1.0 : 0.0;
    }
    EXPECT_GT(both, (i == 1 ? 0.9 : 0.5) * either) << "window " << i;
    coarser = &window.ground;
  }
}

TEST_F(GroundWindows, LayersSeeTheWholesClimateAndWideGround) {
  folder_->write(
      "high.layers.toml",
      "version = 1\nground = { class = \"rock\" }\n[[layers]]\nname = \"cold\"\nclass = "
      "\"snow\"\nwhen = \"temperature < 4\"\n"
      "[[layers]]\nname = \"high\"\nclass = \"glacier\"\nwhen = \"relief_4000 > 300\"\n"
      "[[layers]]\nname = \"sunny\"\nclass = \"pasture\"\nwhen = \"radiation > 6500\"\n");
  const std::string layers = "land_cover.layers=\"high.layers.toml\"";
  const World whole = make_world(scene({layers}), silent_progress());
  const World parts = make_world(scene({layers, few_cells}), silent_progress());
  const TerrainWindow& finest = parts.terrain.windows.back();
  const Grid<LandCoverClass>& fine = finest.ground.land_cover->classes.cells;
  std::array<double, land_cover_class_count> kinds{};
  double same = 0.0;
  double all = 0.0;
  for (const auto [x, y] : test::cells(finest.part)) {
    all += 1.0;
    same += fine(x, y) == class_of(whole, finest, x, y) ? 1.0 : 0.0;
    kinds[static_cast<std::size_t>(fine(x, y))] += 1.0;
  }
  for (const LandCoverClass id : {LandCoverClass::rock, LandCoverClass::snow,
                                  LandCoverClass::glacier, LandCoverClass::pasture})
    EXPECT_GT(kinds[static_cast<std::size_t>(id)], 0.02 * all) << static_cast<int>(id);
  EXPECT_GT(same, 0.995 * all);
}

// Bumps and beds begin at a window's edge as in the coarser ground, and are the same noise.
TEST_F(GroundWindows, BumpsAndBedsAreJoined) {
  folder_->write("rough.layers.toml",
                 "version = 1\nground = { class = \"rock\" }\n[[inputs]]\nname = \"slope\"\nlow = "
                 "0\nhigh = 60\n[[layers]]\n"
                 "name = \"stones\"\nclass = \"scree\"\nroughness = { height_m = 5, length_m = 300 "
                 "}\n[layers.functions]\n"
                 "slope = { low = 10, high = 35, width = 8 }\n");
  const World parts = make_world(scene({"land_cover.layers=\"rough.layers.toml\"",
                                        "land_cover.colours=\"layers\"", few_cells}),
                                 silent_progress());
  const TerrainModel* coarser = &parts.terrain;
  for (const TerrainWindow& window : parts.terrain.windows) {
    const GroundRelief& fine = window.ground.land_cover->relief;
    const GroundRelief& coarse = coarser->land_cover->relief;
    ASSERT_EQ(fine.bumps.size(), 1U);
    EXPECT_EQ(fine.bumps[0].seed, coarse.bumps[0].seed);
    EXPECT_EQ(fine.transform, window.ground.dem->transform);
    ASSERT_TRUE(fine.lake_depth_m.same_size(window.ground.dem->altitude_m));
    int differs = 0;
    for (int x = window.part.x0; x < window.part.x1; ++x) {
      const glm::dvec2 position = fine.transform.to_crs(x, window.part.y0);
      const glm::dvec2 cell = coarse.transform.to_cell(position.x, position.y);
      // Every other vertex is one of the coarser ground's.
      if (std::abs(cell.x - std::round(cell.x)) > 0.1 ||
          std::abs(cell.y - std::round(cell.y)) > 0.1)
        continue;
      const auto there = coarse.bumps[0].share.clamped(static_cast<int>(std::lround(cell.x)),
                                                       static_cast<int>(std::lround(cell.y)));
      EXPECT_FLOAT_EQ(fine.bumps[0].share(x, window.part.y0), there);
      const int inside = (window.part.y0 + window.part.y1) / 2;
      const glm::dvec2 centre =
          coarse.transform.to_cell(position.x, fine.transform.to_crs(x, inside).y);
      differs += std::abs(fine.bumps[0].share(x, inside) -
                          sample_bilinear(coarse.bumps[0].share, centre.x, centre.y)) > 0.01F
                     ? 1
                     : 0;
    }
    EXPECT_GT(differs, 3) << "inside it has its own";
    coarser = &window.ground;
  }
}

TEST_F(GroundWindows, ABudgetThatHoldsNotEvenTheCoarsestIsRefused) {
  const MemoryLimit limit(std::uint64_t{8} << 20);
  const std::string message =
      test::message_of(ErrorKind::limit, [] { make_world(scene(), silent_progress()); });
  EXPECT_NE(message.find("900 × 900 cells, even in cells of 120 m"), std::string::npos) << message;
  EXPECT_NE(message.find("--memory"), std::string::npos) << message;
}

using testing::HasSubstr;

// 8192 × 8192 cells of 30 m on level ground, an eye 3 km above its southern edge.
const RasterFrame frame{{0.0, 245760.0, 30.0, 30.0}, 8192, 8192, {}};

Dem level_ground(int halved) {
  const int side = 8192 >> halved;
  const double cell = std::ldexp(30.0, halved);
  Dem dem = make_dem({Grid<float>(side, side, 0.F),
                      {0.5 * (30.0 - cell), 245760.0 - 0.5 * (30.0 - cell), cell, cell},
                      {}});
  dem.halved = halved;
  return dem;
}

View view(int width) {
  View view;
  view.camera.width = width;
  view.camera.height = width / 2;
  view.camera.eye = {122880.0, 3000.0, 3000.0};
  view.camera.pitch_deg = -8;
  view.viewer_xy = {122880.0, 3000.0};
  return view;
}

double cells_of(const GroundPlan& plan) {
  double cells = std::pow(8192 >> plan.coarsest, 2);
  for (const GroundWindow& window : plan.windows)
    cells += static_cast<double>(window.part.width()) * window.part.height();
  return cells;
}

TEST(GroundPlan, WindowsNestOnCellsThatBothHave) {
  const GroundPlan plan = plan_ground(frame, level_ground(3), view(4000), 6e6);
  ASSERT_GE(plan.windows.size(), 2U);
  PixelRect before{0, 0, 1024, 1024};
  int level = 3;
  for (const GroundWindow& window : plan.windows) {
    EXPECT_EQ(window.level, --level);
    EXPECT_EQ(window.part.x0 % 2, 0);
    EXPECT_EQ(window.part.y0 % 2, 0);
    EXPECT_EQ(window.part.width() % 2, 1);
    EXPECT_EQ(window.part.height() % 2, 1);
    EXPECT_GE(window.part.x0, 2 * before.x0 + 16);
    EXPECT_LE(window.part.y1, 2 * before.y1 - 16);
    before = window.part;
  }
  EXPECT_LE(cells_of(plan), 6e6);
}

TEST(GroundPlan, WiderPicturesGetFinerGroundFartherOff) {
  // A pixel of 100 shows twice as much ground as one of 200.
  const GroundPlan small = plan_ground(frame, level_ground(3), view(100), 3e7);
  const GroundPlan large = plan_ground(frame, level_ground(3), view(200), 3e7);
  ASSERT_FALSE(small.windows.empty());
  ASSERT_FALSE(large.windows.empty());
  EXPECT_GT(large.windows.back().to_m, 1.5 * small.windows.back().to_m);
  EXPECT_DOUBLE_EQ(small.cells_per_pixel, 0.25) << "nothing is saved where all is had";
}

TEST(GroundPlan, LessMemoryMeansCoarserCells) {
  const GroundPlan little = plan_ground(frame, level_ground(3), view(4000), 4.5e6);
  const GroundPlan much = plan_ground(frame, level_ground(3), view(4000), 1.6e7);
  EXPECT_GT(little.cells_per_pixel, much.cells_per_pixel);
  EXPECT_LE(cells_of(little), 4.5e6);
}

TEST(GroundPlan, SaysWhatIsCoarser) {
  const std::string text = describe({3, {{2, {}, 90000.0}, {1, {}, 40000.0}}, 1.0}, frame);
  EXPECT_THAT(text, HasSubstr("8192 × 8192"));
  EXPECT_THAT(text, HasSubstr("60 m to 40 km, 120 m to 90 km, 240 m beyond"));
}

}  // namespace
}  // namespace belvedere
