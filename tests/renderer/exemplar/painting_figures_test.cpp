#include "tests/renderer/exemplar/painting_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

using Figures = PaintingFigures;

Grid<glm::vec3> grey_picture(int width, int height, const std::function<double(int, int)>& grey) {
  Grid<glm::vec3> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(x, y) = glm::vec3(static_cast<float>(grey(x, y)));
  return picture;
}

// The mean of `inside` over 4 × 4 positions in a pixel: antialiased edges.
double covered(int x, int y, const std::function<double(double, double)>& inside) {
  double sum = 0.0;
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 4; ++u) sum += inside(x + (u + 0.5) / 4.0, y + (v + 0.5) / 4.0);
  return sum / 16.0;
}

// Opaque strokes of one length and width at random positions, all turned by `angle` from the
// horizontal; a random grey each.
Grid<glm::vec3> thrown_strokes(double length, double width, double angle, int side = 320) {
  Grid<glm::vec3> picture(side, side, glm::vec3(0.5F));
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const int count = static_cast<int>(6.0 * side * side / (length * width));
  const int reach = static_cast<int>(0.5 * (length + width)) + 1;
  for (int k = 0; k < count; ++k) {
    const double cx = random_uniform(5, k, 0, 0) * side;
    const double cy = random_uniform(5, k, 0, 1) * side;
    const auto grey = static_cast<float>(0.3 + 0.4 * random_uniform(5, k, 0, 2));
    for (int y = static_cast<int>(cy) - reach; y <= static_cast<int>(cy) + reach; ++y)
      for (int x = static_cast<int>(cx) - reach; x <= static_cast<int>(cx) + reach; ++x) {
        if (!picture.contains(x, y)) continue;
        const double dx = x + 0.5 - cx;
        const double dy = y + 0.5 - cy;
        if (std::abs(dx * c + dy * s) < 0.5 * length && std::abs(dy * c - dx * s) < 0.5 * width)
          picture(x, y) = glm::vec3(grey);
      }
  }
  return picture;
}

TEST(PaintingFigures, TellHuesByTheirChroma) {
  // Left half a pure red, right half a pale blue of a quarter of its chroma; above them grey, which
  // has no hue.
  Grid<glm::vec3> picture(120, 120, glm::vec3(0.5F));
  for (int y = 60; y < 120; ++y)
    for (int x = 0; x < 120; ++x)
      picture(x, y) = x < 60 ? glm::vec3(0.8F, 0.01F, 0.F) : glm::vec3(0.6F, 0.6F, 0.8F);
  const Figures f = measure_painting(picture);
  EXPECT_NEAR(f.hue_shares[0], 0.8, 1e-4);
  EXPECT_NEAR(f.hue_shares[8], 0.2, 1e-4);
  EXPECT_NEAR(std::accumulate(f.hue_shares.begin(), f.hue_shares.end(), 0.0), 1.0, 1e-9);
  EXPECT_NEAR(f.saturation_mean, 0.25 * 1.0 + 0.25 * 0.25, 1e-4);
  EXPECT_NEAR(f.saturation_spread, std::sqrt(0.25 * 1.0 + 0.25 * 0.0625 - 0.3125 * 0.3125), 1e-4);
}

TEST(PaintingFigures, EachSectorOfHueHasItsPlace) {
  for (int k = 0; k < 12; ++k) {
    const double hue = (30.0 * k + 15.0) / 60.0;
    const auto part = [&](double n) {
      const double t = std::fmod(n + hue, 6.0);
      return static_cast<float>(0.7 - 0.4 * std::max(0.0, std::min({t, 4.0 - t, 1.0})));
    };
    const Figures f =
        measure_painting(Grid<glm::vec3>(96, 96, glm::vec3(part(5.0), part(3.0), part(1.0))));
    EXPECT_NEAR(f.hue_shares[static_cast<std::size_t>(k)], 1.0, 1e-9) << 30 * k + 15 << "°";
  }
}

TEST(PaintingFigures, SharpnessOfHardAndSoftEdgesAndOfGrain) {
  const Figures hard =
      measure_painting(grey_picture(256, 256, [](int x, int) { return x % 64 < 32 ? 0.3 : 0.7; }));
  EXPECT_NEAR(hard.sharpness, 1.0, 0.005);
  EXPECT_NEAR(hard.coarse_sharpness, 1.0, 0.005);
  const Figures soft = measure_painting(grey_picture(256, 256, [](int x, int) {
    const double t = x % 128 < 64 ? x % 128 - 32.0 : 96.0 - x % 128;
    return 0.5 + 0.2 * std::erf(t / (std::sqrt(2.0) * 8.0));
  }));
  EXPECT_NEAR(soft.sharpness, 0.5 * std::log2((64.0 + 4.0) / (64.0 + 1.0)), 0.02);
  const Figures grain = measure_painting(
      grey_picture(256, 256, [](int x, int y) { return 0.5 + 0.1 * random_uniform(3, x, y, 0); }));
  // White noise of blur s: energy of differences (1 - exp(-1 / 4s²)) / s².
  EXPECT_NEAR(grain.sharpness, std::log2(4.0 * (1.0 - std::exp(-0.25)) / (1.0 - std::exp(-0.0625))),
              0.15);
}

TEST(PaintingFigures, SharpnessOfDiscsIsThatOfEdges) {
  const auto disc = [](double x, double y) {
    return std::hypot(std::fmod(x, 64.0) - 32.0, std::fmod(y, 64.0) - 32.0) < 22.0 ? 0.7 : 0.3;
  };
  const Figures f =
      measure_painting(grey_picture(256, 256, [&](int x, int y) { return covered(x, y, disc); }));
  EXPECT_NEAR(f.sharpness, 0.92, 0.05);
}

TEST(PaintingFigures, ContrastChangesNoSharpnessNorStrokes) {
  Grid<glm::vec3> strong = thrown_strokes(20.0, 5.0, 0.4);
  Grid<glm::vec3> weak = strong;
  // Lightness is a power of light near 1/3 and encoding near 1/2.4: over this narrow range they are
  // nearly linear.
  for (auto& p : weak) p = glm::vec3(0.5F) + 0.4F * (p - 0.5F);
  const Figures a = measure_painting(strong);
  const Figures b = measure_painting(weak);
  EXPECT_NEAR(a.sharpness, b.sharpness, 0.03);
  EXPECT_NEAR(a.stroke_length_px, b.stroke_length_px, 0.05 * a.stroke_length_px);
  EXPECT_NEAR(a.stroke_width_px, b.stroke_width_px, 0.05 * a.stroke_width_px);
}

TEST(PaintingFigures, TellLengthAndWidthOfThrownStrokes) {
  for (const double angle : {0.0, 0.5, 1.5708}) {
    const Figures f = measure_painting(thrown_strokes(18.0, 4.0, angle));
    EXPECT_NEAR(f.stroke_length_px, 18.0, 3.6) << angle;
    EXPECT_NEAR(f.stroke_width_px, 4.0, 0.8) << angle;
    EXPECT_GT(f.coherence, 0.6) << angle;
  }
  const Figures longer = measure_painting(thrown_strokes(30.0, 4.0, 0.5));
  EXPECT_GT(longer.stroke_length_px, 23.0);
}

TEST(PaintingFigures, StripesAreEndlessAndThreeQuartersOfTheirWidth) {
  // Their correlation falls linearly, to one half after a quarter of a stripe.
  const auto stripe = [](double x, double y) {
    return std::fmod(x * 0.8 + y * 0.6 + 1000.0, 12.0) < 6.0 ? 0.4 : 0.6;
  };
  const Figures f =
      measure_painting(grey_picture(256, 256, [&](int x, int y) { return covered(x, y, stripe); }));
  EXPECT_NEAR(f.stroke_width_px, 4.5, 0.5);
  EXPECT_EQ(f.stroke_length_px, 120.0);
  EXPECT_GT(f.coherence, 0.97);
  EXPECT_GT(f.direction_run_px, 90.0);  // to the edge of the picture, or 129
}

TEST(PaintingFigures, CirclesTurnWithTheirRadius) {
  // Rings around the centre between radius 28 and 62, which the structure tensor widens by two of
  // its sigmas: the mean of R π / 3 there, with larger radii weighted by their length.
  const Figures f = measure_painting(grey_picture(220, 220, [](int x, int y) {
    const double r = std::hypot(x - 109.5, y - 109.5);
    return r < 28.0 || r > 62.0 ? 0.5 : 0.5 + 0.2 * std::sin(r * 0.9);
  }));
  const double mean_radius =
      (std::pow(68.0, 3.0) - std::pow(22.0, 3.0)) / 3.0 / ((68.0 * 68.0 - 22.0 * 22.0) / 2.0);
  EXPECT_NEAR(f.direction_run_px, mean_radius * 3.14159 / 3.0, 3.5);
}

TEST(PaintingFigures, NoiseHasNoDirection) {
  const Figures f = measure_painting(
      grey_picture(256, 256, [](int x, int y) { return 0.5 + 0.1 * random_uniform(3, x, y, 0); }));
  EXPECT_LT(f.coherence, 0.3);
  EXPECT_LT(f.stroke_length_px, 5.0);
}

TEST(PaintingFigures, UnevennessIsTheSpreadOfContrastInOctaves) {
  const auto noise = [](int x, int y, double contrast) {
    return 0.5 + contrast * (random_uniform(3, x, y, 0) - 0.5);
  };
  const Figures even =
      measure_painting(grey_picture(256, 256, [&](int x, int y) { return noise(x, y, 0.2); }));
  EXPECT_LT(even.unevenness, 0.1);
  // Half of it with a quarter of the contrast: two octaves apart, a deviation of one.
  const Figures uneven = measure_painting(
      grey_picture(256, 256, [&](int x, int y) { return noise(x, y, x < 128 ? 0.2 : 0.05); }));
  EXPECT_NEAR(uneven.unevenness, 1.0, 0.12);
}

TEST(PaintingFigures, FlatIsWhatIsNotPainted) {
  const Figures f = measure_painting(grey_picture(200, 200, [](int x, int y) {
    return x < 50 ? 0.5 : 0.4 + 0.2 * random_uniform(3, x, y, 0);
  }));
  EXPECT_NEAR(f.flat_share, 46.0 / 196.0, 0.003);  // two columns see the noise
  EXPECT_EQ(measure_painting(Grid<glm::vec3>(96, 96, glm::vec3(0.4F))).flat_share, 1.0);
}

TEST(PaintingFigures, ShrinkingKeepsLightAndHalvesStrokes) {
  const auto checker =
      grey_picture(100, 100, [](int x, int y) { return (x + y) % 2 == 0 ? 1.0 : 0.0; });
  const auto half = shrink_picture(checker, 0.5);
  ASSERT_EQ(half.width(), 50);
  EXPECT_NEAR(half(20, 20).x, 0.7354F, 1e-3F);  // half the light, encoded
  const auto odd = shrink_picture(grey_picture(100, 90, [](int, int) { return 0.3; }), 0.37);
  EXPECT_EQ(odd.width(), 37);
  EXPECT_EQ(odd.height(), 33);
  for (const glm::vec3& c : odd) ASSERT_NEAR(c.x, 0.3F, 1e-5F);
  const auto ramp =
      shrink_picture(grey_picture(96, 96, [](int x, int) { return 0.5 + 0.001 * x; }), 1.0 / 3.0);
  EXPECT_NEAR(ramp(10, 5).x, 0.5F + 0.001F * 31.F, 1e-4F);  // the centre of pixels 30, 31, 32
  EXPECT_THROW(shrink_picture(checker, 1.5), Error);
  EXPECT_THROW(shrink_picture(checker, 0.0), Error);
}

TEST(PaintingFigures, RefuseWhatIsTooSmall) {
  EXPECT_THROW(measure_painting(Grid<glm::vec3>(200, 95)), Error);
}

TEST(PaintingFigures, ThreadsChangeNothing) {
  const auto picture = thrown_strokes(12.0, 3.0, 0.7, 200);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return measure_painting(picture);
  };
  const Figures a = run(1);
  const Figures b = run(2);
  EXPECT_EQ(a.sharpness, b.sharpness);
  EXPECT_EQ(a.stroke_length_px, b.stroke_length_px);
  EXPECT_EQ(a.direction_run_px, b.direction_run_px);
  EXPECT_EQ(a.coherence, b.coherence);
  EXPECT_EQ(a.unevenness, b.unevenness);
}

}  // namespace
}  // namespace belvedere
