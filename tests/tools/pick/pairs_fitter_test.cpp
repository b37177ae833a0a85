#include "tools/pick/pairs_fitter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <thread>

#include "base/error.h"
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
  EXPECT_TRUE(terrain->handles.empty()) << "nothing was moved";
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

// Five pairs on a turned mountain tell of it.
TEST_F(PairsFitterTest, GroundThatWasMovedHasAHandle) {
  const DeformHandle turned{.centre = {684000.0, 5255000.0},
                            .move_m = {700.0, -500.0},
                            .rotate_deg = 40.0,
                            .raise_m = 150.0,
                            .radius_m = 4500.0,
                            .core_m = 1800.0};
  std::vector<ControlPair> all = test::painted_cones().pairs;
  for (int i = 0; i < 5; ++i) {
    ControlPair pair;
    pair.position = turned.centre + 1500.0 * glm::dvec2(std::cos(1.2566 * i), std::sin(1.2566 * i));
    pair.altitude_m = measured_altitude_m(test::painted_cones().dem, pair.position).value();
    all.push_back(pair);
  }
  const test::SyntheticView view = test::synthetic_view(ViewKind::cylinder, all);
  const HandleField truth({turned});
  for (ControlPair& pair : all) pair.pixel = test::pixel_of(view, moved_by(truth, pair));
  fitter_.fit(5, all);
  const auto terrain = fitter_.terrain(5);
  ASSERT_NE(terrain, nullptr);
  ASSERT_FALSE(terrain->handles.empty());
  const auto& [handle, pixel] = terrain->handles.front();
  EXPECT_LT(glm::length(handle.centre - turned.centre), turned.radius_m);
  ControlPair centre{.position = handle.centre};
  centre.altitude_m = measured_altitude_m(test::painted_cones().dem, handle.centre).value();
  EXPECT_LT(glm::length(pixel - test::pixel_of(view, moved_by(truth, centre))), 10.0);
  const std::string told = terrain_json(5, terrain.get()).str();
  EXPECT_THAT(told, testing::HasSubstr("turn_deg"));
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

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string no_pairs = "x_px,y_px,lon,lat,name,sure\n";

class PairsSessionTest : public testing::Test {
 protected:
  PairsSession open() const { return {path_, test::picked_px, test::painted_cones().dem}; }
  // The first pairs of the painting.
  static std::vector<ControlPair> pairs(std::size_t count) {
    const std::vector<ControlPair>& all = test::painted_cones().pairs;
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)};
  }
  std::string file() const { return test::read_bytes(path_); }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(fs::path(path_).parent_path()), {}));
  }

  const test::Folder folder_;
  const std::string path_ = folder_ / "pairs.csv";
};

TEST_F(PairsSessionTest, MakesItsFileAndWritesEachChangeAtOnce) {
  PairsSession session = open();
  EXPECT_EQ(file(), no_pairs);
  EXPECT_EQ(session.revision(), 1U);
  for (std::size_t count = 1; count <= 3; ++count) {
    session.change(pairs(count));
    EXPECT_EQ(file(), control_pairs_text(pairs(count)));
    EXPECT_EQ(session.revision(), count + 1);
    EXPECT_EQ(session.pairs().size(), count);
    EXPECT_EQ(files_in_folder(), 1U) << "nothing beside it";
  }
  session.change(pairs(3));
  EXPECT_EQ(session.revision(), 4U) << "nothing has changed";
  // What was written is what `register` reads, to the last digit.
  const std::vector<ControlPair> read = parse_control_pairs(
      file(), "p", test::picked_px, test::painted_cones().dem, {.min_pairs = 3});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read[i].pixel, test::painted_cones().pairs[i].pixel);
    EXPECT_EQ(read[i].position, session.pairs()[i].position);
    EXPECT_EQ(read[i].line, static_cast<int>(i) + 2);
  }
}

TEST_F(PairsSessionTest, UndoAndRedoAreInTheFileToo) {
  // As somebody else writes it.
  test::write_bytes(path_, "name;lat;lon;y_px;x_px\n");
  const std::string theirs = file();
  PairsSession session = open();
  EXPECT_FALSE(session.can_undo());
  session.change(pairs(1));
  session.change(pairs(2));
  session.undo();
  EXPECT_EQ(file(), control_pairs_text(pairs(1)));
  session.undo();
  EXPECT_EQ(file(), theirs) << "to the byte";
  EXPECT_FALSE(session.can_undo());
  session.undo();
  session.redo();
  session.redo();
  EXPECT_EQ(file(), control_pairs_text(pairs(2)));
  EXPECT_FALSE(session.can_redo());
  session.undo();
  session.change(pairs(3));
  EXPECT_FALSE(session.can_redo()) << "another way was taken";
}

TEST_F(PairsSessionTest, WhatTheFileMayNotHaveChangesNothing) {
  PairsSession session = open();
  session.change(pairs(2));
  const std::string before = file();
  std::vector<ControlPair> wrong = pairs(3);
  wrong[2].pixel.x = 1200.5;
  EXPECT_EQ(test::error_of([&] { session.change(wrong); }).kind(), ErrorKind::usage);
  wrong[2] = wrong[0];
  EXPECT_THAT(test::error_of([&] { session.change(wrong); }).what(), HasSubstr("the same pair"));
  EXPECT_EQ(file(), before);
  EXPECT_EQ(session.pairs().size(), 2U);
  EXPECT_EQ(session.revision(), 2U);
}

TEST_F(PairsSessionTest, AFileThatAnotherProgramChangedIsNotWrittenOver) {
  PairsSession session = open();
  session.change(pairs(1));
  const std::string theirs = control_pairs_text(pairs(4));
  test::write_bytes(path_, theirs);
  EXPECT_TRUE(session.is_changed_outside());
  EXPECT_EQ(test::error_of([&] { session.change(pairs(2)); }).kind(), ErrorKind::output);
  EXPECT_EQ(test::error_of([&] { session.undo(); }).kind(), ErrorKind::output);
  EXPECT_EQ(file(), theirs);
  EXPECT_EQ(session.pairs().size(), 1U);
  EXPECT_TRUE(session.can_undo()) << "the step is still there";
  session.reload();
  EXPECT_EQ(session.pairs().size(), 4U);
  EXPECT_FALSE(session.is_changed_outside());
  session.undo();
  EXPECT_EQ(file(), control_pairs_text(pairs(1)));
  test::write_bytes(path_, theirs);
  session.save_over();
  EXPECT_EQ(file(), control_pairs_text(pairs(1)));
}

TEST_F(PairsSessionTest, WhatCannotBeWrittenIsRefused) {
  PairsSession session = open();
  fs::remove(path_);
  fs::create_directory(path_);  // in its place
  EXPECT_EQ(test::error_of([&] { session.change(pairs(1)); }).kind(), ErrorKind::output);
  EXPECT_TRUE(session.pairs().empty());
}

TEST_F(PairsSessionTest, IsOpenOnce) {
  PairsSession session = open();
  EXPECT_THAT(test::error_of([&] { open(); }).what(), HasSubstr("another page"));
  session.change(pairs(1));
  EXPECT_THAT(test::error_of([&] { open(); }).what(), HasSubstr("another page"))
      << "the file is another one after it is written";
}

TEST_F(PairsSessionTest, ColumnsThatWouldBeLostAreRefused) {
  test::write_bytes(path_, "x_px,y_px,lon,lat,name,who\n");
  EXPECT_THAT(test::error_of([&] { open(); }).what(), HasSubstr("column who"));
}

}  // namespace
}  // namespace belvedere::tools
