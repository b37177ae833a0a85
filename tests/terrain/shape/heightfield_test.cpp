#include "tests/terrain/shape/heightfield.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/error.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// Random heights over cells of cell_m; x east, y north, the first row northmost, as the renderer's
// surfaces.
Grid<glm::vec3> random_surface(int width, int height, float cell_m, float relief_m,
                               std::uint64_t seed) {
  return test::grid_of<glm::vec3>(width, height, [&](int x, int y) {
    return glm::vec3(static_cast<float>(x) * cell_m, static_cast<float>(height - 1 - y) * cell_m,
                     relief_m * static_cast<float>(random_uniform(seed, x, y)));
  });
}

// Möller & Trumbore 1997, against every facet: a different formula from the one under test.
std::optional<double> brute_force(const Grid<glm::vec3>& vertices, glm::dvec3 origin,
                                  glm::dvec3 direction) {
  double nearest = std::numeric_limits<double>::infinity();
  const auto facet = [&](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) return;
    const glm::dvec3 s = origin - a;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, ab);
    const double v = glm::dot(direction, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0) nearest = std::min(nearest, t);
  };
  for (int y = 0; y + 1 < vertices.height(); ++y)
    for (int x = 0; x + 1 < vertices.width(); ++x) {
      facet(vertices(x, y), vertices(x + 1, y), vertices(x, y + 1));
      facet(vertices(x + 1, y + 1), vertices(x, y + 1), vertices(x + 1, y));
    }
  if (std::isinf(nearest)) return std::nullopt;
  return nearest;
}

TEST(Heightfield, AgreesWithEveryFacetOnRandomRays) {
  int hits = 0;
  int rays = 0;
  const int sizes[][2] = {{2, 2}, {3, 2}, {2, 7}, {5, 5}, {17, 9}, {16, 31}};
  for (const auto& [width, height] : sizes) {
    const auto seed = static_cast<std::uint64_t>(width * 100 + height);
    const Grid<glm::vec3> vertices = random_surface(width, height, 30.F, 90.F, seed);
    const test::Heightfield field(vertices);
    const glm::dvec3 size(30.0 * (width - 1), 30.0 * (height - 1), 90.0);
    for (int i = 0; i < 1500; ++i) {
      const auto u = [&](int draw) { return random_uniform(seed + 1, i, draw); };
      // Eyes within, next to, above and below the surface; rays of any direction and length.
      const glm::dvec3 eye = (glm::dvec3(u(0), u(1), u(2)) * 2.0 - 0.5) * size;
      const glm::dvec3 look = (glm::dvec3(u(3), u(4), u(5)) * 1.4 - 0.2) * size - eye;
      const glm::dvec3 direction = look * (0.001 + 10.0 * u(6));
      const std::optional<double> expected = brute_force(vertices, eye, direction);
      const std::optional<double> found = field.intersect(eye, direction);
      ASSERT_EQ(found.has_value(), expected.has_value())
          << "ray " << i << " of " << width << "x" << height;
      ++rays;
      if (!expected) continue;
      ++hits;
      EXPECT_NEAR(*found, *expected, 1e-9 * (1.0 + *expected)) << "ray " << i;
    }
  }
  EXPECT_GT(hits, rays / 4);
  EXPECT_LT(hits, rays);
}

TEST(Heightfield, SplitsCellsAlongTheDiagonalOfTheTracer) {
  Grid<glm::vec3> vertices(2, 2);
  vertices(0, 0) = {0, 1, 0};
  vertices(1, 0) = {1, 1, 10};  // the diagonal runs between these two raised posts
  vertices(0, 1) = {0, 0, 10};
  vertices(1, 1) = {1, 0, 0};
  const test::Heightfield field(vertices);
  // Straight down at the centre: 10 on the ridge between the raised posts; the other diagonal would
  // give 0.
  EXPECT_DOUBLE_EQ(*field.intersect({0.5, 0.5, 100.0}, {0, 0, -1}), 90.0);
  EXPECT_DOUBLE_EQ(*field.intersect({0.25, 0.75, 100.0}, {0, 0, -2}), 47.5);
  EXPECT_DOUBLE_EQ(*field.intersect({0.5, 0.5, -5.0}, {0, 0, 1}), 15.0);  // from below
  EXPECT_FALSE(field.intersect({0.5, 0.5, 100.0}, {0, 0, 1}));
  EXPECT_FALSE(field.intersect({1.5, 0.5, 100.0}, {0, 0, -1}));
}

TEST(Heightfield, NoRayFallsThroughEdgesAndVertices) {
  const Grid<glm::vec3> vertices = random_surface(9, 9, 30.F, 60.F, 7);
  const test::Heightfield field(vertices);
  for (const auto [x, y] : test::cells({1, 1, 8, 8})) {
    const glm::dvec3 a(vertices(x, y));
    for (const auto& [dx, dy] :
         {std::pair{0, 0}, std::pair{1, 0}, std::pair{0, 1}, std::pair{1, -1}}) {
      const glm::dvec3 target = 0.5 * (a + glm::dvec3(vertices(x + dx, y + dy)));
      for (int i = 0; i < 8; ++i) {
        const glm::dvec3 eye(120.0 + 300.0 * (random_uniform(9, i, 0) - 0.5),
                             120.0 + 300.0 * (random_uniform(9, i, 1) - 0.5), 500.0);
        EXPECT_TRUE(field.intersect(eye, target - eye)) << x << ' ' << y << " ray " << i;
      }
      EXPECT_TRUE(field.intersect({target.x, target.y, 500.0}, {0, 0, -1})) << x << ' ' << y;
    }
  }
}

TEST(Heightfield, FacetsWithAVoidDoNotExist) {
  Grid<glm::vec3> vertices = random_surface(5, 5, 10.F, 0.F, 1);
  vertices(2, 2).z = std::numeric_limits<float>::quiet_NaN();
  const test::Heightfield field(vertices);
  EXPECT_FALSE(field.intersect({21.0, 19.0, 50.0}, {0, 0, -1}));
  EXPECT_TRUE(field.intersect({1.0, 1.0, 50.0}, {0, 0, -1}));
  EXPECT_THROW(test::Heightfield(Grid<glm::vec3>(1, 4)), std::invalid_argument);
}

}  // namespace
}  // namespace belvedere
