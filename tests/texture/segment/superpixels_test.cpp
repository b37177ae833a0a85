#include "texture/segment/superpixels.h"

#include <gtest/gtest.h>

#include <set>

#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

// Three flat regions with crooked borders.
int region(int x, int y) { return y < 30 + (x / 7) % 3 ? 0 : (x < 70 ? 1 : 2); }
Grid<glm::vec3> flat_regions(int width, int height) {
  const glm::vec3 colours[3] = {{.8F, 0.F, -.1F}, {.4F, .1F, .1F}, {.4F, -.1F, .1F}};
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) out(x, y) = colours[region(x, y)];
  return out;
}

Grid<glm::vec3> noise(int width, int height) {
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        out(x, y)[c] =
            static_cast<float>(random_index(1000, static_cast<std::uint64_t>(c), x / 3, y / 3)) /
            1000.F;
  return out;
}

TEST(Superpixels, FlatRegionsAreFoundToThePixel) {
  const Grid<glm::vec3> picture = flat_regions(120, 90);
  const Superpixels found = find_superpixels(picture, {.count = 3, .cells = 300, .blur_px = 0.0});
  ASSERT_EQ(found.count, 3U);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) EXPECT_EQ(found.of(x, y), region(x, y)) << x << " " << y;
}

TEST(Superpixels, PiecesAreConnectedCountedAndInOrder) {
  const Superpixels found = find_superpixels(noise(90, 70), {.count = 40, .cells = 200});
  EXPECT_EQ(found.count, 40U);
  // As many connected pieces as there are numbers.
  Grid<int> met(90, 70, 0);
  std::size_t connected = 0;
  std::uint16_t next = 0;
  for (int y = 0; y < 70; ++y)
    for (int x = 0; x < 90; ++x) {
      if (met(x, y) != 0) continue;
      EXPECT_EQ(found.of(x, y), next++);
      ++connected;
      std::vector<std::pair<int, int>> open = {{x, y}};
      while (!open.empty()) {
        const auto [px, py] = open.back();
        open.pop_back();
        if (!met.contains(px, py) || met(px, py) != 0 || found.of(px, py) != found.of(x, y))
          continue;
        met(px, py) = 1;
        for (const auto& [dx, dy] :
             {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
          open.emplace_back(px + dx, py + dy);
      }
    }
  EXPECT_EQ(connected, found.count);
}

TEST(Superpixels, OneColourAndFewPixels) {
  EXPECT_EQ(find_superpixels(Grid<glm::vec3>(40, 40, glm::vec3(.5F)), {.count = 12}).count, 12U);
  const Superpixels tiny = find_superpixels(flat_regions(3, 2), {.count = 400, .blur_px = 0.0});
  EXPECT_LE(tiny.count, 6U);
  EXPECT_GE(tiny.count, 1U);
}

TEST(Superpixels, SameForAnyThreads) {
  const auto made = [](int threads) {
    const ThreadLimit limit(threads);
    return find_superpixels(noise(100, 80), {}).of;
  };
  EXPECT_EQ(made(1), made(2));
}

}  // namespace
}  // namespace belvedere
