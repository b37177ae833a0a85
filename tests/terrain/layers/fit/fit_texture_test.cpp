#include "terrain/layers/fit/fit_texture.h"
#include "terrain/layers/fit/textured_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/filter.h"
#include "base/grid.h"
#include "base/random.h"
#include "terrain/layers/fit/picture_sun.h"
#include "terrain/layers/layer_noise.h"
#include "terrain/layers/layer_picture.h"
#include "tests/terrain/layers/fit/synthetic_picture.h"

namespace belvedere {
namespace {

constexpr int side = 128;  // cells of 30 m
constexpr int finer = 8;
const GeoTransform picture_cells{500'000.0, 5'200'000.0, 30.0, 30.0};

// Cells as the areas that they are: means of finer ones.
Grid<float> area_means(const Grid<float>& fine, int factor) {
  Grid<float> means(fine.width() / factor, fine.height() / factor, 0.F);
  for (int y = 0; y != means.height() * factor; ++y)
    for (int x = 0; x != means.width() * factor; ++x)
      means(x / factor, y / factor) += fine(x, y) / static_cast<float>(factor * factor);
  return means;
}

Grid<float> noise_field(const LayerNoise& noise, std::uint64_t seed) {
  const PixelRect all{0, 0, side * finer, side * finer};
  const GeoTransform cells{picture_cells.origin_x, picture_cells.origin_y,
                           picture_cells.cell_x / finer, picture_cells.cell_y / finer};
  LayerNoiseRows rows(noise, seed, cells, all);
  Grid<float> field(all.width(), all.height());
  for (int y = 0; y != field.height(); ++y) rows.fill(y, field.row(y));
  return field;
}

struct Imagery {
  Dem dem;
  KnownGround ground;
};

// Steppe below, green land above, of the same lightness, each between two hues by noise of a gain.
Imagery imagery(double gain) {
  Imagery made;
  made.dem.altitude_m = synthetic::hills(side, side, 5, 1500.0);
  made.dem.filled = Grid<std::uint8_t>(side, side, 0);
  made.dem.transform = picture_cells;
  KnownGround& ground = made.ground;
  ground.cell_m = 30.0;
  ground.altitude_m = made.dem.altitude_m;
  ground.input_names = {"altitude"};
  ground.inputs = {ground.altitude_m};
  ground.classes = {{"steppe", std::nullopt, 0x808080}, {"green", std::nullopt, 0x808080}};
  const Grid<float> texture = area_means(noise_field({240.0, 6, 1.0, 0.0, gain}, 77), finer);
  Grid<glm::vec3> rgb(side, side);
  for (std::size_t i = 0; i != rgb.size(); ++i) {
    const bool high = ground.altitude_m[i] > 0.F;
    ground.labels.push_back(high ? 1 : 0);
    const glm::vec3 mean = high ? glm::vec3(90.F, 140.F, 100.F) : glm::vec3(140.F, 110.F, 80.F);
    rgb[i] = mean + 60.F * texture[i] * glm::vec3(1.F, 0.8F, 0.3F);
  }
  ground.picture = FitPicture{rgb, 140.0};
  return made;
}

struct Fitted {
  SurfaceLayers plain;
  SurfaceLayers textured;
};
Fitted fitted(const Imagery& made) {
  const GroundFit fit = fit_ground(made.ground, {});
  SurfaceLayers plain = surface_layers_of(made.ground, fit, "test");
  return {plain, with_textures(plain, made.ground, fit,
                               class_textures(made.ground, fit, predict_ground(made.ground, fit)))};
}

Grid<float> lightness(const Grid<glm::vec3>& rgb) {
  Grid<float> light(rgb.width(), rgb.height());
  for (std::size_t i = 0; i != light.size(); ++i) light[i] = (rgb[i].x + rgb[i].y + rgb[i].z) / 3.F;
  return light;
}

Grid<glm::vec3> picture_of(const Imagery& made, const SurfaceLayers& layers, int factor) {
  const LayerProgram program = compile_layers(layers);
  return layer_surface(program, make_layer_ground(made.dem, {}, program.inputs), factor,
                       {0, 0, side * factor, side * factor}, 1)
      .colour;
}

// Made once for all tests.
struct Example {
  Imagery made = imagery(0.75);
  Fitted file = fitted(made);
  Grid<glm::vec3> fine = picture_of(made, file.textured, finer);
};
const Example& example() {
  static const Example made;
  return made;
}

// Slope of the logarithm of the mean spectrum of rows and columns over that of the frequency, from
// `low` to 2 · `low` waves along the picture, by Fourier sums under Hann's window.
double spectral_slope(const Grid<float>& values, int low) {
  const int n = values.width();
  const int step = std::max(1, n / side);  // rows taken
  const double mean = [&] {
    double sum = 0.0;
    for (const float v : values) sum += static_cast<double>(v);
    return sum / static_cast<double>(values.size());
  }();
  std::vector<double> wave(static_cast<std::size_t>(n)), window(static_cast<std::size_t>(n));
  for (int i = 0; i != n; ++i) {
    wave[static_cast<std::size_t>(i)] = std::cos(6.283185307179586 * i / n);
    window[static_cast<std::size_t>(i)] = 0.5 - 0.5 * std::cos(6.283185307179586 * (i + 0.5) / n);
  }
  double x_sum = 0.0, y_sum = 0.0, xx = 0.0, xy = 0.0, count = 0.0;
  for (int k = low; k <= 2 * low; ++k) {
    double power = 0.0;
    for (int line = 0; line < n; line += step)
      for (const bool row : {true, false}) {
        double real = 0.0, imaginary = 0.0;
        for (int i = 0; i != n; ++i) {
          const double value =
              (static_cast<double>(row ? values(i, line) : values(line, i)) - mean) *
              window[static_cast<std::size_t>(i)];
          const int at = static_cast<int>(static_cast<std::int64_t>(i) * k % n);
          real += value * wave[static_cast<std::size_t>(at)];
          imaginary += value * wave[static_cast<std::size_t>((at + 3 * n / 4) % n)];
        }
        power += real * real + imaginary * imaginary;
      }
    const double x = std::log(k);
    const double y = std::log(power);
    x_sum += x;
    y_sum += y;
    xx += x * x;
    xy += x * y;
    count += 1.0;
  }
  return (count * xy - x_sum * y_sum) / (count * xx - x_sum * x_sum);
}

double deviation(const Grid<float>& values) {
  double sum = 0.0, squares = 0.0;
  for (const float v : values) {
    sum += static_cast<double>(v);
    squares += static_cast<double>(v) * static_cast<double>(v);
  }
  const auto count = static_cast<double>(values.size());
  return std::sqrt(squares / count - sum / count * (sum / count));
}

// Standard deviation within the cells of the picture.
double detail(const Grid<float>& fine) {
  const Grid<float> cells = area_means(fine, finer);
  Grid<float> left = fine;
  for (int y = 0; y != left.height(); ++y)
    for (int x = 0; x != left.width(); ++x) left(x, y) -= cells(x / finer, y / finer);
  return deviation(left);
}

// Waves of 4 to 8 cells exist in the picture and in the layers drawn eight times finer: there, as
// means over the picture's cells, the spectrum has the same slope; and it goes on within cells.
TEST(FitTexture, SpectrumOfThePictureGoesOn) {
  const Imagery& made = example().made;
  const Grid<float> drawn = lightness(example().fine);
  EXPECT_NEAR(spectral_slope(area_means(drawn, finer), side / 8),
              spectral_slope(lightness(made.ground.picture->rgb), side / 8), 0.3);
  EXPECT_GT(spectral_slope(drawn, side / 2), -3.5) << "from two cells to one";
  const Grid<float> smooth = lightness(picture_of(made, example().file.plain, finer));
  EXPECT_GT(detail(drawn), 3.0 * detail(smooth)) << "without noise cells are smooth";
}

// Colours vary as in the picture (at most: a file has few colours), and their mean is the same at
// both resolutions.
TEST(FitTexture, ColoursVaryAndKeepTheirMean) {
  const Imagery& made = example().made;
  const Grid<glm::vec3> coarse = picture_of(made, example().file.textured, 1);
  const Grid<glm::vec3>& fine = example().fine;
  const auto mean = [](const Grid<glm::vec3>& rgb) {
    glm::dvec3 sum(0.0);
    for (const glm::vec3& c : rgb) sum += glm::dvec3(c);
    return sum / static_cast<double>(rgb.size());
  };
  for (int c = 0; c != 3; ++c) {
    EXPECT_NEAR(mean(fine)[c], mean(coarse)[c], 1.0);
    EXPECT_NEAR(mean(fine)[c], mean(made.ground.picture->rgb)[c], 4.0);
  }
  const double share = deviation(area_means(lightness(fine), finer)) /
                       deviation(lightness(made.ground.picture->rgb));
  EXPECT_GT(share, 0.55);
  EXPECT_LT(share, 1.3);
}

// P27, P32: children of a class, in colour and in noise.
TEST(FitTexture, ChildrenVaryInColourAndNoise) {
  const SurfaceLayers& layers = example().file.textured;
  std::size_t roots = 0;
  std::set<double> scales;
  double min_hue = 360.0;
  double max_hue = 0.0;
  std::size_t children = 0;
  for (const SurfaceLayer& layer : layers.layers) {
    const glm::dvec3 rgb(layer.rgb >> 16U, layer.rgb >> 8U & 255U, layer.rgb & 255U);
    if (layer.parent < 0) ++roots;
    if (layer.parent != 0) continue;
    ++children;
    EXPECT_GT(layer.noise.amplitude, 0.0) << layer.name;
    scales.insert(layer.noise.scale_m);
    min_hue = std::min(min_hue, hue_saturation_of(rgb).hue_deg);
    max_hue = std::max(max_hue, hue_saturation_of(rgb).hue_deg);
  }
  EXPECT_EQ(roots, 2U);
  EXPECT_EQ(children, 3U) << "and the class's own colour";
  EXPECT_EQ(scales.size(), children) << "each has noise of its own";
  EXPECT_GT(max_hue - min_hue, 3.0);
  EXPECT_LT(max_hue - min_hue, 60.0);
}

// What light explains becomes bumps: a picture of grey ground lit by a known sun, with slopes finer
// than its DEM.
TEST(FitTexture, BumpsAreWhatLightShows) {
  const PictureSun sun{140.0, 40.0};
  const Grid<float> smooth = synthetic::hills(side, side, 5, 4000.0);
  const auto bumps_of = [&](double bump_m) {
    Grid<float> rough = smooth;
    for (std::size_t i = 0; i != rough.size(); ++i)
      rough[i] += static_cast<float>(bump_m * random_normal(3, static_cast<std::int64_t>(i), 0));
    const Grid<float> light = sunlight(rough, 30.0, sun);
    Imagery made = imagery(0.7);
    made.ground.altitude_m = smooth;
    made.ground.inputs = {smooth};
    for (std::size_t i = 0; i != light.size(); ++i) {
      made.ground.labels[i] = smooth[i] > 0.F ? 1 : 0;
      made.ground.picture->rgb[i] =
          (smooth[i] > 0.F ? glm::vec3(0.9F, 1.F, 0.8F) : glm::vec3(1.F, 0.9F, 0.8F)) *
          (40.F + 120.F * light[i]);
    }
    const GroundFit fit = fit_ground(made.ground, {});
    return class_textures(made.ground, fit, predict_ground(made.ground, fit))[1].roughness_m;
  };
  const double some = bumps_of(4.0);
  EXPECT_GT(some, 0.5);
  EXPECT_GT(bumps_of(8.0), 1.4 * some);
  EXPECT_LT(bumps_of(0.0), 0.5 * some);
}

TEST(FitTexture, ThereIsNoneWithoutAPicture) {
  Imagery made = imagery(0.7);
  made.ground.picture.reset();
  const GroundFit fit = fit_ground(made.ground, {});
  for (const ClassTexture& texture :
       class_textures(made.ground, fit, predict_ground(made.ground, fit)))
    EXPECT_EQ(texture.strength, 0.0);
  for (const SurfaceLayer& layer : fitted(made).textured.layers)
    EXPECT_EQ(layer.noise.amplitude, 0.0);
}

}  // namespace
}  // namespace belvedere
