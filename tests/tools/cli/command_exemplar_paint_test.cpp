// `belvedere exemplar paint` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "renderer/image/guidance_io.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::HasSubstr;

class ExemplarPaint : public Program {
 protected:
  std::string write_plan() const {
    return write("plan.toml",
                 "width = 256\nheight = 256\ncolumns = 1\ndots_per_inch = 25.4\nscene = "
                 "\"\"\"\nversion = 1\n" +
                     test::small_mountains + "\"\"\"\n[[panels]]\nname = \"one\"\n");
  }
};

TEST_F(ExemplarPaint, WritesAPaintingWithAllThatIsKnownOfIt) {
  ASSERT_THAT(run({"exemplar", "paint", "--plan", write_plan(), "--season", "winter", "--out",
                   path("sheet")}),
              Prints(HasSubstr("minimum counts are not met")));
  for (const char* file : {"painting.tif", "ground.tif", "painting.png", "guidance.exr",
                           "sheet.toml", "coverage.json"})
    EXPECT_TRUE(std::filesystem::exists(path(std::string("sheet/") + file))) << file;
  EXPECT_THAT(read_bytes(path("sheet/sheet.toml")), HasSubstr("palette = \"winter\""));
  const ImageInfo info = read_image_info(path("sheet/ground.tif"));
  EXPECT_EQ(info.notes.at("belvedere:layer"), "ground");
  EXPECT_FALSE(info.icc_profile.empty());
  EXPECT_EQ(info.parts.at(0).channels.at(0).type, ChannelType::uint16);
  const GuidanceBuffers guidance = read_guidance(path("sheet/guidance.exr"));
  EXPECT_FALSE(guidance.painted_class.empty());
  EXPECT_FALSE(guidance.stroke.empty());
  EXPECT_FALSE(guidance.tone.empty());
  EXPECT_FALSE(guidance.base.empty());
}

TEST_F(ExemplarPaint, PaintsASceneThatCanBePaintedAgain) {
  ASSERT_THAT(run({"exemplar", "paint", write_scene_file(), "--season", "autumn", "--seed", "5",
                   "--out", path("a"), "--json"}),
              Prints(HasSubstr("\"by_tone_and_distance\"")));
  EXPECT_THAT(read_bytes(path("a/scene.toml")), HasSubstr("palette = \"autumn\""));
  ASSERT_EQ(run({"exemplar", "paint", path("a/scene.toml"), "--out", path("b"), "--threads", "1",
                 "--tile", "16"},
                without_cache())
                .status,
            0);
  for (const char* file : {"painting.tif", "ground.tif", "guidance.exr", "coverage.json"})
    EXPECT_TRUE(read_bytes(path(std::string("a/") + file)) ==
                read_bytes(path(std::string("b/") + file)))
        << file;
}

TEST_F(ExemplarPaint, APanoramaCopiesIt) {
  ASSERT_EQ(run({"exemplar", "paint", write_scene_file(), "--out", path("a"), "-q"}).status, 0);
  const std::string scene =
      write("copy.toml",
            "version = 1\n" + test::small_mountains +
                "[[exemplar]]\npicture = \"a/ground.tif\"\nguidance = "
                "\"a/guidance.exr\"\n[output]\nwidth = 96\nheight = 64\nsheet_width_mm = 96\n");
  ASSERT_THAT(run({"render", scene, "--out", path("copy")}), Ends(0));
  // The same view copied from itself, with the same trees on it: most pixels are their own, and the
  // others differ by little.
  const Grid<glm::vec3> copied = read_picture(path("copy/panorama.tif"));
  const Grid<glm::vec3> painted = read_picture(path("a/painting.tif"));
  double sum = 0.0;
  std::ptrdiff_t same = 0;
  for (std::size_t i = 0; i < copied.size(); ++i) {
    sum += static_cast<double>(std::abs(copied[i].y - painted[i].y));
    same += glm::length(copied[i] - painted[i]) < 0.01F ? 1 : 0;
  }
  EXPECT_LT(sum / static_cast<double>(copied.size()), 0.012);
  EXPECT_GT(static_cast<double>(same) / static_cast<double>(copied.size()), 0.5);
}

TEST_F(ExemplarPaint, FullDiskAndInterruptionKeepTheOldSheetWhole) {
  const std::string plan = write_plan();
  ASSERT_EQ(run({"exemplar", "paint", "--plan", plan, "--out", path("a"), "-q"}).status, 0);
  const std::vector<const char*> files = {"painting.tif", "ground.tif", "painting.png",
                                          "guidance.exr", "sheet.toml", "coverage.json"};
  std::vector<std::string> old;
  for (const char* file : files) old.push_back(read_bytes(path(std::string("a/") + file)));
  const auto expect_whole = [&] {
    for (std::size_t i = 0; i < files.size(); ++i)
      EXPECT_TRUE(read_bytes(path(std::string("a/") + files[i])) == old[i]) << files[i];
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(path("a")), {}), 7)
        << "a temporary file is left beside six files and their record";
  };
  const std::vector<std::string> again = {"exemplar", "paint",  "--plan", plan,
                                          "--season", "winter", "--out",  path("a")};
  // A limit of file sizes stands for the full disk.
  const Outcome full = run_prepared(again, [] {
    const rlimit bytes{8000, 8000};
    setrlimit(RLIMIT_FSIZE, &bytes);
  });
  EXPECT_EQ(full.status, 4) << full.err;
  EXPECT_THAT(full.err, HasSubstr("guidance.exr"));
  expect_whole();
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start(again);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));  // it takes seconds
    kill(child, signal);
    const Outcome stopped = finish(child);
    EXPECT_TRUE(stopped.status == 75 || stopped.status == 1000 + signal)
        << stopped.status;  // before it listens, the signal ends it
    expect_whole();
  }
}

TEST_F(ExemplarPaint, RefusesWhatDoesNotGoTogether) {
  const std::string scene = write_scene_file();
  EXPECT_EQ(run({"exemplar", "paint", scene, "--size", "512", "--out", path("x")}).status, 2);
  EXPECT_EQ(run({"exemplar", "paint", scene, "--plan", write_plan(), "--out", path("x")}).status,
            2);
  EXPECT_EQ(run({"exemplar", "paint", "--set", "output.width=100", "--out", path("x")}).status, 2);
  EXPECT_EQ(
      run({"exemplar", "paint", "--plan", write_plan(), "--season", "spring", "--out", path("x")})
          .status,
      2);
  EXPECT_EQ(
      run({"exemplar", "paint", "--plan", write("bad.toml", "rows = 3\n"), "--out", path("x")})
          .status,
      2);
  EXPECT_EQ(run({"exemplar", "paint"}).status, 2);  // --out is required
  // A seed that sheet.toml could not hold, or below 0.
  for (const char* seed : {"9007199254740992", "-1"})
    EXPECT_EQ(run({"exemplar", "paint", "--plan", write_plan(), "--seed", seed, "--out", path("x")})
                  .status,
              2)
        << seed;
  EXPECT_FALSE(std::filesystem::exists(path("x/painting.tif")));
  EXPECT_THAT(run({"exemplar", "paint", "--plan", write_plan(), "--out",
                   write("file", "in the way") + "/below"}),
              Ends(4, ::testing::AllOf(HasSubstr("file/below"),
                                       ::testing::Not(HasSubstr(" s)")))));  // before any work
}

}  // namespace
}  // namespace belvedere
