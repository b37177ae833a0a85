#include "renderer/world/ground_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "renderer/trace/guidance.h"
#include "renderer/world/world.h"
#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/files.h"

namespace belvedere {
namespace {

struct Notes : Progress {
  void note(std::string_view text) override { all += std::string(text) + "\n"; }
  std::string all;
};

// Made-up mountains of 27 × 27 km in a file, seen from their southern edge.
class GroundWindows : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::Folder;
    const Dem dem = make_synthetic_terrain({.width = 900, .height = 900, .cell_m = 30, .lowest_m = 500, .highest_m = 3000, .seed = 5},
                                           silent_progress());
    GeoTransform transform = dem.transform;
    transform.origin_x = 600000;
    transform.origin_y = 5227000;
    write_raster(*folder_ / "terrain.tif", Raster<float>{dem.altitude_m, transform, normalize_crs("EPSG:32632")});
  }
  static void TearDownTestSuite() {
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
pitch_deg = -12
[generalize]
foreground = [1.1, 1.1, 1.0, 0.9, 0.9, 0.8]
background = [1.2, 1.1, 1.0, 0.7, 0.5, 0.3]
foreground_to_m = 6000
background_from_m = 20000
crest = 0.5
[deform]
exaggeration = 1.4
[sampling]
pixel_samples = 1
shadow_rays = 2
sky_directions = 4
[output]
width = 320
height = 200
sheet_width_mm = 160
)";
    return parse_scene(text, "big.toml", *folder_ / "", {.data_folders = {*folder_ / ""}, .settings = settings});
  }
  static GuidanceBuffers guidance_of(const World& world) {
    GuidanceParameters parameters;
    parameters.sampling = world.scene.sampling;
    parameters.sun_direction = world.view.sun_direction;
    return trace_guidance(world.terrain, world.surface, world.tracer, *world.camera, parameters, {0, 0, 320, 200}, silent_progress());
  }

  static test::Folder* folder_;
};
test::Folder* GroundWindows::folder_ = nullptr;

constexpr const char* few_cells = "terrain.most_mcells=0.6";

bool is_sky(const GuidanceBuffers& seen, int x, int y) { return !std::isfinite(seen.depth_m(x, y)); }

TEST_F(GroundWindows, ShowWhatTheWholeShows) {
  Notes notes;
  const World whole(scene(), silent_progress());
  const World parts(scene({few_cells}), notes);
  ASSERT_TRUE(whole.terrain.windows.empty());
  ASSERT_EQ(parts.terrain.windows.size(), 2U) << notes.all;
  EXPECT_EQ(parts.dem->halved, 2);
  EXPECT_NE(notes.all.find("30 m to"), std::string::npos) << notes.all;
  const GuidanceBuffers a = guidance_of(whole);
  const GuidanceBuffers b = guidance_of(parts);

  std::array<int, 3> pixels{};  // by the grid that was hit
  std::vector<double> altitude, depth, slope;
  int same_class = 0;
  int ground = 0;
  int skies_apart = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 320; ++x) {
      if (is_sky(a, x, y) != is_sky(b, x, y)) ++skies_apart;
      if (is_sky(a, x, y) || is_sky(b, x, y)) continue;
      const Ray ray = parts.camera->ray({x + 0.5, y + 0.5});
      Hit hit;
      parts.tracer.intersect({&ray, 1}, {&hit, 1});
      ++pixels[static_cast<std::size_t>(hit.window)];
      // Behind an edge both may see another slope: only places that are the same are compared.
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
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
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
  const World parts(scene({few_cells}), silent_progress());
  const GuidanceBuffers seen = guidance_of(parts);
  for (int y = 1; y + 1 < 200; ++y)
    for (int x = 1; x + 1 < 320; ++x)
      if (is_sky(seen, x, y)) EXPECT_TRUE(is_sky(seen, x, y - 1) || is_sky(seen, x - 1, y) || is_sky(seen, x + 1, y)) << x << ' ' << y;
  // Straight down along every joint, from post to post and between them: the ground is always there, and where it should be.
  for (std::size_t n = 0; n < parts.surface.windows.size(); ++n) {
    const SurfaceWindow& window = parts.surface.windows[n];
    const auto look = [&](double column, double row) {
      const glm::dvec2 place =
          window.surface.vertices_m.empty() ? glm::dvec2(0.0) : parts.terrain.windows[n].ground.dem->transform.to_crs(column, row);
      const Ray ray{{place, 20000.0}, {0.0, 0.0, -1.0}};
      Hit hit;
      parts.tracer.intersect({&ray, 1}, {&hit, 1});
      EXPECT_TRUE(hit.found) << column << ' ' << row;
      EXPECT_NEAR(20000.0 - hit.distance_m, 1.4 * 1750.0, 1.4 * 1750.0) << "not the ground's";
    };
    for (double step = 0.0; step < window.part.width() - 1; step += 0.25) {
      look(window.part.x0 + step, window.part.y0);
      look(window.part.x0 + step, window.part.y1 - 1);
    }
  }
}

TEST_F(GroundWindows, MeetTheGroundAroundThemInAllTheyKnow) {
  const World parts(scene({few_cells}), silent_progress());
  const TerrainModel* coarser = &parts.terrain;
  for (const TerrainWindow& window : parts.terrain.windows) {
    const auto expect_joined = [&](const Grid<float>& fine, const Grid<float>& coarse, const char* what) {
      for (int x = 0; x < window.part.width(); x += 2)
        for (const int y : {0, window.part.height() - 1})
          EXPECT_EQ(fine(window.part.x0 + x, window.part.y0 + y), coarse(window.replaces.x0 + x / 2, window.replaces.y0 + y / 2)) << what;
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
    return guidance_of(World(scene({few_cells}), silent_progress()));
  };
  const GuidanceBuffers one = seen(1);
  const GuidanceBuffers two = seen(2);
  EXPECT_EQ(one.depth_m, two.depth_m);
  EXPECT_EQ(one.normal, two.normal);
  EXPECT_EQ(one.land_cover, two.land_cover);
  EXPECT_EQ(one.flow, two.flow);
}

TEST_F(GroundWindows, RiversThatEnterBringTheirCatchment) {
  const World whole(scene(), silent_progress());
  const World parts(scene({few_cells}), silent_progress());
  const TerrainWindow& finest = parts.terrain.windows.back();
  const auto largest = [](const Grid<float>& flow, const PixelRect& rect) {
    float most = 0.F;
    for (int y = rect.y0; y < rect.y1; ++y)
      for (int x = rect.x0; x < rect.x1; ++x) most = std::max(most, flow(x, y));
    return most;
  };
  const glm::dvec2 first = finest.ground.dem->transform.to_crs(finest.part.x0, finest.part.y0);
  const glm::ivec2 at(glm::round(whole.dem->transform.to_cell(first.x, first.y)));
  const float of_whole = largest(whole.terrain.flow, {at.x, at.y, at.x + finest.part.width(), at.y + finest.part.height()});
  // A logarithm: a fifth more or less.
  EXPECT_NEAR(largest(finest.ground.flow, finest.part), of_whole, 0.1);
}

TEST_F(GroundWindows, ADemThatFitsStaysWhole) {
  const World plenty(scene({"terrain.most_mcells=1"}), silent_progress());
  EXPECT_TRUE(plenty.terrain.windows.empty());
  EXPECT_EQ(plenty.terrain.generalized_m, World(scene(), silent_progress()).terrain.generalized_m);
}

}  // namespace
}  // namespace belvedere
