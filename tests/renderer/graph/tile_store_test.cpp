#include "renderer/graph/tile_store.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <string>

#include "tests/files.h"

namespace belvedere {
namespace {

// Other behaviour of tile stores is tested by the stages that use them (stage_graph_test.cpp).
TEST(TileStore, AFolderThatCannotBeWrittenIsAnErrorOfTheOutput) {
  const std::string message = test::message_of(ErrorKind::output, [] {
    TileStore::Place scratch{"/proc/nowhere", 0};
    TileStore store(scratch, 10, 10, 8, {1});
    Grid<std::uint8_t> values(8, 8);
    store.put(0, 0, {0, 0, 8, 8}, {plane_of(values)});
  });
  EXPECT_NE(message.find("scratch"), std::string::npos) << message;
}

TEST(TileStore, PlanesAndPlacesThatAreNotTheTilesAreRefused) {
  const test::Folder folder;
  TileStore::Place scratch{folder.path(), 1000};
  TileStore store(scratch, 10, 10, 8, {1});
  Grid<std::uint8_t> wrong(7, 8);
  test::message_of(ErrorKind::bug, [&] { store.put(0, 0, {0, 0, 8, 8}, {plane_of(wrong)}); });
  test::message_of(ErrorKind::bug, [&] { store.put(0, 0, {1, 0, 9, 8}, {plane_of(wrong)}); });
}

class FileBytes : public testing::Test {
 protected:
  void SetUp() override {
    file_ = ::open(std::string(folder_ / "bytes").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  }
  void TearDown() override { ::close(file_); }
  test::Folder folder_;
  int file_ = -1;
};

constexpr std::array<std::byte, 5> word = {std::byte{'w'}, std::byte{'o'}, std::byte{'r'},
                                           std::byte{'d'}, std::byte{'s'}};

TEST_F(FileBytes, ComeBackFromTheirPlace) {
  EXPECT_EQ(write_bytes_at(file_, word.data(), word.size(), 3), 0);
  EXPECT_EQ(write_bytes_at(file_, word.data(), 2, 0), 0);
  EXPECT_EQ(test::read_bytes(folder_ / "bytes"), std::string("wo\0words", 8));
  std::array<std::byte, 3> part{};
  EXPECT_EQ(read_bytes_at(file_, part.data(), part.size(), 4), 0);
  EXPECT_EQ(part, (std::array<std::byte, 3>{word[1], word[2], word[3]}));
  EXPECT_EQ(read_bytes_at(file_, part.data(), 0, 4000), 0);
}

TEST_F(FileBytes, AFileThatEndsTooSoonIsAnError) {
  EXPECT_EQ(write_bytes_at(file_, word.data(), word.size(), 0), 0);
  std::array<std::byte, 3> part{};
  EXPECT_EQ(read_bytes_at(file_, part.data(), part.size(), 3), EIO);
}

TEST_F(FileBytes, TheSystemsErrorsComeThrough) {
  std::array<std::byte, 3> part{};
  EXPECT_EQ(read_bytes_at(-1, part.data(), part.size(), 0), EBADF);
  EXPECT_EQ(write_bytes_at(-1, word.data(), word.size(), 0), EBADF);
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  if (full < 0) GTEST_SKIP() << "there is no /dev/full";
  EXPECT_EQ(write_bytes_at(full, word.data(), word.size(), 0), ENOSPC);
  ::close(full);
}

}  // namespace
}  // namespace belvedere
