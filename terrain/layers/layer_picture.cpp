#include "terrain/layers/layer_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/colour/water_colour.h"
#include "base/error.h"
#include "base/filter.h"
#include "base/grid.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

// √3 (√3 - 2)^|k|, normalized so that a constant is preserved.
const std::array<double, 2 * spline_reach + 1>& prefilter() {
  static const std::array<double, 2 * spline_reach + 1> taps = [] {
    std::array<double, 2 * spline_reach + 1> made{};
    const double pole = std::sqrt(3.0) - 2.0;
    double value = 1.0;
    double sum = 0.0;
    for (std::size_t k = 0; k <= spline_reach; ++k, value *= pole) {
      made[spline_reach + k] = value;
      made[spline_reach - k] = value;
      sum += k == 0 ? value : 2.0 * value;
    }
    for (double& tap : made) tap /= sum;
    return made;
  }();
  return taps;
}

// Grids of DEM cells, and how the fine raster reads them.
struct FinePlace {
  int factor;
  PixelRect window;  // of the DEM's cells
  // A fine cell in the window's cells.
  glm::dvec2 at(int x, int y) const {
    return {(x + 0.5) / factor - 0.5 - window.x0, (y + 0.5) / factor - 0.5 - window.y0};
  }
};

Grid<float> refined(const Grid<float>& coefficients, const FinePlace& position,
                    const PixelRect& cells) {
  Grid<float> out(cells.width(), cells.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const glm::dvec2 at = position.at(cells.x0 + x, cells.y0 + y);
      out(x, y) = sample_bspline(coefficients, at.x, at.y);
    }
  return out;
}

}  // namespace

Grid<float> spline_coefficients(const Grid<float>& values) {
  const auto& taps = prefilter();
  const int width = values.width();
  const int height = values.height();
  Grid<double> across(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int k = -spline_reach; k <= spline_reach; ++k)
        sum += taps[static_cast<std::size_t>(k + spline_reach)] *
               static_cast<double>(values(std::clamp(x + k, 0, width - 1), y));
      across(x, y) = sum;
    }
  Grid<float> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0.0;
      for (int k = -spline_reach; k <= spline_reach; ++k)
        sum += taps[static_cast<std::size_t>(k + spline_reach)] *
               across(x, std::clamp(y + k, 0, height - 1));
      out(x, y) = static_cast<float>(sum);
    }
  return out;
}

namespace {

GeoTransform finer_transform(const GeoTransform& cells, int factor) {
  return {cells.origin_x, cells.origin_y, cells.cell_x / factor, cells.cell_y / factor};
}

PixelRect finer_whole(const Dem& dem, int factor) {
  return {0, 0, dem.width() * factor, dem.height() * factor};
}

// Inputs at the cells of a rectangle of the finer raster; "altitude" by the spline too.
std::vector<Grid<float>> finer_inputs(const LayerGround& ground, int factor,
                                      const PixelRect& cells) {
  if (factor == 1) return layer_inputs(ground, cells);
  const PixelRect touched{cells.x0 / factor, cells.y0 / factor, (cells.x1 + factor - 1) / factor,
                          (cells.y1 + factor - 1) / factor};
  const PixelRect all{0, 0, ground.dem->width(), ground.dem->height()};
  const PixelRect far = intersection(grown(touched, 3 + spline_reach), all);
  std::vector<Grid<float>> inputs = layer_inputs(ground, far);
  for (Grid<float>& input : inputs)
    input = refined(spline_coefficients(input), {factor, far}, cells);
  return inputs;
}

}  // namespace

LayeredCells evaluate_layers(const LayerProgram& program, const LayerGround& ground, int factor,
                             const PixelRect& cells, std::uint64_t seed) {
  const Dem& dem = *ground.dem;
  const PixelRect whole = finer_whole(dem, factor);
  if (factor < 1 || intersection(cells, whole) != cells || cells.empty())
    throw Error(ErrorKind::bug, "evaluate_layers", "a rectangle outside the ground");
  const GeoTransform fine = finer_transform(dem.transform, factor);
  const int margin = handed_on(program, 0.5 * (fine.cell_x + fine.cell_y));
  const PixelRect rimmed = intersection(grown(cells, margin), whole);
  std::vector<Grid<float>> inputs = finer_inputs(ground, factor, rimmed);
  const auto of_ground = [&](const std::vector<std::string>& names) {
    return finer_inputs(make_layer_ground(dem, {}, names), factor, rimmed);
  };
  RaisedGround raised;
  const auto altitude = std::find(program.inputs.begin(), program.inputs.end(), "altitude");
  raised.height_m = altitude != program.inputs.end()
                        ? inputs[static_cast<std::size_t>(altitude - program.inputs.begin())]
                        : std::move(of_ground({"altitude"}).front());
  if (margin > 0) raised.slope_north_east = of_ground({"slope", "north", "east"});
  LayeredCells out{std::move(inputs), {}, {}};
  out.coverage = layer_coverage(program, out.inputs, fine, rimmed, seed, &raised);
  out.altitude_m = std::move(raised.height_m);
  if (rimmed == cells) return out;
  const PixelRect inner = moved(cells, -rimmed.x0, -rimmed.y0);
  for (std::vector<Grid<float>>* grids : {&out.inputs, &out.coverage})
    for (Grid<float>& grid : *grids) grid = part_of(grid, inner);
  out.altitude_m = part_of(out.altitude_m, inner);
  return out;
}

LayerSurface layer_surface(const LayerProgram& program, const LayerGround& ground, int factor,
                           const PixelRect& cells, std::uint64_t seed) {
  const GeoTransform fine = finer_transform(ground.dem->transform, factor);
  // A margin of one cell for normals.
  const PixelRect rimmed = intersection(grown(cells, 1), finer_whole(*ground.dem, factor));
  const LayeredCells layered = evaluate_layers(program, ground, factor, rimmed, seed);
  const Grid<float>& height = layered.altitude_m;
  LayerSurface surface;
  const PixelRect inner = moved(cells, -rimmed.x0, -rimmed.y0);
  surface.altitude_m = part_of(height, inner);
  surface.colour = part_of(layer_colour(program, layered.coverage), inner);
  surface.normal = Grid<glm::vec3>(cells.width(), cells.height());
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x) {
      const int west = std::max(inner.x0 + x - 1, 0);
      const int east = std::min(inner.x0 + x + 1, rimmed.width() - 1);
      const int north = std::max(inner.y0 + y - 1, 0);
      const int south = std::min(inner.y0 + y + 1, rimmed.height() - 1);
      const double rise_east =
          static_cast<double>(height(east, inner.y0 + y) - height(west, inner.y0 + y)) /
          ((east - west) * fine.cell_x);
      const double rise_north =
          static_cast<double>(height(inner.x0 + x, north) - height(inner.x0 + x, south)) /
          ((south - north) * fine.cell_y);
      const double length = std::sqrt(rise_east * rise_east + rise_north * rise_north + 1.0);
      surface.normal(x, y) = {static_cast<float>(-rise_east / length),
                              static_cast<float>(-rise_north / length),
                              static_cast<float>(1.0 / length)};
    }
  return surface;
}

namespace {

constexpr int tile_px = 512;
constexpr double radians = 0.017453292519943295;

void require(bool holds, const char* what, double found, const char* allowed) {
  if (!holds) throw Error(ErrorKind::usage, what, fmt::format("{:g}", found), allowed);
}

}  // namespace

void check_layer_picture(const LayerPictureParameters& p) {
  require(p.finer >= 1 && p.finer <= 16, "subdivision of a cell", p.finer, "1 to 16");
  require(p.light_height >= 5.0 && p.light_height <= 90.0, "elevation of the light", p.light_height,
          "5 to 90 degrees");
  require(std::abs(p.light_from) <= 360.0, "direction of the light", p.light_from,
          "0 to 360 degrees");
  require(p.shade >= 0.0 && p.shade <= 1.0, "shade", p.shade, "0 to 1");
  require(p.relief >= 0.0 && p.relief <= 20.0, "relief", p.relief, "0 to 20");
}

SlopeLight::SlopeLight(const LayerPictureParameters& parameters)
    : shade_(parameters.shade), relief_(parameters.relief) {
  const double from = parameters.light_from * radians;
  const double height = parameters.light_height * radians;
  to_light_ = {exact::sin(from) * exact::cos(height), exact::cos(from) * exact::cos(height),
               exact::sin(height)};
}

float SlopeLight::brightness(const glm::vec3& normal) const {
  // A plane's slopes are -x / z and -y / z of its normal: steeper slopes have larger x and y.
  const glm::dvec3 steeper =
      glm::normalize(glm::dvec3(normal.x * relief_, normal.y * relief_, normal.z));
  const double lit = std::max(0.0, glm::dot(steeper, to_light_)) / to_light_.z;
  return static_cast<float>(shade_ + (1.0 - shade_) * lit);
}

void draw_layer_picture(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                        const LayerPictureParameters& parameters,
                        const std::function<void(int y0, const Grid<glm::vec3>& rows)>& take,
                        Progress& progress) {
  check_layer_picture(parameters);
  if (layers.layers.empty())
    throw Error(ErrorKind::usage, layers.name.empty() ? "layers" : layers.name, "no layers",
                "at least one layer");
  const LayerProgram program = compile_layers(layers);
  progress.begin("sampling the ground", 0.0);
  const LayerGround ground = make_layer_ground(dem, climate, program.inputs);
  const Grid<float> depth_m = parameters.beds ? lake_depth_m(dem, parameters.lakes) : Grid<float>();
  const SlopeLight light(parameters);
  const int width = dem.width() * parameters.finer;
  const int height = dem.height() * parameters.finer;
  const int across = (width + tile_px - 1) / tile_px;
  // Cells of the finer raster lie within the DEM's cells: the centre of cell 0 is (1 / finer - 1) /
  // 2 DEM cells from the first DEM cell's centre.
  const auto in_cells = [&](int position) { return (position + 0.5) / parameters.finer - 0.5; };
  progress.begin("drawing the ground", static_cast<double>(width) * height);
  for (int y0 = 0; y0 < height; y0 += tile_px) {
    const int rows = std::min(tile_px, height - y0);
    Grid<glm::vec3> strip(width, rows);
    parallel_ranges(across, 1, [&](int begin, int end) {
      for (int i = begin; i != end; ++i) {
        const PixelRect cells{i * tile_px, y0, std::min(width, (i + 1) * tile_px), y0 + rows};
        const LayerSurface surface =
            layer_surface(program, ground, parameters.finer, cells, parameters.seed);
        for (int y = 0; y < rows; ++y)
          for (int x = 0; x < cells.width(); ++x) {
            const float depth = depth_m.empty() ? 0.F
                                                : sample_bilinear(depth_m, in_cells(cells.x0 + x),
                                                                  in_cells(y0 + y));
            // Water is level, whatever is under it.
            const float brightness = depth > 0.F ? 1.F : light.brightness(surface.normal(x, y));
            const glm::vec3 lit = surface.colour(x, y) * brightness;
            strip(cells.x0 + x, y) =
                glm::clamp(water_colour(lit, depth), glm::vec3(0.F), glm::vec3(255.F));
          }
        progress.advance(static_cast<double>(cells.width()) * rows);
      }
    });
    take(y0, strip);
  }
}

namespace {

constexpr auto class_count = static_cast<std::size_t>(land_cover_class_count);

// -ln Φ(n), Φ the normal distribution: turns a standard normal number into an exponentially
// distributed one. The largest of ln(p) + Gumbel is the smallest of exponential / p, which avoids
// another logarithm per cell.
class ExponentialOfNormal {
 public:
  ExponentialOfNormal() {
    // Φ by Simpson's rule with fine steps from -12, where it is 2e-33; the upper half by symmetry,
    // so that it stays exact near 1.
    constexpr int fine = 64;
    constexpr double step = 1.0 / per_unit;
    const auto density = [](double x) { return exact::exp(-0.5 * x * x) * 0.3989422804014327; };
    double sum = 1.776e-33;
    const int before = (12 - reach) * per_unit;
    std::vector<double> tail;  // Φ(-reach + i · step), up to 0
    for (int i = 0; i <= reach * per_unit + before; ++i) {
      if (i >= before) tail.push_back(sum);
      for (int k = 0; k < fine; ++k) {
        const double a = -12.0 + (i + static_cast<double>(k) / fine) * step;
        const double h = step / fine;
        sum += h / 6.0 * (density(a) + 4.0 * density(a + 0.5 * h) + density(a + h));
      }
    }
    for (std::size_t i = 0; i < tail.size(); ++i)
      values_.push_back(static_cast<float>(-exact::log(tail[i])));
    for (std::size_t i = tail.size() - 1; i-- > 0;) {
      const double q = tail[i];
      values_.push_back(
          static_cast<float>(q < 1e-4 ? q + 0.5 * q * q + q * q * q / 3.0 : -exact::log(1.0 - q)));
    }
    values_.push_back(values_.back());
  }
  float operator()(float n) const {
    const float at = (std::clamp(n, -static_cast<float>(reach), static_cast<float>(reach)) +
                      static_cast<float>(reach)) *
                     per_unit;
    const auto i = static_cast<std::size_t>(at);
    const float part = at - static_cast<float>(i);
    return values_[i] + part * (values_[i + 1] - values_[i]);
  }

 private:
  static constexpr int reach = 6;
  static constexpr int per_unit = 128;
  std::vector<float> values_;
};

float sharpened(float share, double power) {
  if (power == 1.0) return share;
  if (power == 2.0) return share * share;
  if (!(share > 0.F)) return 0.F;
  return static_cast<float>(exact::pow(static_cast<double>(share), power));
}

}  // namespace

void check_layer_drawing(const LayerDrawingParameters& parameters) {
  const auto range = [](const char* name, double value, double low, double high) {
    if (!(value >= low) || !(value <= high))
      throw Error(ErrorKind::usage, name, fmt::format("{}", value),
                  fmt::format("{}…{}", low, high));
  };
  range("power", parameters.power, 1.0, 4.0);
  range("finest_cells", parameters.finest_cells, 0.3, 8.0);
  range("octaves", parameters.octaves, 1.0, 10.0);
  range("spectrum", parameters.spectrum, 0.0, 4.0);
}

LayerDrawing plan_layer_drawing(const LayerDrawingParameters& parameters,
                                const std::vector<Grid<float>>& samples) {
  check_layer_drawing(parameters);
  LayerDrawing drawing{parameters, {}};
  drawing.factor.fill(1.F);
  if (parameters.power == 1.0 || samples.empty()) return drawing;
  // Shares of the classes, their means, and the sharpened shares of each sample.
  std::vector<std::size_t> present;
  for (std::size_t k = 1; k < class_count; ++k)
    if (std::any_of(samples[k].begin(), samples[k].end(), [](float p) { return p > 0.F; }))
      present.push_back(k);
  if (present.empty()) return drawing;
  const std::size_t classes = present.size();
  std::vector<double> wanted(classes, 0.0);
  std::vector<double> sharp;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples[1].size(); ++i) {
    double sum = 0.0;
    for (const std::size_t k : present) sum += static_cast<double>(samples[k][i]);
    if (!(sum > 0.0)) continue;
    ++count;
    for (std::size_t c = 0; c < classes; ++c) {
      const double share = static_cast<double>(samples[present[c]][i]) / sum;
      wanted[c] += share;
      sharp.push_back(static_cast<double>(sharpened(static_cast<float>(share), parameters.power)));
    }
  }
  std::vector<double> factor(classes, 1.0);
  std::vector<double> drawn(classes);
  // Each step covers half the distance in logarithms and cannot overshoot; 80 steps give at least
  // three digits.
  for (int step = 0; step < 80; ++step) {
    std::fill(drawn.begin(), drawn.end(), 0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double* q = sharp.data() + i * classes;
      double sum = 0.0;
      for (std::size_t c = 0; c < classes; ++c) sum += q[c] * factor[c];
      for (std::size_t c = 0; c < classes; ++c) drawn[c] += q[c] * factor[c] / sum;
    }
    for (std::size_t c = 0; c < classes; ++c)
      factor[c] *= std::sqrt(wanted[c] / (drawn[c] + 1e-9 * static_cast<double>(count)));
  }
  for (std::size_t c = 0; c < classes; ++c)
    drawing.factor[present[c]] = static_cast<float>(factor[c]);
  return drawing;
}

Grid<LandCoverClass> draw_classes(const LayerDrawing& drawing,
                                  const std::vector<Grid<float>>& shares,
                                  const GeoTransform& transform, const PixelRect& cells) {
  static const ExponentialOfNormal exponential;
  const LayerDrawingParameters& parameters = drawing.parameters;
  const double cell = 0.5 * (transform.cell_x + transform.cell_y);
  std::vector<LayerNoiseRows::GaussianOctave> octaves;
  double squares = 0.0;
  for (int i = 0; i < parameters.octaves; ++i) {
    const double size = exact::exp2(i);
    octaves.push_back(
        {cell * parameters.finest_cells * size, exact::pow(size, 0.5 * parameters.spectrum), 0});
    squares += octaves.back().weight * octaves.back().weight;
  }
  for (LayerNoiseRows::GaussianOctave& octave : octaves) octave.weight /= std::sqrt(squares);

  Grid<LandCoverClass> out(cells.width(), cells.height(), LandCoverClass::sky);
  Grid<float> min(cells.width(), cells.height(), std::numeric_limits<float>::infinity());
  const auto width = static_cast<std::size_t>(cells.width());
  std::vector<float> noise(width);
  for (std::size_t k = 1; k < class_count; ++k) {
    if (std::all_of(shares[k].begin(), shares[k].end(), [](float p) { return !(p > 0.F); }))
      continue;
    for (std::size_t i = 0; i < octaves.size(); ++i)
      octaves[i].seed = stream_seed(parameters.seed, Stream::class_noise, 100 * (k + 1) + i);
    LayerNoiseRows rows(octaves, transform, cells);
    for (int y = 0; y < cells.height(); ++y) {
      const float* share = shares[k].row(y);
      if (std::all_of(share, share + width, [](float p) { return !(p > 0.F); })) continue;
      rows.fill(cells.y0 + y, noise.data());
      for (std::size_t x = 0; x < width; ++x) {
        if (!(share[x] > 0.F)) continue;
        const float late =
            exponential(noise[x]) / (drawing.factor[k] * sharpened(share[x], parameters.power));
        float& first = min(static_cast<int>(x), y);
        if (late < first) {
          first = late;
          out(static_cast<int>(x), y) = static_cast<LandCoverClass>(k);
        }
      }
    }
  }
  return out;
}

}  // namespace belvedere
