#include "renderer/sheet/work_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>

#include "base/error.h"
#include "base/grid.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/small_disk.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

const JobIdentity job{{"scene", "a\nb\\n\tc"}, {"dem.tif", "1234"}};
const PixelRect small_rect{0, 0, 3, 2};

class WorkFolderTest : public testing::Test {
 protected:
  void keep(const WorkFolder& work, std::uint8_t value) {
    Grid<std::uint8_t> values(3, 2, value);
    work.keep("panorama", small_rect, {plane_of(values)});
  }
  test::Folder folder_;
  std::string position_ = folder_ / "out/.belvedere";
};

TEST_F(WorkFolderTest, ARunThatResumesFindsWhatIsWhole) {
  {
    WorkFolder work(position_, job, WorkMode::begin);
    EXPECT_FALSE(work.has("panorama", small_rect));
    keep(work, 1);
    work.keep_bytes("plan", "chosen");
  }
  const WorkFolder again(position_, job, WorkMode::resume);
  EXPECT_TRUE(again.has("panorama", small_rect));
  EXPECT_FALSE(again.has("guidance", small_rect));
  EXPECT_EQ(again.read_bytes("plan"), "chosen");
}

TEST_F(WorkFolderTest, ARunThatBeginsFindsNothing) {
  keep(WorkFolder(position_, job, WorkMode::begin), 1);
  EXPECT_FALSE(WorkFolder(position_, job, WorkMode::begin).has("panorama", small_rect));
}

TEST_F(WorkFolderTest, ADamagedPieceIsRemoved) {
  const WorkFolder work(position_, job, WorkMode::begin);
  keep(work, 1);
  const std::string path = work.path("panorama", small_rect);
  std::string bytes = test::read_bytes(path);
  bytes[bytes.size() - 40] ^= 4;
  test::write_bytes(path, bytes);
  EXPECT_FALSE(work.has("panorama", small_rect));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(WorkFolderTest, AnotherJobsPiecesAreRefusedByName) {
  keep(WorkFolder(position_, job, WorkMode::begin), 1);
  JobIdentity other = job;
  other["dem.tif"] = "9";
  const auto resume = [&] { WorkFolder(position_, other, WorkMode::resume); };
  EXPECT_THAT(test::usage_error(resume), HasSubstr("dem.tif differs"));
  EXPECT_TRUE(WorkFolder(position_, job, WorkMode::resume).has("panorama", small_rect))
      << "and are left alone";
}

// Of a version whose jobs had other entries and whose pieces had another form.
TEST_F(WorkFolderTest, WorkOfAnOlderVersionIsRefusedOrBegunAnew) {
  std::filesystem::create_directories(position_);
  test::write_bytes(position_ + "/job.txt", "belvedere job 0\nscene\ta\nprogram\t0.1.0\n");
  const std::string piece = position_ + "/panorama_0_0.piece";
  test::write_bytes(piece, "belvedere piece 0\nof another form");
  EXPECT_THAT(
      test::usage_error([&] { WorkFolder(position_, job, WorkMode::resume); }),
      testing::AllOf(HasSubstr("dem.tif"), HasSubstr("program"), HasSubstr("without --resume")));
  EXPECT_TRUE(std::filesystem::exists(piece)) << "and is left alone";
  const WorkFolder work(position_, job, WorkMode::begin);
  EXPECT_FALSE(std::filesystem::exists(piece));
  keep(work, 1);
  EXPECT_TRUE(work.has("panorama", small_rect));
}

// An empty or cut list of what the job was made from, as a full disk leaves it, is another job's.
TEST_F(WorkFolderTest, ACutListOfEntriesIsAnotherJobs) {
  keep(WorkFolder(position_, job, WorkMode::begin), 1);
  const std::string whole = test::read_bytes(position_ + "/job.txt");
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    test::write_bytes(position_ + "/job.txt", whole.substr(0, size));
    test::usage_error([&] { WorkFolder(position_, job, WorkMode::resume); });
  }
}

TEST_F(WorkFolderTest, AFullDiskLeavesNothingHalfWritten) {
  for (const rlim_t room : {0, 1, 20}) {
    const test::SmallDisk disk(room);
    EXPECT_THAT(test::message_of(ErrorKind::output, [&] { begin_shared_work(position_, job); }),
                HasSubstr("job.txt"));
    EXPECT_TRUE(std::filesystem::is_empty(position_)) << room;
  }
  begin_shared_work(position_, job);
  const WorkFolder work(position_, job, WorkMode::join);
  for (const rlim_t room : {0, 1, 100}) {
    const test::SmallDisk disk(room);
    EXPECT_THAT(test::message_of(ErrorKind::output, [&] { keep(work, 1); }),
                HasSubstr("panorama_0_0.piece"));
    EXPECT_FALSE(work.has("panorama", small_rect));
  }
  keep(work, 2);
  EXPECT_TRUE(work.has("panorama", small_rect));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(position_),
                          std::filesystem::directory_iterator()),
            2)
      << "the job and one piece";
}

TEST_F(WorkFolderTest, AFolderThatDisappearsIsNamed) {
  const WorkFolder work(position_, job, WorkMode::begin);
  keep(work, 1);
  std::filesystem::remove_all(position_);
  EXPECT_FALSE(work.has("panorama", small_rect));
  EXPECT_THAT(test::message_of(ErrorKind::output, [&] { keep(work, 2); }), HasSubstr("No such"));
  test::input_error([&] { work.read_bytes("plan"); });
}

TEST_F(WorkFolderTest, TheSecondRunIntoAFolderIsRefused) {
  const WorkFolder first(position_, job, WorkMode::begin);
  keep(first, 1);
  for (const WorkMode mode : {WorkMode::begin, WorkMode::resume})
    EXPECT_THAT(test::message_of(ErrorKind::output, [&] { WorkFolder(position_, job, mode); }),
                HasSubstr("another run"));
  EXPECT_TRUE(first.has("panorama", small_rect));
}

TEST_F(WorkFolderTest, ManyMayJoinAPlan) {
  test::usage_error([&] { WorkFolder(position_, job, WorkMode::join); });
  begin_shared_work(position_, job);
  const WorkFolder a(position_, job, WorkMode::join);
  const WorkFolder b(position_, job, WorkMode::join);
  keep(a, 1);
  EXPECT_TRUE(b.has("panorama", small_rect));
  begin_shared_work(position_, job);
  EXPECT_TRUE(b.has("panorama", small_rect)) << "planned again, nothing is lost";
  test::usage_error([&] { begin_shared_work(position_, {{"scene", "other"}}); });
}

TEST_F(WorkFolderTest, ARunThatCameToNothingLeavesNothing) {
  { const WorkFolder work(position_, job, WorkMode::begin); }
  EXPECT_FALSE(std::filesystem::exists(position_));
  {
    const WorkFolder work(position_, job, WorkMode::begin);
    work.keep_bytes("notes", "of headers");
  }
  EXPECT_FALSE(std::filesystem::exists(position_));
}

TEST_F(WorkFolderTest, WhatIsDoneIsRemoved) {
  WorkFolder work(position_, job, WorkMode::begin);
  keep(work, 1);
  work.clear();
  EXPECT_FALSE(std::filesystem::exists(position_));
}

TEST(JobIdentity, ComesBackFromItsText) { EXPECT_EQ(job_from_text(to_text(job)), job); }

TEST(JoinedPieces, RowsOfARegionComeFromAllPiecesThatTouchThem) {
  const test::Folder folder;
  const WorkFolder work(folder / "work", {{"scene", "a"}}, WorkMode::begin);
  Grid<std::uint16_t> sheet(50, 40);
  for (std::size_t i = 0; i < sheet.size(); ++i) sheet[i] = static_cast<std::uint16_t>(i);
  JoinedPieces joined{work, {}, {5, 3, 47, 38}};
  for (const auto [x, y] : test::cells({0, 0, 47, 40}, 16)) {
    const PixelRect piece = intersection(joined.region, {x, y, x + 16, y + 16});
    joined.pieces.push_back(piece);
    Grid<std::uint16_t> own = part_of(sheet, piece);
    work.keep("panorama", piece, {plane_of(own)});
  }
  for (const auto& [y0, y1] : {std::pair{3, 38}, {3, 4}, {14, 33}, {31, 38}}) {
    Grid<std::uint16_t> rows(42, y1 - y0);
    joined.read("panorama", y0, y1, {plane_of(rows)});
    EXPECT_EQ(rows, part_of(sheet, {5, y0, 47, y1}));
  }
  Grid<std::uint16_t> rows(42, 1);
  test::input_error([&] { joined.read("guidance", 3, 4, {plane_of(rows)}); });
}

const JobIdentity scene_job{{"scene", "a"}};
const PixelRect piece_rect{0, 0, 64, 48};
const PixelRect next{64, 0, 128, 48};

std::shared_ptr<Grid<float>> made(float value) {
  return std::make_shared<Grid<float>>(64, 48, value);
}

TEST(PieceWriter, BringsPiecesToDiskAndKeepsTheirValuesUntilThen) {
  const test::Folder folder;
  const WorkFolder work(folder / "work", scene_job, WorkMode::begin);
  {
    PieceWriter writer(work);
    for (const PixelRect& rect : {piece_rect, next}) {
      auto values = made(rect == piece_rect ? 1.F : 2.F);
      writer.keep("panorama", rect, {plane_of(*values)}, values);
    }
    writer.finish();
  }
  EXPECT_TRUE(work.has("panorama", piece_rect));
  Grid<float> read(64, 48);
  read_piece_rows(work.path("panorama", next), work.key("panorama", next), 0, 48, 64,
                  {plane_of(read)});
  EXPECT_EQ(read, *made(2.F));
}

TEST(PieceWriter, WaitsWhenItGoes) {
  const test::Folder folder;
  const WorkFolder work(folder / "work", scene_job, WorkMode::begin);
  {
    auto values = made(1.F);
    PieceWriter writer(work);
    writer.keep("panorama", piece_rect, {plane_of(*values)}, values);
  }
  EXPECT_TRUE(work.has("panorama", piece_rect));
}

TEST(PieceWriter, SaysWhatCouldNotBeWritten) {
  const test::Folder folder;
  const WorkFolder work(folder / "work", scene_job, WorkMode::begin);
  PieceWriter writer(work);
  // Errors of a piece are thrown with the next one, those of the last at the end.
  std::filesystem::remove_all(folder / "work");
  const auto values = made(1.F);
  writer.keep("panorama", piece_rect, {plane_of(*values)}, values);
  test::message_of(ErrorKind::output,
                   [&] { writer.keep("panorama", next, {plane_of(*values)}, values); });
  writer.keep("panorama", next, {plane_of(*values)}, values);
  const std::string message = test::message_of(ErrorKind::output, [&] { writer.finish(); });
  EXPECT_NE(message.find("cannot be created"), std::string::npos) << message;
  writer.finish();
}

}  // namespace
}  // namespace belvedere
