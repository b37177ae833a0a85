#include "base/text/archive_kind.h"

#include <gtest/gtest.h>

#include "tests/files.h"

namespace belvedere {
namespace {

TEST(ArchiveKind, IsKnownByItsFirstBytes) {
  const test::Folder folder;
  const auto kind = [&](const std::string& bytes) {
    return archive_kind(folder.write("download.tif", bytes));
  };
  EXPECT_EQ(kind("PK\x03\x04 and more"), "a zip archive");
  EXPECT_EQ(kind("\x1f\x8b\x08"), "a gzip archive");
  EXPECT_EQ(kind("7z\xbc\xaf\x27\x1c"), "a 7-Zip archive");
  EXPECT_EQ(kind("Rar!\x1a\x07\x01"), "a RAR archive");
  EXPECT_EQ(kind("BZh91AY"), "a bzip2 archive");
  EXPECT_EQ(kind("\xfd"
                 "7zXZ"),
            "an xz archive");
  EXPECT_EQ(kind(std::string(257, 'n') + "ustar"), "a tar archive");
  EXPECT_EQ(kind("II*"), "");
  EXPECT_EQ(kind(""), "");
  EXPECT_EQ(archive_kind(folder / "none"), "");
}

}  // namespace
}  // namespace belvedere
