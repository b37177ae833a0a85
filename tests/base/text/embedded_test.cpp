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

TEST(Embedded, EveryFileOfDataAndPagesToTheByte) {
  int files = 0;
  const auto look = [&](const std::string& folder, const fs::path& path) {
    for (const auto& entry : fs::directory_iterator(path)) {
      const std::string name = folder + "/" + entry.path().filename().string();
      EXPECT_TRUE(embedded_file(name) == test::read_bytes(entry.path())) << name;
      ++files;
    }
  };
  const fs::path root = test::source_folder();
  for (const char* folder : {"palettes", "legends", "layers", "sheet", "segment", "sources"})
    look(folder, root / "data" / folder);
  for (const char* page : {"studio", "pick", "report", "web"})
    look(page, root / "tools" / page / "page");
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
