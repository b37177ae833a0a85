#include "terrain/layers/layer_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/colour/water_colour.h"
#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layer_surface.h"

namespace belvedere {
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
