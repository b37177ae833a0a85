#include "tools/cli/file_names.h"

#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

TEST(FileNames, EndingIsInSmallLetters) {
  EXPECT_EQ(ending_of("a/b.TIF"), ".tif");
  EXPECT_EQ(ending_of("a.b/c"), "");
  EXPECT_EQ(ending_of("x.tar.GZ"), ".gz");
  EXPECT_EQ(ending_of("x.ÄÖ"), ".ÄÖ") << "letters of other alphabets are left alone, whatever the locale";
}

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

}  // namespace
}  // namespace belvedere::tools
