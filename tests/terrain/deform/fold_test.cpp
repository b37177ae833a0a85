#include "terrain/deform/fold.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "base/parallel.h"

namespace belvedere {
namespace {

// 200 × 200 cells of 100 m, its centre at (10000, 10000).
const GeoTransform frame{0.0, 20000.0, 100.0, 100.0};
const Grid<float> flat(200, 200, 500.F);

Deformation with(std::vector<DeformHandle> handles) {
  DeformParameters parameters;
  parameters.handles = std::move(handles);
  parameters.bend.radius_m = 50000.0;
  return {parameters, {10000.0, -20000.0}};
}

TEST(Fold, NoneWithoutHandlesAndNoneWhereATurnIsWideEnough) {
  EXPECT_TRUE(find_folds(flat, frame, with({})).empty());
  EXPECT_TRUE(find_folds(flat, frame,
                         with({{.centre = {10000.0, 10000.0},
                                .rotate_deg = 50.0,
                                .radius_m = 8000.0,
                                .core_m = 3000.0}}))
                  .empty());
  EXPECT_TRUE(find_folds(flat, frame,
                         with({{.centre = {10000.0, 10000.0},
                                .rotate_deg = 90.0,
                                .radius_m = 9000.0,
                                .core_m = 3000.0}}))
                  .empty());
}

TEST(Fold, ATurnFoldsNothingAndAMoveFromItsLimitOn) {
  // A twist preserves areas (until it exceeds the facets). A move folds where the share falls
  // faster than 1 / its length: steepest 15/8 over the ring.
  EXPECT_TRUE(find_folds(flat, frame,
                         with({{.centre = {10000.0, 10000.0},
                                .rotate_deg = 110.0,
                                .radius_m = 8000.0,
                                .core_m = 3000.0}}))
                  .empty());
  const auto folds = [&](double move) {
    return find_folds(flat, frame,
                      with({{.centre = {10000.0, 10000.0},
                             .move_m = {move, 0.0},
                             .radius_m = 7000.0,
                             .core_m = 3000.0}}))
        .size();
  };
  EXPECT_EQ(folds(0.97 * 4000.0 * 8.0 / 15.0), 0U);
  EXPECT_GT(folds(1.03 * 4000.0 * 8.0 / 15.0), 0U);
}

TEST(Fold, IsFoundWhereAMovedCoreRunsOverTheGroundBeforeIt) {
  // 3 km east, over a ring of 2 km: the ground folds east of the core; on the west it is stretched.
  const std::vector<DeformHandle> handles = {
      {.centre = {4000.0, 4000.0}, .move_m = {300.0, 0.0}, .radius_m = 3500.0, .core_m = 1000.0},
      {.centre = {12000.0, 12000.0},
       .move_m = {3000.0, 0.0},
       .radius_m = 4000.0,
       .core_m = 2000.0}};
  const Deformation deformation = with(handles);
  const std::vector<Fold> folds = find_folds(flat, frame, deformation);
  ASSERT_FALSE(folds.empty());
  for (const Fold& fold : folds) {
    EXPECT_GT(fold.position.x, 12500.0);
    EXPECT_GT(glm::length(fold.position - handles[1].centre), 2000.0 - 142.0);
    EXPECT_LT(glm::length(fold.position - handles[1].centre), 4000.0);
    const glm::dvec2 post = frame.to_crs(fold.column, fold.row);
    EXPECT_LT(glm::length(post - fold.position), 142.0);
  }
  const std::vector<FoldSummary> summary = summarize_folds(folds, deformation.parameters());
  ASSERT_EQ(summary.size(), 1U);
  EXPECT_EQ(summary[0].handle, 1U);
  EXPECT_EQ(summary[0].facets, folds.size());
  EXPECT_NEAR(summary[0].centre.y, 12000.0, 300.0);
  EXPECT_GT(summary[0].centre.x, 14000.0);
  EXPECT_LT(summary[0].centre.x, 16000.0);
}

TEST(Fold, OfAFieldWhoseNeighboursMoveUnlike) {
  DeformParameters parameters;
  parameters.field = {
      .length_m = 1500.0, .reach_m = 800.0, .still_m = 20.0, .max_m = 1500.0, .places = {}};
  // Seen from the south, ground in the west moves to the east and the other way round.
  parameters.field.places = {{{9000.0, 12000.0}, {900.0, 0.0}, {5.0, 5.0}},
                             {{11000.0, 12000.0}, {-900.0, 0.0}, {5.0, 5.0}}};
  const Deformation deformation(parameters, {10000.0, -20000.0});
  const std::vector<Fold> folds = find_folds(flat, frame, deformation);
  ASSERT_FALSE(folds.empty());
  for (const Fold& fold : folds) EXPECT_NEAR(fold.position.x, 10000.0, 1100.0);
  const std::vector<FoldSummary> summary = summarize_folds(folds, parameters);
  ASSERT_EQ(summary.size(), 1U);
  EXPECT_FALSE(summary[0].handle);
  parameters.field.places[1].moved.lateral_m = 600.0;
  EXPECT_TRUE(find_folds(flat, frame, Deformation(parameters, {10000.0, -20000.0})).empty());
}

TEST(Fold, AgreesWithTheSignOfAreasAllOverTheGrid) {
  const Deformation deformation = with({{.centre = {9000.0, 11000.0},
                                         .move_m = {-900.0, 2400.0},
                                         .rotate_deg = 120.0,
                                         .radius_m = 4000.0,
                                         .core_m = 1500.0}});
  std::size_t turned_over = 0;
  const auto position = [&](int x, int y) {
    return glm::dvec2(deformation.point({frame.to_crs(x, y), 500.0}));
  };
  const auto area = [](glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  for (int y = 0; y < 199; ++y)
    for (int x = 0; x < 199; ++x) {
      turned_over += area(position(x, y), position(x, y + 1), position(x + 1, y)) <= 0.0 ? 1 : 0;
      turned_over +=
          area(position(x + 1, y + 1), position(x + 1, y), position(x, y + 1)) <= 0.0 ? 1 : 0;
    }
  EXPECT_GT(turned_over, 10U);
  EXPECT_EQ(find_folds(flat, frame, deformation).size(), turned_over);
}

TEST(Fold, SameForAnyThreadCount) {
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<std::pair<int, int>> cells;
    for (const Fold& fold :
         find_folds(flat, frame,
                    with({{.centre = {9e3, 9e3}, .move_m = {4000.0, 0.0}, .radius_m = 4500.0}})))
      cells.emplace_back(fold.column, fold.row);
    return cells;
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace belvedere
