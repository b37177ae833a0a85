#include "base/masks/erosion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/grid.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using Labels = Grid<std::uint8_t>;

std::array<bool, 256> opens(std::initializer_list<int> labels) {
  std::array<bool, 256> all{};
  for (const int label : labels) all[static_cast<std::size_t>(label)] = true;
  return all;
}

Labels disc(int side, double radius) {
  Labels out(side, side);
  for (const auto [x, y] : test::cells(side, side)) {
    const double dx = x - .5 * (side - 1);
    const double dy = y - .5 * (side - 1);
    out(x, y) = dx * dx + dy * dy <= radius * radius ? 1 : 0;
  }
  return out;
}

double radius_of(const Labels& labels) {
  return std::sqrt(static_cast<double>(std::count(labels.begin(), labels.end(), 1)) / 3.14159265);
}

// Two labels and a third in patches, without a closed form.
Labels patchy(int width, int height) {
  Labels out(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const double v = gaussian_noise(4, x, y, 9.0);
    out(x, y) = v > 0.2 ? 1 : v > -.5 ? 2 : 3;
  }
  return out;
}

TEST(Erosion, AFlatBorderGoesBackByAStepALevel) {
  Labels half(120, 60);
  for (int y = 0; y < 60; ++y) std::fill(half.row(y) + 20, half.row(y) + 120, std::uint8_t{1});
  const Erosion even = erode(half, 1, opens({0}), {.levels = 3, .step = 8.0, .ragged = 0.0});
  for (const auto [x, y] : test::cells({0, 10, 120, 50}))
    ASSERT_EQ(even.level(x, y), x < 20 || x >= 44 ? 0 : 1 + (x - 20) / 8) << x << " " << y;
}

TEST(Erosion, ADiscShrinksByAStepALevel) {
  const Labels round = disc(301, 120.0);
  const Erosion even = erode(round, 1, opens({0}), {.levels = 4, .step = 8.0, .ragged = 0.0});
  EXPECT_NEAR(radius_of(even.labels), 120.0 - 32.0, 1.0);
  double ragged = 0.0;
  for (const std::uint64_t seed : {1, 2, 3, 4})
    ragged +=
        .25 *
        radius_of(erode(round, 1, opens({0}), {.levels = 4, .step = 8.0, .seed = seed}).labels);
  EXPECT_NEAR(ragged, 120.0 - 32.0, 3.5)
      << "a tenth of the way: slow and fast places of four seeds are not quite even";
}

// Ragged: the border of a disc is no longer a circle, and longer.
TEST(Erosion, BordersAreMadeAnew) {
  const auto spread = [](double ragged) {
    const Labels left =
        erode(disc(301, 120.0), 1, opens({0}), {.levels = 3, .step = 8.0, .ragged = ragged}).labels;
    double sum = 0.0;
    double squares = 0.0;
    int count = 0;
    for (const auto [x, y] : test::cells({1, 1, 300, 300})) {
      if (left(x, y) != 1 || (left(x + 1, y) == 1 && left(x - 1, y) == 1 && left(x, y + 1) == 1 &&
                              left(x, y - 1) == 1))
        continue;
      const double r = std::hypot(x - 150.0, y - 150.0);
      sum += r;
      squares += r * r;
      ++count;
    }
    return std::sqrt(squares / count - sum * sum / count / count);
  };
  EXPECT_LT(spread(0.0), 1.0);
  EXPECT_GT(spread(.4), 3.0);
}

TEST(Erosion, LevelsAreNestedAndMonotone) {
  const Labels labels = patchy(120, 90);
  const ErosionParameters three{.levels = 3, .step = 4.0};
  const Erosion all = erode(labels, 1, opens({2, 3}), three);
  Labels before = labels;
  for (int levels = 1; levels <= 3; ++levels) {
    ErosionParameters fewer = three;
    fewer.levels = levels;
    const Labels now = erode(labels, 1, opens({2, 3}), fewer).labels;
    std::size_t taken = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_EQ(now[i] == 1, labels[i] == 1 && (all.level[i] == 0 || all.level[i] > levels));
      ASSERT_TRUE(labels[i] == 1 || now[i] == labels[i]) << "what was not the label stays";
      ASSERT_TRUE(before[i] == 1 || now[i] == before[i])
          << "what was taken stays taken, by the same label";
      taken += before[i] == 1 && now[i] != 1 ? 1 : 0;
    }
    EXPECT_GT(taken, 0U);
    before = now;
  }
}

TEST(Erosion, NothingStaysNothingAndWhatNobodyOpensStays) {
  const Labels empty(30, 20, 2);
  EXPECT_EQ(erode(empty, 1, opens({2}), {.levels = 5}).labels, empty);
  const Labels full(30, 20, 1);
  EXPECT_EQ(erode(full, 1, opens({2}), {.levels = 5}).labels, full);
  const Labels round = disc(41, 10.0);
  EXPECT_EQ(erode(round, 1, opens({5}), {.levels = 5}).labels, round) << "a lake takes nothing";
  const Labels gone = erode(round, 1, opens({0}), {.levels = 9, .step = 4.0}).labels;
  EXPECT_EQ(std::count(gone.begin(), gone.end(), 1), 0) << "an island goes at last";
}

// Between two labels, each half goes to the nearer one.
TEST(Erosion, TheNearestLabelTakesOver) {
  Labels row(60, 9, 1);
  for (int y = 0; y < 9; ++y) {
    std::fill(row.row(y), row.row(y) + 10, std::uint8_t{2});
    std::fill(row.row(y) + 50, row.row(y) + 60, std::uint8_t{3});
  }
  const Labels left =
      erode(row, 1, opens({2, 3}), {.levels = 1, .step = 30.0, .ragged = 0.0}).labels;
  for (int x = 0; x < 60; ++x) EXPECT_EQ(left(x, 4), x < 30 ? 2 : 3) << x;
}

TEST(Erosion, AnyPartOfTheGridGivesTheSame) {
  const Labels labels = patchy(260, 240);
  const ErosionParameters parameters{
      .levels = 2, .step = 4.0, .x = 1000.0, .y = -500.0, .dx = 1.0, .dy = -1.0};
  const Labels whole = erode(labels, 1, opens({2, 3}), parameters).labels;
  const PixelRect wanted{100, 90, 160, 140};
  for (const int margin : {erosion_reach(parameters), erosion_reach(parameters) + 13}) {
    const PixelRect window = grown(wanted, margin);
    ErosionParameters there = parameters;
    there.x += window.x0;
    there.y -= window.y0;
    const Labels part = erode(part_of(labels, window), 1, opens({2, 3}), there).labels;
    EXPECT_EQ(part_of(part, moved(wanted, -window.x0, -window.y0)), part_of(whole, wanted));
  }
  ErosionParameters elsewhere = parameters;
  elsewhere.x += 37.0;
  EXPECT_NE(erode(labels, 1, opens({2, 3}), elsewhere).labels, whole)
      << "borders depend on the position";
}

// Cells of half the size show the same ground: nearly the same remains.
TEST(Erosion, FinerCellsErodeAlike) {
  const auto left = [](int scale) {
    Labels labels(160 * scale, 160 * scale);
    for (const auto [x, y] : test::cells(labels))
      labels(x, y) = gaussian_noise(4, (x + .5) / scale, (y + .5) / scale, 16.0) > 0.0 ? 1 : 0;
    const double cell = 1.0 / scale;
    return erode(labels, 1, opens({0}),
                 {.levels = 2,
                  .step = 5.0,
                  .cell = cell,
                  .x = .5 * cell,
                  .y = .5 * cell,
                  .dx = cell,
                  .dy = cell})
        .labels;
  };
  const Labels coarse = left(1);
  const Labels fine = left(2);
  int differ = 0;
  int all = 0;
  for (const auto [x, y] : test::cells(160, 160)) {
    all += coarse(x, y);
    differ += coarse(x, y) != fine(2 * x, 2 * y) ? 1 : 0;
  }
  EXPECT_GT(all, 1000);
  EXPECT_LT(differ, all / 8);
}

TEST(Erosion, EveryStepIsTold) {
  class Steps : public Progress {
   public:
    void begin(std::string_view, double total) override { asked = total; }
    void advance(double amount) override { done += amount; }
    double asked = 0.0;
    double done = 0.0;
  } steps;
  erode(disc(40, 15.0), 1, opens({0}), {.levels = 3, .step = 2.0}, steps);
  EXPECT_EQ(steps.asked, 3.0);
  EXPECT_EQ(steps.done, 3.0);
}

}  // namespace
}  // namespace belvedere
