#include "tools/studio/job.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere::tools {
namespace {

Job::Report ended(const Job& job) {
  while (job.report().state == Job::State::running) std::this_thread::yield();
  return job.report();
}

TEST(Job, AFailureIsReportedWithItsMessage) {
  Job job("rendering");
  EXPECT_EQ(job.report().state, Job::State::idle);
  job.start("out", {}, [](const auto&) -> std::string {
    throw Error(ErrorKind::input, "/nowhere/terrain.tif", "file not found");
  });
  const Job::Report report = ended(job);
  EXPECT_EQ(report.state, Job::State::failed);
  EXPECT_NE(report.error.find("/nowhere/terrain.tif"), std::string::npos) << report.error;
}

TEST(Job, AResultIsKept) {
  Job job("rendering");
  job.start("out", {}, [](const auto&) -> std::string { return "page"; });
  EXPECT_EQ(ended(job).state, Job::State::done);
  EXPECT_EQ(job.report().result, "page");
  EXPECT_EQ(job.report().folder, "out");
}

// Requests of several connections: each is begun or refused, and a job that ends while the next
// one begins is no harm.
TEST(Job, StartsAtTheSameTimeAreOneAfterTheOther) {
  Job job("rendering");
  std::atomic<int> begun = 0;
  std::atomic<int> refused = 0;
  std::vector<std::thread> pages;
  for (int page = 0; page < 4; ++page)
    pages.emplace_back([&] {
      for (int i = 0; i < 20; ++i) try {
          job.start("out", {}, [](const auto&) -> std::string { return ""; });
          ++begun;
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::usage);
          ++refused;
        }
    });
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(ended(job).state, Job::State::done);
  EXPECT_GE(begun, 1);
  EXPECT_EQ(begun + refused, 80);
}

LoadedScene queue_scene() {
  return test::small_scene({"synthesis.enabled=false", "terrain.synthetic.width=30",
                            "terrain.synthetic.height=28", "terrain.synthetic.cell_m=400",
                            "output.width=600", "output.height=24"});
}

Rung tiled() { return {.name = "tiled", .without = {"strokes"}, .strokes = false}; }

TEST(PictureQueue, PicturesAreThoseOfTheEngine) {
  PictureQueue queue;
  std::vector<std::string> notes;
  std::vector<std::string> stages;
  const LivePicture made = queue.paint(queue_scene(), tiled(), {}, &notes, {},
                                       [&](std::string_view stage) { stages.emplace_back(stage); });
  EXPECT_TRUE(made.colour == LiveView().paint(queue_scene(), tiled(), {}).colour);
  EXPECT_FALSE(stages.empty());
  EXPECT_NE(queue.ground(queue_scene(), {}).dem, nullptr);
}

TEST(PictureQueue, CancelEndsAPictureBetweenTiles) {
  PictureQueue queue;
  int tiles = 0;
  const Error error = test::error_of([&] {
    queue.paint(queue_scene(), tiled(), {}, nullptr, [&](PixelRect, const Grid<glm::vec3>&) {
      ++tiles;
      queue.cancel();
    });
  });
  EXPECT_EQ(error.kind(), ErrorKind::interrupted);
  EXPECT_EQ(error.found(), "superseded");
  EXPECT_EQ(tiles, 1) << "of three";
  queue.paint(queue_scene(), tiled(), {});
}

TEST(PictureQueue, ANewerRequestEndsTheOneBefore) {
  PictureQueue queue;
  std::thread newer;
  const Error error = test::error_of([&] {
    queue.paint(queue_scene(), tiled(), {}, nullptr, [&](PixelRect, const Grid<glm::vec3>&) {
      if (newer.joinable()) return;
      newer = std::thread(
          [&] { EXPECT_TRUE(queue.paint(queue_scene(), tiled(), {}).colour.width() == 600); });
      std::this_thread::sleep_for(std::chrono::milliseconds(200));  // until it has asked
    });
  });
  EXPECT_EQ(error.kind(), ErrorKind::interrupted);
  newer.join();
}

}  // namespace
}  // namespace belvedere::tools
