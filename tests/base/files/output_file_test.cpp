// Files that appear complete or not at all. How writers of pictures handle full disks and forbidden
// folders is tested in image_io_test.cpp.
#include "base/files/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
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
    EXPECT_EQ(fs::path(file.temporary()).parent_path(), folder_.path());
    EXPECT_EQ(fs::path(file.temporary()).extension(), ".tif");
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
}

// A run that is killed leaves its temporary file, which the next one removes.
TEST_F(OutputFiles, WhatAKilledRunLeftIsRemoved) {
  const pid_t child = ::fork();
  if (child == 0) {
    const OutputFile killed(folder_ / "a.tif");
    test::write_bytes(killed.temporary(), "half");
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(folder_.count(), 2U) << "the temporary file and the lock";
  {
    OutputFile next(folder_ / "a.tif");
    EXPECT_EQ(folder_.count(), 2U);
    EXPECT_EQ(test::read_bytes(next.temporary()), "");
    next.commit();
  }
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(OutputFiles, TemporaryNamesAreOfNobody) {
  std::set<std::string> names;
  for (int i = 0; i < 100; ++i) names.insert(OutputFile(folder_ / "a.tif").temporary());
  EXPECT_EQ(names.size(), 100U);
  for (const std::string& name : names) EXPECT_TRUE(fs::path(name).filename().string()[0] == '.');
}

TEST_F(OutputFiles, LinksAreFollowed) {
  const std::string file = folder_.write("repository/scene.toml", "old");
  fs::create_symlink("repository/scene.toml", folder_ / "first.toml");
  fs::create_symlink("first.toml", folder_ / "scene.toml");
  write_text_file(folder_ / "scene.toml", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "scene.toml"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "first.toml"));
  EXPECT_EQ(test::read_bytes(file), "new");
  fs::create_symlink("repository/none.toml", folder_ / "to_nothing.toml");
  write_text_file(folder_ / "to_nothing.toml", "first");
  EXPECT_EQ(test::read_bytes(folder_ / "repository/none.toml"), "first");
}

TEST_F(OutputFiles, ModeAndOwnerStay) {
  const std::string file = folder_.write("private.toml", "old");
  for (const ::mode_t mode : {0600U, 0644U, 0660U, 0755U}) {
    ASSERT_EQ(::chmod(file.c_str(), mode), 0);
    if (::geteuid() == 0) {
      ASSERT_EQ(::chown(file.c_str(), 65534, 65533), 0);
    }
    struct ::stat before {};
    ASSERT_EQ(::stat(file.c_str(), &before), 0);
    write_text_file(file, "new");
    struct ::stat after {};
    ASSERT_EQ(::stat(file.c_str(), &after), 0);
    EXPECT_EQ(after.st_mode, before.st_mode);
    EXPECT_EQ(after.st_uid, before.st_uid);
    EXPECT_EQ(after.st_gid, before.st_gid);
  }
}

TEST_F(OutputFiles, ANewFileHasTheModeOfTheUsersMask) {
  const ::mode_t mask = ::umask(027);
  write_text_file(folder_ / "a.toml", "new");
  ::umask(mask);
  struct ::stat made {};
  ASSERT_EQ(::stat((folder_ / "a.toml").c_str(), &made), 0);
  EXPECT_EQ(made.st_mode & 0777U, 0640U);
}

// Also for root, who may write it.
TEST_F(OutputFiles, AReadOnlyFileIsNotReplaced) {
  const std::string file = folder_.write("a.toml", "old");
  fs::create_symlink("a.toml", folder_ / "link.toml");
  ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
  for (const char* name : {"a.toml", "link.toml"})
    EXPECT_THAT(refused([&] { write_text_file(folder_ / name, "new"); }),
                AllOf(HasSubstr(name), HasSubstr("is read-only"), HasSubstr("chmod u+w")));
  EXPECT_EQ(test::read_bytes(file), "old");
  EXPECT_EQ(folder_.count(), 2U);
}

TEST_F(OutputFiles, ADeviceIsNotReplaced) {
  EXPECT_THAT(refused([] { write_text_file("/dev/null", "new"); }), HasSubstr("is a device"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFiles, ANameOfFullLengthHasATemporaryOne) {
  const std::string name = std::string(251, 'n') + ".txt";
  write_text_file(folder_ / name, "text");
  EXPECT_EQ(test::read_bytes(folder_ / name), "text");
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
                    Not(HasSubstr(".tmp")), Not(HasSubstr("strip 4"))));
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
