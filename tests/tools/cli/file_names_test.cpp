#include "tools/cli/file_names.h"

#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

TEST(FileNames, NameIsWithoutFolders) {
  EXPECT_EQ(file_name("/a/b/c.tif"), "c.tif");
  EXPECT_EQ(file_name("c.tif"), "c.tif");
}

TEST(FileNames, APlaceIsTriedBeforeTheWork) {
  const test::Folder folder;
  check_place("");
  check_place(folder / "new/out.tif");
  EXPECT_EQ(folder.count(), 1U) << "the folder is made, no file is left in it";
  const std::string file = folder.write("file", "in the way");
  EXPECT_EQ(test::error_of([&] { check_place(file + "/out.tif"); }).kind(), ErrorKind::output);
}

TEST(FileNames, WhatIsReadIsNotWrittenOver) {
  const test::Folder folder;
  const std::string read = folder.write("a/crop.png", "read");
  check_not_read(folder / "a/other.png", "--out", {read, folder / "gone.png", ""});
  check_not_read("", "--page", {read});
  const Error error = test::error_of([&] {
    check_not_read(folder / "a/../a/crop.png", "--out", {"", read});
  });
  EXPECT_EQ(error.kind(), ErrorKind::usage);
  EXPECT_EQ(std::string(error.what()).find("--out"), 0U) << error.what();
}

}  // namespace
}  // namespace belvedere::tools
