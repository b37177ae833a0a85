#include <gtest/gtest.h>

#include <string>

#include "base/memory/sanitized.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/counted_memory.h"
#include "tests/grids.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

GuideStack waves(int width, int height, int guides, bool with_depth) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(width, height);
  for (int g = 0; g < guides; ++g)
    stack.guides.push_back({"guide " + std::to_string(g), Grid<std::uint8_t>(width, height)});
  if (with_depth) stack.depth_m = Grid<float>(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    stack.label(x, y) = static_cast<std::uint8_t>((x / 40 + y / 30) % 3);
    for (int g = 0; g < guides; ++g)
      stack.guides[static_cast<std::size_t>(g)].values(x, y) =
          static_cast<std::uint8_t>(x / (g + 1) + y);
    if (with_depth) stack.depth_m(x, y) = static_cast<float>(1000 + 200 * (y / 50));
  }
  return stack;
}

// Memory of synthesis beyond its arguments, bytes.
std::size_t peak_of(int width, int height, int guides, bool with_depth) {
  Exemplar exemplar{
      .name = "noise", .picture = Grid<Rgb8>(96, 96), .guides = waves(96, 96, guides, false)};
  for (std::size_t i = 0; i < exemplar.picture.size(); ++i)
    exemplar.picture[i] = {
        static_cast<std::uint8_t>(random_bits(1, static_cast<std::int64_t>(i), 0)), 90, 40};
  const std::vector<Exemplar> exemplars{exemplar};
  const GuideStack target = waves(width, height, guides, with_depth);
  const test::CountedMemory memory;
  EXPECT_EQ(synthesize(exemplars, target, {}, silent_progress()).width(), width);
  return memory.peak_bytes();
}

TEST(SynthesisMemory, SlopeStaysUnderTheBound) {
#ifdef BELVEDERE_SANITIZED
  GTEST_SKIP() << "sanitizers have memory of their own";
#endif
  struct Case {
    int guides = 0;
    bool with_depth = false;
  };
  for (const Case c : {Case{1, false}, Case{6, true}}) {
    // One thread, so that the peak is the same in each run; the first run allocates what stays,
    // such as tables.
    const ThreadLimit one(1);
    peak_of(64, 64, c.guides, c.with_depth);
    const double small = static_cast<double>(peak_of(192, 192, c.guides, c.with_depth));
    const double large = static_cast<double>(peak_of(448, 384, c.guides, c.with_depth));
    const double slope = (large - small) / (448.0 * 384.0 - 192.0 * 192.0);
    RecordProperty("bytes_per_pixel_x100_" + std::to_string(c.guides),
                   static_cast<int>(100 * slope));
    // The documented bounds are 32 and 40 bytes; tight enough to detect another array of 4 bytes
    // per pixel.
    EXPECT_LE(slope, c.guides == 1 ? 22.0 : 28.0) << c.guides << " guides";
    EXPECT_GE(slope, 12.0) << "nothing was measured";
  }
}

}  // namespace
}  // namespace belvedere
