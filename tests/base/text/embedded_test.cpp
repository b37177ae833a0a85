#include "base/text/embedded.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/files.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Embedded, EveryFileOfTheDataFoldersToTheByte) {
  int files = 0;
  for (const char* folder : {"palettes", "legends", "layers", "sheet", "studio", "pick", "report",
                             "segment", "sources"}) {
    for (const auto& entry :
         fs::directory_iterator(fs::path(test::source_folder()) / "data" / folder)) {
      const std::string name = std::string(folder) + "/" + entry.path().filename().string();
      EXPECT_TRUE(embedded_file(name) == test::read_bytes(entry.path())) << name;
      ++files;
    }
  }
  EXPECT_GT(files, 12);
  EXPECT_TRUE(embedded_file("scenes/demo/demo.toml") ==
              test::read_bytes(test::source_folder() + "/scenes/demo/demo.toml"));
}

TEST(Embedded, NamesOfAFolderAreThoseOfItsFilesInOrder) {
  std::vector<std::string> on_disk;
  for (const auto& entry : fs::directory_iterator(test::source_folder() + "/data/legends"))
    on_disk.push_back(entry.path().stem().string());
  std::sort(on_disk.begin(), on_disk.end());
  EXPECT_EQ(embedded_names("legends"), on_disk);
}

TEST(Embedded, ABeginningOfAFolderIsNoFolder) {
  EXPECT_THAT(embedded_names("legend"), IsEmpty());
  EXPECT_THAT(embedded_names(""), IsEmpty());
  EXPECT_THAT(embedded_names("legends/nlcd.toml"), IsEmpty());
}

TEST(Embedded, UnknownNamesAreABug) {
  EXPECT_THAT(test::message_of(ErrorKind::bug, [] { embedded_file("palettes/mauve.toml"); }),
              HasSubstr("palettes/mauve.toml"));
}

}  // namespace
}  // namespace belvedere
