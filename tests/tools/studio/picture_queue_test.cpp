#include "tools/studio/picture_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "tests/files.h"
#include "tests/scenes.h"

namespace belvedere::tools {
namespace {

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
