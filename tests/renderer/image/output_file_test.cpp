// Files that appear complete or not at all. How writers of pictures handle full disks and forbidden
// folders is tested in image_io_test.cpp.
#include "renderer/image/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "tests/files.h"
#include "tests/small_disk.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class OutputFiles : public testing::Test {
 protected:
  std::string refused(const std::function<void()>& f) const {
    return test::message_of(ErrorKind::output, f);
  }
  test::Folder folder_;
};

TEST_F(OutputFiles, TheOldOneStaysUntilTheNewOneIsWhole) {
  const std::string path = folder_.write("a.tif", "old");
  {
    OutputFile file(path);
    EXPECT_EQ(file.path(), path);
    EXPECT_EQ(file.temporary(), folder_ / "a.tmp.tif") << "of the same ending, in the same folder";
    test::write_bytes(file.temporary(), "new");
    EXPECT_EQ(test::read_bytes(path), "old");
    file.commit();
    EXPECT_EQ(test::read_bytes(path), "new");
  }
  EXPECT_EQ(test::read_bytes(path), "new");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(OutputFiles, WhatIsNotCommittedLeavesNothing) {
  const std::string path = folder_.write("a.tif", "old");
  {
    const OutputFile file(path);
    test::write_bytes(file.temporary(), "half");
  }
  EXPECT_EQ(test::read_bytes(path), "old");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(OutputFiles, AreTriedAtOnce) {
  EXPECT_THAT(refused([&] { OutputFile file(folder_ / "none/a.tif"); }),
              AllOf(HasSubstr("none/a.tif"), HasSubstr("No such file")));
  EXPECT_THAT(refused([&] { OutputFile file(folder_.path() + "/"); }), HasSubstr("is a folder"));
}

TEST_F(OutputFiles, ASecondWriterIsRefusedAndLeavesTheFirstAlone) {
  const std::string path = folder_.write("a.tif", "old");
  {
    OutputFile first(path);
    test::write_bytes(first.temporary(), "first");
    EXPECT_THAT(refused([&] { OutputFile second(path); }),
                AllOf(HasSubstr("a.tif"), HasSubstr("another run is writing")));
    first.commit();
  }
  EXPECT_EQ(test::read_bytes(path), "first");
  // What a killed run left is no lock.
  folder_.write("a.tmp.tif", "half of a file of a run that was killed");
  OutputFile third(path);
  EXPECT_EQ(test::read_bytes(third.temporary()), "");
  third.commit();
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(OutputFiles, AFolderThatDisappearsIsNamed) {
  const std::string path = folder_.write("below/a.tif", "old");
  OutputFile file(path);
  fs::remove_all(folder_ / "below");
  EXPECT_THAT(refused([&] { file.commit(); }),
              AllOf(HasSubstr("below/a.tif"), HasSubstr("No such")));
}

TEST_F(OutputFiles, AFolderOfTheNameIsNotReplaced) {
  fs::create_directories(folder_ / "a.tif");
  {
    OutputFile file(folder_ / "a.tif");
    EXPECT_THAT(refused([&] { file.commit(); }),
                AllOf(HasSubstr("a.tif"), HasSubstr("cannot be replaced")));
  }
  EXPECT_TRUE(fs::is_directory(folder_ / "a.tif"));
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(OutputFiles, AFailureNamesTheFileAndTheFirstReason) {
  const OutputFile file(folder_ / "a.tif");
  EXPECT_THAT(refused([&] { file.fail("strip 3 is bad\nstrip 4 is bad"); }),
              AllOf(HasSubstr("a.tif: cannot be written"), HasSubstr("strip 3"),
                    Not(HasSubstr("a.tmp.tif")), Not(HasSubstr("strip 4"))));
}

TEST_F(OutputFiles, FoldersAreMadeAndLeftEmpty) {
  check_output_folder(folder_ / "new/below");
  EXPECT_TRUE(fs::is_directory(folder_ / "new/below"));
  EXPECT_TRUE(fs::is_empty(folder_ / "new/below"));
  folder_.write("file", "in the way");
  EXPECT_THAT(refused([&] { check_output_folder(folder_ / "file/below"); }),
              HasSubstr("file/below"));
  EXPECT_THAT(refused([&] { check_output_folder("/proc/self"); }), HasSubstr("/proc/self"));
}

TEST(TextFile, IsThereWholeOrNotAtAll) {
  const test::Folder folder;
  const std::string path = folder / "a.txt";
  const std::string text("two\r\nlines\n\0of bytes", 20);
  write_text_file(path, "older and longer than what comes after it");
  write_text_file(path, text);
  std::ostringstream read;
  read << std::ifstream(path, std::ios::binary).rdbuf();
  EXPECT_EQ(read.str(), text);
  EXPECT_EQ(folder.count(), 1U);
  EXPECT_THROW(write_text_file(folder / "missing/a.txt", text), Error);
  for (const rlim_t room : {0, 1, 19}) {
    const test::SmallDisk disk(room);
    EXPECT_THROW(write_text_file(path, text), Error) << room;
    EXPECT_EQ(test::read_bytes(path), text);
    EXPECT_EQ(folder.count(), 1U);
  }
}

}  // namespace
}  // namespace belvedere
