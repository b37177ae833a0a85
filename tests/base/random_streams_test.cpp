#include "base/random_streams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace belvedere {
namespace {

constexpr auto streams = static_cast<std::uint16_t>(Stream::count);

// Seeds of all streams and some of their parts, of pictures 0…1000.
std::vector<std::uint64_t> all_seeds(std::uint64_t pictures) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t picture = 0; picture <= pictures; ++picture)
    for (std::uint16_t stream = 0; stream < streams; ++stream)
      for (std::uint64_t part = 0; part < 3; ++part)
        seeds.push_back(stream_seed(picture, static_cast<Stream>(stream), part));
  return seeds;
}

// Adding stream numbers to seeds would fail: stream 7 of seed 3 would equal stream 6 of seed 4.
TEST(RandomStreams, NoTwoAreTheSameForAnySeedOrPart) {
  std::vector<std::uint64_t> seeds = all_seeds(1000);
  const std::size_t count = seeds.size();
  EXPECT_EQ(count, 1001U * streams * 3U);
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  EXPECT_EQ(seeds.size(), count);
}

// Streams of neighbouring seeds are uncorrelated: correlation of n draws is below 4 / √n.
TEST(RandomStreams, NeighboursDoNotGoTogether) {
  constexpr int draws = 4096;
  const auto correlation = [](std::uint64_t a, std::uint64_t b) {
    double sum = 0.0;
    for (int k = 0; k < draws; ++k)
      sum += (random_uniform(a, k, 0) - 0.5) * (random_uniform(b, k, 0) - 0.5);
    return 12.0 * sum / draws;
  };
  const std::uint64_t here = stream_seed(7, Stream::wash);
  EXPECT_NEAR(correlation(here, here), 1.0, 0.06);
  EXPECT_NEAR(correlation(here, stream_seed(8, Stream::wash)), 0.0, 4.0 / 64.0);
  EXPECT_NEAR(correlation(here, stream_seed(7, Stream::meadow)), 0.0, 4.0 / 64.0);
  EXPECT_NEAR(correlation(here, stream_seed(7, Stream::wash, 1)), 0.0, 4.0 / 64.0);
}

}  // namespace
}  // namespace belvedere
