// `belvedere lock`, `--locked` and `belvedere verify` as users meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Lock : public Program {
 protected:
  // Hills of a file, in a folder of data; painted in strokes alone.
  void SetUp() override {
    Raster<float> raster{
        Grid<float>(48, 48), {500000.0, 5200000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(48, 48))
      raster.cells(x, y) = static_cast<float>(1000 + (x * 37 + y * 53) % 200);
    fs::create_directories(path("data"));
    write_raster(path("data/dem.tif"), raster);
    write_hills("alps");
  }
  std::string write_hills(const std::string& name, const std::string& more = "") const {
    return write(
        name + ".toml",
        "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n[camera]\nposition = [502400, "
        "5194000]\nheight_m = 4000\n"
        "pitch_deg = -20\n[sampling]\npixel_samples = 1\nshadow_rays = 1\nsky_directions = "
        "0\n[synthesis]\nenabled = false\n"
        "[output]\nwidth = 96\nheight = 64\nsheet_width_mm = 100\nformats = [\"png\", \"tif\"]\n" +
            more);
  }
  Outcome with_data(std::vector<std::string> arguments,
                    const std::vector<std::string>& environment = {}) const {
    arguments.insert(arguments.end(), {"--data", path("data")});
    return run(arguments, environment);
  }
  // A byte of the heights, the file as long as before.
  void change_the_dem() const {
    std::string bytes = read_bytes(path("data/dem.tif"));
    bytes[bytes.size() - 5] ^= 1;
    write("data/dem.tif", bytes);
  }
  std::string alps() const { return path("alps.toml"); }
  std::string lock_text() const { return read_bytes(path("alps.lock")); }
};

TEST_F(Lock, SaysWhatTheSceneWasMadeOfAndVerifyFindsItTheSame) {
  ASSERT_THAT(with_data({"lock", alps(), "--width", "48", "--set", "seed=5"}), Ends(0));
  const std::string text = lock_text();
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("width = 48\nheight = 32\nsettings = [\"seed=5\"]"),
            HasSubstr("file = \"dem.tif\"\nbytes = "), HasSubstr("[products.\"guidance.exr\"]"),
            HasSubstr("\"landcover.id\" = "), HasSubstr("[products.\"panorama.png\"]\n\"R\" = "),
            HasSubstr("[products.\"panorama.tif\"]"), Not(HasSubstr(path("")))));
  // The same again, for any number of threads, with and without an existing lock.
  EXPECT_EQ(with_data({"lock", alps(), "--threads", "1"}, without_cache()).status, 0);
  EXPECT_EQ(lock_text(), text);
  fs::remove(path("alps.lock"));
  ASSERT_EQ(with_data({"lock", alps(), "--width", "48", "--set", "seed=5"}).status, 0);
  EXPECT_EQ(lock_text(), text);

  const Outcome verified = with_data({"verify", alps(), "--out", path("kept")});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  EXPECT_EQ(verified.out, alps() + ": 48×32: the same\n");
  EXPECT_EQ(read_image_info(path("kept/alps/panorama.png")).width, 48);
  EXPECT_EQ(with_data({"render", alps(), "--locked", "--out", path("result")}).status, 0);
}

TEST_F(Lock, ASmallSceneIsLockedAtItsOwnSize) {
  ASSERT_EQ(with_data({"lock", alps()}).status, 0);
  EXPECT_THAT(lock_text(), HasSubstr("width = 96\nheight = 64\nsettings = []"));
}

TEST_F(Lock, ChangedInputsAreRefusedByAllThatAreHeldToTheLock) {
  ASSERT_EQ(with_data({"lock", alps(), "-q"}).status, 0);
  const std::string text = lock_text();
  change_the_dem();
  for (const char* command : {"render", "guidance", "check"}) {
    std::vector<std::string> arguments = {command, alps(), "--locked"};
    if (command != std::string("check"))
      arguments.insert(arguments.end(), {"--out", path("result")});
    const Outcome refused = with_data(arguments);
    EXPECT_EQ(refused.status, 3) << command;
    EXPECT_THAT(refused.err, AllOf(HasSubstr("dem.tif: "), HasSubstr(" in the lock, now "),
                                   HasSubstr("belvedere lock --update " + alps())));
    EXPECT_FALSE(fs::exists(path("result")));
  }
  EXPECT_EQ(with_data({"verify", alps()}).status, 3);
  EXPECT_THAT(with_data({"lock", alps()}),
              Ends(3, AllOf(HasSubstr("dem.tif: "), HasSubstr("--update"), Not(HasSubstr(" s)")))));
  EXPECT_EQ(lock_text(), text);
  ASSERT_EQ(with_data({"lock", alps(), "--update"}).status, 0);
  EXPECT_NE(lock_text(), text);
  EXPECT_EQ(with_data({"verify", alps()}).status, 0);
}

TEST_F(Lock, WithoutALockOrWithABrokenOneNothingIsHeldToIt) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"check", alps(), "--locked"}, {"verify", alps()}}) {
    const Outcome outcome = with_data(arguments);
    EXPECT_EQ(outcome.status, 3);
    EXPECT_THAT(outcome.out + outcome.err,
                AllOf(HasSubstr("alps.lock"), HasSubstr("belvedere lock")));
  }
  EXPECT_EQ(run({"check", "--locked"}).status, 2);  // the demo
  EXPECT_EQ(run({"lock"}).status, 2);
  EXPECT_EQ(run({"verify"}).status, 2);
  write("alps.lock", "version = 1\nprogram = 3\n");
  EXPECT_EQ(with_data({"check", alps(), "--locked"}).status, 3);
  EXPECT_EQ(with_data({"lock", alps(), "-q"}).status, 3);
  EXPECT_EQ(with_data({"lock", alps(), "-q", "--update"}).status, 0);
}

TEST_F(Lock, AChangedSceneAndOtherPixelsAreDifferences) {
  ASSERT_EQ(with_data({"lock", alps(), "-q"}).status, 0);
  write_hills("alps", "[sun]\nazimuth_deg = 90\n");
  const Outcome verified = with_data({"verify", alps()});
  EXPECT_EQ(verified.status, 1) << verified.err;
  EXPECT_THAT(verified.out, AllOf(HasSubstr("guidance.exr ("), HasSubstr("shadow.V"),
                                  HasSubstr("panorama.tif (R G B)"), HasSubstr("the scene, or"),
                                  Not(HasSubstr("altitude.V")), Not(HasSubstr("landcover.id"))));
  EXPECT_EQ(with_data({"check", alps(), "--locked"}).status, 0);  // inputs are the same
  EXPECT_THAT(with_data({"lock", alps()}).err, HasSubstr("the scene with its defaults"));
  write_hills("alps");
  ASSERT_EQ(with_data({"verify", alps()}).status, 0);

  // One hash of one channel; and another version, which alone is only a note.
  std::string text = lock_text();
  const std::size_t program = text.find("program = \"") + 11;
  write("alps.lock", text.replace(program, text.find('"', program) - program, "0.0.1"));
  EXPECT_THAT(with_data({"verify", alps(), "--json"}),
              Prints(AllOf(HasSubstr("\"same\": true"), HasSubstr("locked by version 0.0.1"))));
  EXPECT_THAT(with_data({"lock", alps()}).err, HasSubstr("program: 0.0.1 in the lock"));
  const std::size_t hash = text.find("\"tone.V\" = \"") + 12;
  text[hash] = text[hash] == '0' ? '1' : '0';
  write("alps.lock", text);
  const Outcome one = with_data({"verify", alps()});
  EXPECT_EQ(one.status, 1);
  EXPECT_THAT(one.out, HasSubstr("differs in guidance.exr (tone.V); locked by version 0.0.1"));
}

TEST_F(Lock, ABrokenSceneKeepsNoOtherFromBeingVerified) {
  ASSERT_EQ(with_data({"lock", alps(), "-q"}).status, 0);
  fs::create_directories(path("more"));
  fs::copy_file(alps(), path("more/alps.toml"));
  fs::copy_file(path("alps.lock"), path("more/alps.lock"));
  fs::copy_file(path("alps.lock"), path("bad.lock"));
  const std::string bad = write("bad.toml", "version = 1\nnonsense = 3\n");
  const Outcome verified =
      with_data({"verify", bad, alps(), path("more/alps.toml"), "--junit", path("junit.xml"),
                 "--report", path("page.html"), "--out", path("kept"), "-q"});
  EXPECT_EQ(verified.status, 2) << verified.err;
  EXPECT_EQ(std::count(verified.out.begin(), verified.out.end(), '\n') >= 3, true);
  EXPECT_THAT(verified.out, AllOf(HasSubstr(bad + ": not compared: "), HasSubstr("bad.toml:2:1"),
                                  HasSubstr(alps() + ": 96×64: the same"),
                                  HasSubstr(path("more/alps.toml") + ": 96×64: the same")));
  EXPECT_THAT(read_bytes(path("junit.xml")), HasSubstr("failures=\"0\" errors=\"1\""));
  EXPECT_THAT(read_bytes(path("page.html")), HasSubstr("2 of 3 scenes"));
  EXPECT_TRUE(fs::exists(path("kept/alps/panorama.tif")));
  EXPECT_TRUE(fs::exists(path("kept/alps-2/panorama.tif")));
  // Unwritable results are reported before the work.
  const Outcome nowhere = with_data({"verify", alps(), "--junit", "/proc/self/none/junit.xml"});
  EXPECT_EQ(nowhere.status, 4);
  EXPECT_THAT(nowhere.out, IsEmpty());
}

TEST_F(Lock, NothingStaysInTheFolderForTemporaryFiles) {
  fs::create_directories(path("tmp"));
  const std::vector<std::string> there = {"TMPDIR=" + path("tmp")};
  ASSERT_EQ(run({"lock", alps(), "--data", path("data"), "-q"}, there).status, 0);
  EXPECT_EQ(run({"verify", alps(), "--data", path("data"), "-q"}, there).status, 0);
  EXPECT_TRUE(fs::is_empty(path("tmp")));
  const std::vector<std::string> nowhere = {"TMPDIR=/nowhere"};
  EXPECT_EQ(run({"verify", alps(), "--data", path("data"), "-q"}, nowhere).status, 4);
}

}  // namespace
}  // namespace belvedere
