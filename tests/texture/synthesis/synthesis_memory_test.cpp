#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string>

#include "base/random.h"
#include "texture/synthesis/synthesize.h"

namespace belvedere {
namespace {

// A figure of /proc/self/status in bytes, 0 where there is none.
std::size_t status(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, name.size() + 1, name + ":") == 0) return 1024 * std::stoull(line.substr(name.size() + 1));
  }
  return 0;
}

GuideStack waves(int width, int height, int guides, bool with_depth) {
  GuideStack stack;
  stack.label = Grid<std::uint8_t>(width, height);
  for (int g = 0; g < guides; ++g) stack.guides.push_back({"guide " + std::to_string(g), Grid<std::uint8_t>(width, height)});
  if (with_depth) stack.depth_m = Grid<float>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      stack.label(x, y) = static_cast<std::uint8_t>((x / 40 + y / 30) % 3);
      for (int g = 0; g < guides; ++g) stack.guides[static_cast<std::size_t>(g)].values(x, y) = static_cast<std::uint8_t>(x / (g + 1) + y);
      if (with_depth) stack.depth_m(x, y) = static_cast<float>(1000 + 200 * (y / 50));
    }
  }
  return stack;
}

// Bytes that synthesis takes beyond its arguments.
std::size_t peak_of(int width, int height, int guides, bool with_depth) {
  Exemplar exemplar;
  exemplar.name = "noise";
  exemplar.guides = waves(96, 96, guides, false);
  exemplar.picture = Grid<Rgb8>(96, 96);
  for (std::size_t i = 0; i < exemplar.picture.size(); ++i) {
    exemplar.picture[i] = {static_cast<std::uint8_t>(random_bits(1, static_cast<std::int64_t>(i), 0)), 90, 40};
  }
  const std::vector<Exemplar> exemplars{exemplar};
  const GuideStack target = waves(width, height, guides, with_depth);
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak begins anew
  const std::size_t before = status("VmRSS");
  const MatchField field = synthesize(exemplars, target, {}, silent_progress());
  EXPECT_EQ(field.width(), width);
  return status("VmHWM") - before;
}

TEST(SynthesisMemory, SlopeStaysUnderTheBound) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep freed memory";
#endif
  if (status("VmHWM") == 0 || !std::ofstream("/proc/self/clear_refs")) GTEST_SKIP() << "no /proc/self to ask";
  mallopt(M_MMAP_THRESHOLD, 1 << 16);  // freed arrays go back to the system at once
  struct Case {
    int guides = 0;
    bool with_depth = false;
  };
  for (const Case c : {Case{1, false}, Case{6, true}}) {
    // Of three, after one that makes what stays: threads, tables. What threads hold at a moment differs by a byte a pixel.
    peak_of(256, 256, c.guides, c.with_depth);
    std::array<double, 3> slopes{};
    for (double& measured : slopes) {
      const double small = static_cast<double>(peak_of(256, 256, c.guides, c.with_depth));
      const double large = static_cast<double>(peak_of(640, 512, c.guides, c.with_depth));
      measured = (large - small) / (640.0 * 512.0 - 256.0 * 256.0);
    }
    std::sort(slopes.begin(), slopes.end());
    const double slope = slopes[1];
    RecordProperty("bytes_per_pixel_x100_" + std::to_string(c.guides), static_cast<int>(100 * slope));
    // Promised are 32 and 40 bytes. In a process of its own, as ctest runs it, 20.8 and 30.2 … 31.0 were measured: there the bound is so
    // tight that a further array of 4 bytes a pixel shows. What other tests left in the heap blurs that by up to 4 bytes.
    const bool alone = testing::UnitTest::GetInstance()->test_to_run_count() == 1;
    EXPECT_LE(slope, alone ? (c.guides == 1 ? 22.0 : 32.0) : (c.guides == 1 ? 32.0 : 40.0)) << c.guides << " guides";
    EXPECT_GE(slope, 12.0) << "nothing was measured";
    const auto estimate = [&](std::size_t pixels) { return static_cast<double>(synthesis_bytes(0, pixels, c.guides, c.with_depth)); };
    EXPECT_LE(slope, (estimate(2000000) - estimate(1000000)) / 1e6) << "synthesis_bytes says too little";
  }
}

// The largest print that is promised: 20000 × 8000 pixels from three exemplars of 4 million texels, inputs and result included.
TEST(SynthesisMemory, LargestPrintFitsInto8GiB) {
  const std::size_t pixels = 20000ULL * 8000;
  const std::size_t texels = 3 * 4000000ULL;
  for (const int guides : {1, 6}) {
    const std::size_t inputs = (1 + static_cast<std::size_t>(guides)) * pixels + (4 + static_cast<std::size_t>(guides)) * texels;
    EXPECT_LT(synthesis_bytes(texels, pixels, guides, true) + inputs + 4 * pixels, std::size_t{8} << 30)
        << guides << " guides, with depths";
  }
}

}  // namespace
}  // namespace belvedere
