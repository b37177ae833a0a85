#include "base/text/missing_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/files.h"

namespace belvedere {
namespace {

using test::error_of;
using test::Folder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* composed = "Z\u00fcrich.tif";     // ü as one character
constexpr const char* decomposed = "Zu\u0308rich.tif";  // u and a combining mark

TEST(MissingFile, NamesWithOtherCaseAreFoundInEveryFolder) {
  const Folder folder;
  folder.write("Data/Dem.TIF", "x");
  EXPECT_EQ(similar_path(folder / "data/dem.tif"), folder / "Data/Dem.TIF");
  EXPECT_THAT(similar_path_hint(folder / "data/dem.tif"),
              AllOf(HasSubstr("there is \"" + folder / "Data/Dem.TIF"), HasSubstr("case")));
  EXPECT_EQ(similar_path(folder / "data/den.tif"), "");
  EXPECT_EQ(similar_path(folder / "Data/Dem.TIF"), "");
  EXPECT_EQ(similar_path(folder / "\xff"), "");
}

TEST(MissingFile, NamesInAnotherNormalFormAreFoundAndTheirFormIsSaid) {
  const Folder folder;
  folder.write(decomposed, "x");
  EXPECT_EQ(similar_path(folder / composed), folder / decomposed);
  EXPECT_THAT(similar_path_hint(folder / composed), AllOf(HasSubstr("NFD"), HasSubstr("--nfc")));
  std::filesystem::rename(folder / decomposed, folder / composed);
  EXPECT_THAT(similar_path_hint(folder / decomposed), AllOf(HasSubstr("NFC"), HasSubstr("--nfd")));
  // Case and form together are a matter of case.
  EXPECT_THAT(similar_path_hint(folder / "zu\u0308RICH.tif"), HasSubstr("case differ"));
}

// Of several near names the one with the same case comes first.
TEST(MissingFile, TheNearestOfSeveralNamesIsSaid) {
  const Folder folder;
  folder.write("Z\u00dcRICH.tif", "x");
  folder.write(decomposed, "x");
  EXPECT_EQ(similar_path(folder / composed), folder / decomposed);
}

TEST(MissingFile, IsAnErrorOfTheInput) {
  const Folder folder;
  folder.write("Dem.tif", "x");
  const Error error = error_of([&] { require_file(folder / "dem.tif", "a raster"); });
  EXPECT_EQ(error.kind(), ErrorKind::input);
  EXPECT_EQ(error.where(), folder / "dem.tif");
  EXPECT_THAT(error.found(), AllOf(HasSubstr("file not found"), HasSubstr("Dem.tif")));
  EXPECT_EQ(error.allowed(), "a raster");
  EXPECT_THAT(error_of([&] { require_file(folder.path()); }).found(), HasSubstr("is a folder"));
  EXPECT_THAT(error_of([&] { require_file(folder / "other"); }).found(),
              Not(HasSubstr("there is")));
  EXPECT_NO_THROW(require_file(folder / "Dem.tif"));
}

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
