#include "tools/pick/pairs_fitter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "tests/files.h"
#include "tests/tools/pick/picking_world.h"

namespace belvedere::tools {
namespace {

class PairsFitterTest : public testing::Test {
 protected:
  static const std::vector<KnownPlace>& places() {
    static const std::vector<KnownPlace> all = known_places(test::painted_cones().dem, {});
    return all;
  }
  static std::vector<ControlPair> pairs(std::size_t count) {
    const std::vector<ControlPair>& all = test::painted_cones().pairs;
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(count, all.size()))};
  }
  PairsFitter fitter_{{test::painted_cones().dem, places(), test::picked_px, {}}};
};

TEST_F(PairsFitterTest, SaysWhereThePlacesLieAndWhatIsSeen) {
  const std::vector<ControlPair>& all = test::painted_cones().pairs;
  ASSERT_GE(all.size(), 20U);
  fitter_.fit(7, pairs(14));
  const auto fit = fitter_.fitted(7);
  ASSERT_NE(fit, nullptr);
  EXPECT_EQ(fit->revision, 7U);
  EXPECT_EQ(fit->pairs.size(), 14U);
  ASSERT_EQ(fit->places.size(), places().size());
  for (std::size_t k = 14; k < all.size(); ++k) {
    const auto place = nearest_place(places(), all[k].position, 1.0);
    ASSERT_TRUE(place);
    EXPECT_LT(glm::length(fit->places[*place].pixel - all[k].pixel), 1.0) << "not among the pairs";
  }
  const auto terrain = fitter_.terrain(7);
  ASSERT_NE(terrain, nullptr);
  ASSERT_NE(terrain->view, nullptr);
  EXPECT_EQ(terrain->seen.size(), places().size());
  EXPECT_TRUE(std::any_of(terrain->lines.begin(), terrain->lines.end(),
                          [](const DrawnLine& drawn) { return drawn.line.skyline; }));
  // A ridge goes over the summit of each cone that is seen before farther ground.
  const auto nearest_line = [&](glm::dvec2 pixel) {
    double nearest = 1e9;
    for (const DrawnLine& drawn : terrain->lines)
      for (const glm::vec2& point : drawn.line.points)
        nearest = std::min(nearest, glm::length(glm::dvec2(point) - pixel));
    return nearest;
  };
  int on_lines = 0, seen = 0;
  for (std::size_t i = 0; i < places().size(); ++i) {
    const glm::dvec2 at = fit->places[i].pixel;
    if (!terrain->seen[i] || at.x < 5.0 || at.y < 5.0 || at.x > 1195.0 || at.y > 545.0) continue;
    ++seen;
    on_lines += nearest_line(at) < 3.0 ? 1 : 0;
  }
  EXPECT_GT(seen, 10);
  EXPECT_GT(on_lines, seen / 2);
}

TEST_F(PairsFitterTest, FewPairsHaveNoFitAndSomeHaveARoughOne) {
  fitter_.fit(1, pairs(min_fitted_pairs - 1));
  EXPECT_EQ(fitter_.fitted(1), nullptr);
  EXPECT_EQ(fitter_.terrain(1), nullptr);
  EXPECT_EQ(fitter_.latest().fit, nullptr);
  fitter_.fit(2, pairs(min_control_pairs - 1));
  ASSERT_NE(fitter_.fitted(2), nullptr);
  const auto rough = fitter_.terrain(2);
  ASSERT_NE(rough, nullptr);
  EXPECT_EQ(rough->view, nullptr) << "not traced";
  EXPECT_EQ(rough->seen, std::vector<bool>(places().size(), true));
}

TEST_F(PairsFitterTest, TheNewestPairsWin) {
  std::vector<std::thread> waiting;
  std::atomic<int> superseded = 0;
  for (std::uint64_t revision = 1; revision <= 5; ++revision) {
    fitter_.fit(revision, pairs(13));
    waiting.emplace_back([&, revision] {
      try {
        fitter_.terrain(revision);
      } catch (const Error& error) {
        superseded += error.kind() == ErrorKind::interrupted ? 1 : 0;
      }
    });
  }
  fitter_.fit(6, pairs(12));
  EXPECT_EQ(fitter_.fitted(6)->pairs.size(), 12U);
  for (std::thread& thread : waiting) thread.join();
  EXPECT_EQ(superseded, 5);
  EXPECT_EQ(test::kind_of([&] { fitter_.fitted(5); }), ErrorKind::interrupted);
}

TEST_F(PairsFitterTest, EndsAllThatWait) {
  std::thread waiting(
      [&] { EXPECT_EQ(test::kind_of([&] { fitter_.fitted(1); }), ErrorKind::interrupted); });
  fitter_.end();
  waiting.join();
}

TEST_F(PairsFitterTest, PairsThatNoViewShowsAreAnErrorAndTheFitBeforeStays) {
  fitter_.fit(1, pairs(12));
  ASSERT_NE(fitter_.fitted(1), nullptr);
  // One place at many pixels.
  std::vector<ControlPair> one(12, pairs(1).front());
  for (std::size_t i = 0; i < one.size(); ++i) one[i].pixel.x = 100.0 * static_cast<double>(i);
  fitter_.fit(2, one);
  EXPECT_EQ(test::kind_of([&] { fitter_.fitted(2); }), ErrorKind::input);
  ASSERT_NE(fitter_.latest().fit, nullptr);
  EXPECT_EQ(fitter_.latest().fit->revision, 1U) << "goes on proposing";
}

}  // namespace
}  // namespace belvedere::tools
