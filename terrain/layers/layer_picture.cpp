#include "terrain/layers/layer_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/colour/water_colour.h"
#include "base/error.h"
#include "base/filter.h"
#include "base/grid.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/layers/layer_coverage.h"

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

LayerSurface layer_surface(const LayerProgram& program, const LayerGround& ground, int factor,
                           const PixelRect& cells, std::uint64_t seed) {
  const Dem& dem = *ground.dem;
  const PixelRect whole{0, 0, dem.width() * factor, dem.height() * factor};
  if (factor < 1 || intersection(cells, whole) != cells || cells.empty())
    throw Error(ErrorKind::bug, "layer_surface", "a rectangle outside the ground");
  const GeoTransform fine{dem.transform.origin_x, dem.transform.origin_y,
                          dem.transform.cell_x / factor, dem.transform.cell_y / factor};
  // A margin of one cell for normals.
  const PixelRect rimmed = intersection(grown(cells, 1), whole);
  const PixelRect touched{rimmed.x0 / factor, rimmed.y0 / factor, (rimmed.x1 + factor - 1) / factor,
                          (rimmed.y1 + factor - 1) / factor};
  const PixelRect all{0, 0, dem.width(), dem.height()};
  const PixelRect near = intersection(grown(touched, 3), all);
  const PixelRect far = intersection(grown(near, spline_reach), all);

  const Grid<float> coefficients = spline_coefficients(part_of(dem.altitude_m, far));
  Grid<float> height = refined(coefficients, {factor, far}, rimmed);
  std::vector<Grid<float>> inputs;
  const std::vector<Grid<float>> coarse = layer_inputs(ground, near);
  for (std::size_t i = 0; i < coarse.size(); ++i)
    inputs.push_back(program.inputs[i] == "altitude" ? height
                                                     : refined(coarse[i], {factor, near}, rimmed));
  const std::vector<Grid<float>> coverage =
      layer_coverage_and_height(program, inputs, fine, rimmed, seed, height);

  LayerSurface surface;
  const PixelRect inner = moved(cells, -rimmed.x0, -rimmed.y0);
  surface.altitude_m = part_of(height, inner);
  surface.colour = part_of(layer_colour(program, coverage), inner);
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
            const glm::vec3 lit = surface.colour(x, y) * light.brightness(surface.normal(x, y));
            strip(cells.x0 + x, y) =
                glm::clamp(water_colour(lit, depth), glm::vec3(0.F), glm::vec3(255.F));
          }
        progress.advance(static_cast<double>(cells.width()) * rows);
      }
    });
    take(y0, strip);
  }
}

}  // namespace belvedere
