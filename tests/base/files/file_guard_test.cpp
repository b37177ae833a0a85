// What a run must not replace: inputs, read-only files, files of others in folders of results.
#include "base/files/file_guard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "base/error.h"
#include "base/files/output_file.h"
#include "tests/files.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class FileGuards : public testing::Test {
 protected:
  FileGuards() { file_guard().clear(); }
  ~FileGuards() override { file_guard().clear(); }
  static std::string refused(ErrorKind kind, const std::function<void()>& f) {
    return test::message_of(kind, f);
  }
  // A run of the program that writes files into the folder.
  void write_run(const std::vector<std::string>& names, const std::string& text,
                 bool replace = false) const {
    file_guard().clear();
    file_guard().writes_into(folder_.path(), "--out", replace, names);
    for (const std::string& name : names) write_text_file(folder_ / name, text);
    file_guard().clear();
  }
  test::Folder folder_;
};

TEST_F(FileGuards, AnInputIsNoResultByAnyName) {
  const std::string dem = folder_.write("dem.tif", "cells");
  fs::create_symlink("dem.tif", folder_ / "soft.tif");
  fs::create_hard_link(dem, folder_ / "hard.tif");
  fs::create_directory(folder_ / "below");
  file_guard().reads(dem, "DEM");
  for (const char* name : {"dem.tif", "./dem.tif", "below/../dem.tif", "soft.tif", "hard.tif"}) {
    EXPECT_THAT(refused(ErrorKind::usage,
                        [&] { file_guard().writes(folder_.path() + "/" + name, "--out"); }),
                AllOf(HasSubstr("--out"), HasSubstr(name), HasSubstr("is also an input (DEM)")));
    EXPECT_THAT(refused(ErrorKind::usage, [&] { OutputFile file(folder_.path() + "/" + name); }),
                HasSubstr("is also an input"));
  }
  file_guard().writes(folder_ / "other.tif", "--out");
  EXPECT_EQ(test::read_bytes(dem), "cells");
}

TEST_F(FileGuards, CompanionsOfAnInputAreInputs) {
  file_guard().reads(folder_.write("dem.asc", "cells"), "DEM");
  for (const char* name : {"dem.prj", "dem.asc.aux.xml"}) {
    file_guard().writes(folder_ / name, "--out");  // it is not there
    file_guard().clear();
    folder_.write(name, "more");
    file_guard().reads(folder_ / "dem.asc", "DEM");
    EXPECT_THAT(refused(ErrorKind::usage, [&] { file_guard().writes(folder_ / name, "--out"); }),
                HasSubstr("is also an input"));
    fs::remove(folder_ / name);
    file_guard().clear();
  }
}

TEST_F(FileGuards, AnInputThatIsKnownLaterIsComparedWithTheResults) {
  const std::string dem = folder_.write("dem.tif", "cells");
  file_guard().writes(dem, "OUT");
  EXPECT_THAT(refused(ErrorKind::usage, [&] { file_guard().reads(dem, "terrain.sources.0.file"); }),
              AllOf(HasSubstr("OUT"), HasSubstr("terrain.sources.0.file")));
}

// Systems give the numbers of deleted files to new ones.
TEST_F(FileGuards, AnInputThatIsGoneProtectsNothing) {
  const std::string dem = folder_.write("dem.tif", "cells");
  file_guard().reads(dem, "DEM");
  fs::rename(dem, folder_ / "result.tif");  // another file of the same number
  file_guard().writes(folder_ / "result.tif", "--out");
}

TEST_F(FileGuards, TwoResultsHaveTwoNames) {
  file_guard().writes(folder_ / "new/a.tif", "--out");
  EXPECT_THAT(refused(ErrorKind::usage,
                      [&] { file_guard().writes(folder_ / "new/../new/a.tif", "--match"); }),
              AllOf(HasSubstr("--match"), HasSubstr("also the result of --out")));
}

TEST_F(FileGuards, AFolderKeepsWhatOthersWrote) {
  folder_.write("index.html", "a site");
  EXPECT_THAT(refused(ErrorKind::output, [&] { write_run({"index.html"}, "report"); }),
              AllOf(HasSubstr("index.html"), HasSubstr("was not written by this program"),
                    HasSubstr("--force")));
  EXPECT_EQ(test::read_bytes(folder_ / "index.html"), "a site");
  write_run({"index.html"}, "report", true);
  EXPECT_EQ(test::read_bytes(folder_ / "index.html"), "report");
  write_run({"index.html"}, "again");
  EXPECT_EQ(test::read_bytes(folder_ / "index.html"), "again");
}

TEST_F(FileGuards, AResultThatSomebodyChangedIsTheirs) {
  write_run({"panorama.psd"}, "layers");
  test::write_bytes(folder_ / "panorama.psd", "Layers");
  EXPECT_THAT(refused(ErrorKind::output, [&] { write_run({"panorama.psd"}, "new"); }),
              AllOf(HasSubstr("panorama.psd"), HasSubstr("was changed since")));
  EXPECT_EQ(test::read_bytes(folder_ / "panorama.psd"), "Layers");
}

TEST_F(FileGuards, ACopyWithOtherTimesIsKnownByItsContent) {
  write_run({"a.csv"}, "table");
  fs::last_write_time(folder_ / "a.csv", fs::file_time_type::clock::now() + std::chrono::hours(1));
  write_run({"a.csv"}, "other");
  EXPECT_EQ(test::read_bytes(folder_ / "a.csv"), "other");
}

TEST_F(FileGuards, AFileThatAppearsDuringTheWorkIsKept) {
  file_guard().writes_into(folder_.path(), "--out", false, {{"a.csv"}});
  folder_.write("later.csv", "mine");
  EXPECT_THAT(refused(ErrorKind::output, [&] { write_text_file(folder_ / "later.csv", "new"); }),
              HasSubstr("later.csv"));
  EXPECT_EQ(test::read_bytes(folder_ / "later.csv"), "mine");
}

// A folder whose names are not known before: any page or picture in it.
TEST_F(FileGuards, AFolderOfPagesIsOfTheProgramAlone) {
  const auto begin = [&] { file_guard().writes_into(folder_.path(), "--report", false); };
  folder_.write("notes.odt", "no page");
  begin();
  write_text_file(folder_ / "index.html", "page");
  fs::create_directory(folder_ / "tiles");
  write_text_file(folder_ / "tiles/0.jpg", "tile");
  file_guard().clear();
  begin();
  file_guard().remove_own(folder_ / "tiles");
  EXPECT_FALSE(fs::exists(folder_ / "tiles/0.jpg"));
  folder_.write("tiles/mine.jpg", "a photograph");
  file_guard().remove_own(folder_ / "tiles");
  EXPECT_THAT(refused(ErrorKind::output, begin), HasSubstr("tiles/mine.jpg"));
}

TEST_F(FileGuards, AKilledRunLeavesItsOlderResultsKnown) {
  write_run({"a.csv"}, "old");
  file_guard().writes_into(folder_.path(), "--out", false, {{"a.csv"}});
  test::write_bytes(folder_ / "prepared", "never renamed");
  file_guard().record(folder_ / "a.csv", folder_ / "prepared");
  write_run({"a.csv"}, "new");
  EXPECT_EQ(test::read_bytes(folder_ / "a.csv"), "new");
}

TEST_F(FileGuards, TheNewestRunCounts) {
  const std::vector<std::string> names = {"panorama.tif", "panorama.png"};
  folder_.write("panorama.tif", "by an older program");
  EXPECT_THAT(newest_results(folder_.path(), names), ElementsAre("panorama.tif"));
  write_run(names, "summer", true);
  EXPECT_THAT(newest_results(folder_.path(), names), ElementsAre("panorama.tif", "panorama.png"));
  write_run({"panorama.png"}, "winter");
  write_run({"labels.svg"}, "names");
  EXPECT_THAT(newest_results(folder_.path(), names), ElementsAre("panorama.png"));
}

TEST_F(FileGuards, TheRecordDoesNotGrow) {
  for (int i = 0; i < 20; ++i) write_run({"a.csv", "b.csv"}, std::to_string(i));
  EXPECT_LT(fs::file_size(folder_ / ".belvedere_results"), 1000U);
}

TEST_F(FileGuards, FoldersAreMadeAndLeftEmpty) {
  check_output_folder(folder_ / "new/below");
  EXPECT_TRUE(fs::is_directory(folder_ / "new/below"));
  EXPECT_TRUE(fs::is_empty(folder_ / "new/below"));
  folder_.write("file", "in the way");
  EXPECT_THAT(refused(ErrorKind::output, [&] { check_output_folder(folder_ / "file/below"); }),
              HasSubstr("file/below"));
  EXPECT_THAT(refused(ErrorKind::output, [&] { check_output_folder("/proc/self"); }),
              HasSubstr("/proc/self"));
}

}  // namespace
}  // namespace belvedere
