#include "renderer/trace/tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/shape/heightfield.h"

namespace belvedere {
namespace {

constexpr double mesh_cell_m = 30.0;

// Posts every 30 m, the first at (0, 0), rows southwards, around a distant origin as in real
// scenes.
template <class F>
DeformedSurface make_surface(int width, int height, F&& altitude) {
  DeformedSurface surface;
  surface.origin = {692000.0, 5302000.0, 0.0};
  surface.vertices_m = Grid<glm::vec3>(width, height);
  for (const auto [x, y] : test::cells(width, height))
    surface.vertices_m(x, y) = {static_cast<float>(x * mesh_cell_m),
                                static_cast<float>(-y * mesh_cell_m),
                                static_cast<float>(altitude(x * mesh_cell_m, -y * mesh_cell_m))};
  return surface;
}

// A rough terrain that needs only random numbers: octaves of value noise, interpolated linearly.
double rough_altitude(double x, double y) {
  double sum = 0.0;
  for (int octave = 0; octave < 6; ++octave) {
    const double wave = 6000.0 / (1 << octave);
    const double gx = x / wave;
    const double gy = y / wave;
    const auto ix = static_cast<std::int64_t>(std::floor(gx));
    const auto iy = static_cast<std::int64_t>(std::floor(gy));
    const double fx = gx - static_cast<double>(ix);
    const double fy = gy - static_cast<double>(iy);
    const auto at = [&](int i, int j) { return random_uniform(77 + octave, ix + i, iy + j); };
    const double top = at(0, 0) * (1 - fx) + at(1, 0) * fx;
    const double low = at(0, 1) * (1 - fx) + at(1, 1) * fx;
    sum += (top * (1 - fy) + low * fy) * wave * 0.35;
  }
  return sum;
}

Ray ray_from(glm::dvec3 local_origin, glm::dvec3 direction) {
  return {local_origin + glm::dvec3(692000.0, 5302000.0, 0.0), glm::normalize(direction)};
}

Hit intersect(const Tracer& tracer, const Ray& ray) {
  Hit hit;
  tracer.intersect({&ray, 1}, {&hit, 1});
  return hit;
}

bool occluded(const Tracer& tracer, const Ray& ray, double reach_m = 1e9) {
  std::uint8_t blocked = 0;
  tracer.occluded({&ray, 1}, reach_m, {&blocked, 1});
  return blocked != 0;
}

bool same_bits(const Hit& a, const Hit& b) {
  return a.found == b.found && a.distance_m == b.distance_m && a.column == b.column &&
         a.row == b.row && a.facet_area == b.facet_area;
}

// Rays of a perspective view over the surface, in bundles of 4 × 4 pixels.
std::vector<Ray> view_rays(const DeformedSurface& surface, int width, int height, double height_m,
                           double pitch_deg = -10.0) {
  CameraParameters p{.width = width, .height = height};
  const glm::dvec3 a = surface.origin + glm::dvec3(surface.vertices_m(0, 0));
  const glm::dvec3 b =
      surface.origin + glm::dvec3(surface.vertices_m(surface.vertices_m.width() - 1,
                                                     surface.vertices_m.height() - 1));
  p.eye = {0.5 * (a.x + b.x), a.y + 0.15 * (a.y - b.y), height_m};
  p.azimuth_deg = 180.0;
  p.pitch_deg = pitch_deg;
  const auto camera = make_camera(p);
  std::vector<Ray> rays;
  for (const auto [x, y] : test::cells({0, 0, width, height}, 4))
    for (int k = 0; k < 16; ++k) rays.push_back(camera->ray({x + k % 4 + 0.5, y + k / 4 + 0.5}));
  return rays;
}

TEST(Tracer, DiagonalRunsFromNorthEastToSouthWest) {
  // A saddle: 100 m at two opposite posts. Along the diagonal that joins the low posts the cell is
  // low, along the other it is high.
  const DeformedSurface surface =
      make_surface(2, 2, [](double x, double y) { return (x == 0.0) == (y == 0.0) ? 100.0 : 0.0; });
  const Tracer tracer(surface);
  const Hit hit = intersect(tracer, ray_from({15.0, -15.0, 1000.0}, {0.0, 0.0, -1.0}));
  ASSERT_TRUE(hit.found);
  EXPECT_NEAR(hit.distance_m, 1000.0, 1e-6);
  const Hit quarter = intersect(tracer, ray_from({7.5, -7.5, 1000.0}, {0.0, 0.0, -1.0}));
  ASSERT_TRUE(quarter.found);
  EXPECT_NEAR(quarter.distance_m, 950.0, 1e-6);
}

TEST(Tracer, PlaceIsExactOnAPlane) {
  const DeformedSurface surface =
      make_surface(300, 200, [](double x, double y) { return 0.25 * x - 0.125 * y; });
  const Tracer tracer(surface);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-0.25, 0.125, 1.0));
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 on(random_uniform(1, i, 0) * 8900.0, -random_uniform(1, i, 1) * 5900.0, 0.0);
    const glm::dvec3 target = {on.x, on.y, 0.25 * on.x - 0.125 * on.y};
    const glm::dvec3 eye(4000.0, 9000.0, 9000.0);
    const Hit hit = intersect(tracer, ray_from(eye, target - eye));
    ASSERT_TRUE(hit.found);
    EXPECT_NEAR(hit.distance_m, glm::length(target - eye),
                1e-3);  // posts are floats: half a millimetre
    EXPECT_NEAR(hit.column, target.x / mesh_cell_m, 1e-4);
    EXPECT_NEAR(hit.row, -target.y / mesh_cell_m, 1e-4);
    EXPECT_GT(glm::dot(hit.facet_normal(), normal), 1.0 - 1e-7);
  }
}

TEST(Tracer, EveryPostIsHitInEveryTileAndTheLast) {
  // Sizes that leave a last tile of one cell, of a whole tile, and a single tile.
  for (const int size : {2, 33, 65, 66, 129}) {
    const DeformedSurface surface =
        make_surface(size, size, [](double x, double y) { return rough_altitude(x, y); });
    const Tracer tracer(surface);
    for (const auto [x, y] : test::cells(size, size)) {
      // Just inside: the terrain's own edge may be missed.
      const double px = std::clamp(x * mesh_cell_m, 1e-3, (size - 1) * mesh_cell_m - 1e-3);
      const double py = std::clamp(y * mesh_cell_m, 1e-3, (size - 1) * mesh_cell_m - 1e-3);
      const Hit hit = intersect(tracer, ray_from({px, -py, 20000.0}, {0.0, 0.0, -1.0}));
      ASSERT_TRUE(hit.found) << size << ": " << x << ' ' << y;
      ASSERT_NEAR(hit.distance_m, 20000.0 - surface.vertices_m(x, y).z, 0.02);
      ASSERT_NEAR(hit.column, x, 1e-3);
      ASSERT_NEAR(hit.row, y, 1e-3);
    }
  }
}

TEST(Tracer, WallIsHitAtItsFace) {
  // A wall 600 m high, one cell thick, its foot between x = 3000 and 3030.
  const DeformedSurface surface = make_surface(
      200, 100, [](double x, double) { return x >= 3030.0 && x <= 3060.0 ? 600.0 : 0.0; });
  const Tracer tracer(surface);
  const Hit face = intersect(tracer, ray_from({1000.0, -1500.0, 300.0}, {1.0, 0.0, 0.0}));
  ASSERT_TRUE(face.found);
  EXPECT_NEAR(face.distance_m, 2015.0, 1e-6);  // half way up a face that leans over one cell
  EXPECT_NEAR(face.column, 100.5, 1e-6);
  EXPECT_NEAR(face.facet_normal().x, -600.0 / std::hypot(600.0, 30.0), 1e-9);
  EXPECT_FALSE(intersect(tracer, ray_from({1000.0, -1500.0, 601.0}, {1.0, 0.0, 0.0})).found);
  // From below the facet is hit as well, and its normal still points up.
  const Hit below = intersect(tracer, ray_from({1000.0, -1500.0, -300.0}, {0.0, 0.0, 1.0}));
  ASSERT_TRUE(below.found);
  EXPECT_NEAR(below.facet_normal().z, 1.0, 1e-12);
}

TEST(Tracer, ShadowOfAWallIsItsHeightOverTheTangent) {
  const double height = 600.0;
  const DeformedSurface surface = make_surface(
      400, 100, [&](double x, double) { return x >= 9000.0 && x <= 9030.0 ? height : 0.0; });
  const Tracer tracer(surface);
  for (const double altitude : {8.0, 15.0, 30.0, 45.0, 60.0}) {
    const glm::dvec3 sun(std::cos(to_radians(altitude)), 0.0, std::sin(to_radians(altitude)));
    // Westwards of the crest's west edge, the shadow ends where the ray passes over it.
    double lit_from = 0.0;
    for (double x = 8960.0; x > 100.0; x -= 1.0)
      if (!occluded(tracer, ray_from({x, -1500.0, 0.05}, sun))) {
        lit_from = x;
        break;
      }
    EXPECT_NEAR(9000.0 - lit_from, height / std::tan(to_radians(altitude)), mesh_cell_m)
        << altitude;
    EXPECT_NEAR(9000.0 - lit_from, height / std::tan(to_radians(altitude)), 2.0) << altitude;
  }
}

TEST(Tracer, APlaneHasNoShadowAndReachIsKept) {
  const DeformedSurface plane =
      make_surface(300, 300, [](double x, double y) { return 0.2 * x + 0.1 * y; });
  const Tracer tracer(plane);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-0.2, -0.1, 1.0));
  const std::vector<Ray> rays = view_rays(plane, 120, 80, 6000.0, -40.0);
  std::vector<Hit> hits(rays.size());
  tracer.intersect(rays, hits);
  int count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found) continue;
    ++count;
    const glm::dvec3 start =
        rays[i].origin + rays[i].direction * hits[i].distance_m + 0.05 * hits[i].facet_normal();
    for (const glm::dvec3 sun :
         {glm::dvec3(-0.6, 0.6, 0.5), glm::dvec3(0.99, 0.0, 0.25), glm::dvec3(0.0, 0.0, 1.0)}) {
      if (glm::dot(normal, sun) > 0.01) {
        EXPECT_FALSE(occluded(tracer, {start, glm::normalize(sun)}));
      }
    }
  }
  EXPECT_GT(count, 3000);
  const Ray down =
      ray_from({3000.0, -3000.0, 5300.0}, {0.0, 0.0, -1.0});  // the ground is 300 m high there
  EXPECT_FALSE(occluded(tracer, down, 4999.0));
  EXPECT_TRUE(occluded(tracer, down, 5001.0));
}

void expect_like_oracle(const DeformedSurface& surface, double height_m) {
  const Tracer tracer(surface);
  const test::Heightfield oracle(surface.vertices_m);
  const std::vector<Ray> rays = view_rays(surface, 400, 280, height_m);
  std::vector<Hit> hits(rays.size());
  tracer.intersect(rays, hits);
  std::vector<double> expected(rays.size(), -1.0);
  parallel_ranges(rays.size(), std::size_t{64}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const auto d = oracle.intersect(rays[i].origin - surface.origin, rays[i].direction);
      if (d) expected[i] = *d;
    }
  });
  int flips = 0;
  int found = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool there = expected[i] >= 0.0;
    if (there != hits[i].found) ++flips;
    if (!there || !hits[i].found) continue;
    ++found;
    worst = std::max(worst, std::abs(expected[i] - hits[i].distance_m));
    // Column and row give the same position as the distance.
    const glm::dvec3 p = rays[i].origin + rays[i].direction * hits[i].distance_m - surface.origin;
    const glm::dvec3 corner(surface.vertices_m(0, 0));
    ASSERT_NEAR(hits[i].column, (p.x - corner.x) / mesh_cell_m, 0.01);
    ASSERT_NEAR(hits[i].row, (corner.y - p.y) / mesh_cell_m, 0.01);
  }
  EXPECT_GT(rays.size(), 100000U);
  EXPECT_GT(found, 50000);
  EXPECT_EQ(flips, 0);
  EXPECT_LT(worst, 0.05);
}

TEST(Tracer, AgreesWithHeightfieldOnRoughGround) {
  expect_like_oracle(make_surface(700, 600, rough_altitude), 5200.0);
}

TEST(Tracer, AgreesWithHeightfieldOnInnsbruck) {
  const std::string file = test::data_folder() + "/innsbruck/innsbruck_utm32_30m.tif";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing";
  RasterSource source;
  source.path = file;
  const Raster<float> dem = read_raster(source);
  constexpr int x0 = 700;
  constexpr int y0 = 1400;
  const DeformedSurface surface = make_surface(900, 800, [&](double x, double y) {
    return dem.cells(x0 + static_cast<int>(std::lround(x / mesh_cell_m)),
                     y0 - static_cast<int>(std::lround(y / mesh_cell_m)));
  });
  expect_like_oracle(surface, 4500.0);
}

// Each instruction set splits bundles in its own way, and Debian's Embree terminates the program on
// an invalid ray.
class EachInstructionSet : public testing::TestWithParam<std::string> {};

TEST_P(EachInstructionSet, NaNRaysMissAndHarmNoNeighbour) {
  const DeformedSurface surface = make_surface(100, 100, rough_altitude);
  TracerParameters parameters;
  parameters.instruction_set = GetParam();
  std::optional<Tracer> made;
  try {
    made.emplace(surface, parameters);
  } catch (const Error& error) {
    ASSERT_EQ(error.kind(), ErrorKind::limit);
    GTEST_SKIP() << error.what();
  }
  const Tracer& tracer = *made;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<Ray> rays(
      21, ray_from({1500.0, -1500.0, 9000.0}, {0.01, 0.02, -1.0}));  // not a multiple of 16
  const Hit good = intersect(tracer, rays[0]);
  ASSERT_TRUE(good.found);
  rays[2].origin.x = nan;
  rays[5].direction.z = nan;
  rays[9].direction = {0.0, 0.0, 0.0};
  rays[17].origin.z = inf;
  std::vector<Hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size(), 7);
  tracer.intersect(rays, hits);
  tracer.occluded(rays, 1e9, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const bool bad = i == 2 || i == 5 || i == 9 || i == 17;
    EXPECT_EQ(hits[i].found, !bad) << i;
    EXPECT_EQ(blocked[i], bad ? 0 : 1) << i;
    if (!bad) {
      EXPECT_TRUE(same_bits(hits[i], good)) << i;
    }
  }
}

TEST_P(EachInstructionSet, BundlesOfAnyLengthAreTraced) {
  const DeformedSurface surface = make_surface(100, 100, rough_altitude);
  TracerParameters parameters;
  parameters.instruction_set = GetParam();
  std::optional<Tracer> tracer;
  try {
    tracer.emplace(surface, parameters);
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
  const std::vector<Ray> rays(33, ray_from({1500.0, -1500.0, 9000.0}, {0.01, 0.02, -1.0}));
  for (std::size_t count = 1; count <= rays.size(); ++count) {
    std::vector<Hit> hits(count);
    std::vector<std::uint8_t> blocked(count, 7);
    tracer->intersect(std::span(rays).first(count), hits);
    tracer->occluded(std::span(rays).first(count), 1e9, blocked);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(hits[i].found) << i << " of " << count;
      ASSERT_EQ(blocked[i], 1) << i << " of " << count;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Tracer, EachInstructionSet,
                         testing::Values("sse2", "sse4.2", "avx", "avx2", "avx512"),
                         [](const auto& set) {
                           std::string name = set.param;
                           std::erase(name, '.');
                           return name;
                         });

std::vector<Hit> trace_in_tasks(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  parallel_ranges(rays.size() / 64, std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      tracer.intersect(std::span(rays).subspan(i * 64, 64), std::span(hits).subspan(i * 64, 64));
  });
  return hits;
}

TEST(Tracer, SameBitsForAnyThreadsTilesAndBundles) {
  const DeformedSurface surface = make_surface(500, 400, rough_altitude);
  const std::vector<Ray> rays = view_rays(surface, 320, 256, 4500.0);
  const auto traced = [&](int threads) {
    const ThreadLimit limit(threads);
    return trace_in_tasks(Tracer(surface), rays);
  };
  const std::vector<Hit> one = traced(1);
  const std::vector<Hit> two = traced(2);
  TracerParameters parameters;
  parameters.tile_cells = 37;
  const std::vector<Hit> other_tiles = trace_in_tasks(Tracer(surface, parameters), rays);
  // Bundles shifted by 5 rays: other neighbours in each packet.
  std::vector<Hit> shifted(rays.size());
  const Tracer tracer(surface);
  tracer.intersect(std::span(rays).subspan(0, 5), std::span(shifted).subspan(0, 5));
  tracer.intersect(std::span(rays).subspan(5), std::span(shifted).subspan(5));
  int different = 0;
  int found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    found += one[i].found ? 1 : 0;
    if (!same_bits(one[i], two[i]) || !same_bits(one[i], other_tiles[i]) ||
        !same_bits(one[i], shifted[i]))
      ++different;
  }
  EXPECT_GT(found, 30000);
  EXPECT_EQ(different, 0);
}

TEST(Tracer, InstructionSetsAgreeOnTheFacet) {
  const DeformedSurface surface = make_surface(500, 400, rough_altitude);
  const std::vector<Ray> rays = view_rays(surface, 480, 400, 4500.0);
  TracerParameters plain;
  plain.instruction_set = "sse2";
  const Tracer oldest(surface, plain);
  EXPECT_EQ(oldest.description(), "Embree 3.13.5, SSE2 pinned");
  const std::vector<Hit> expected = trace_in_tasks(oldest, rays);
  for (const char* isa : {"sse4.2", "avx", "avx2", "avx512", "any"}) {
    TracerParameters parameters;
    parameters.instruction_set = isa;
    std::optional<Tracer> tracer;
    try {
      tracer.emplace(surface, parameters);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(),
                ErrorKind::limit);  // this machine lacks it: reported, not silently replaced
      continue;
    }
    const std::vector<Hit> hits = trace_in_tasks(*tracer, rays);
    int different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
      different += same_bits(hits[i], expected[i]) ? 0 : 1;
    EXPECT_EQ(different, 0) << isa << " of " << rays.size();
  }
}

TEST(Tracer, RefusesWhatItCannotTrace) {
  DeformedSurface row;
  row.vertices_m = Grid<glm::vec3>(5, 1);
  EXPECT_THROW(Tracer{row}, Error);
  const DeformedSurface surface = make_surface(4, 4, rough_altitude);
  TracerParameters parameters;
  parameters.instruction_set = "mmx";
  EXPECT_THROW(Tracer(surface, parameters), Error);
}

TEST(Tracer, DescribesItselfAndCountsItsMemory) {
  const DeformedSurface surface = make_surface(600, 600, rough_altitude);
  const Tracer tracer(surface);
  EXPECT_EQ(tracer.description().rfind("Embree 3.13.5, ", 0), 0U) << tracer.description();
  EXPECT_GT(tracer.memory_bytes(), 10U * 360000U);
  EXPECT_LT(tracer.memory_bytes(), 60U * 360000U);
}

}  // namespace
}  // namespace belvedere
