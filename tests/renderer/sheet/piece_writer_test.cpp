#include "renderer/sheet/piece_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "base/error.h"
#include "tests/files.h"

namespace belvedere {
namespace {

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
