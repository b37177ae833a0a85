#include "tools/pick/pairs_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "tests/files.h"
#include "tests/tools/pick/picking_world.h"

namespace belvedere::tools {
namespace {

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
