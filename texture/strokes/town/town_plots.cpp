#include "texture/strokes/town/town_plots.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/noise.h"
#include "base/parallel.h"
#include "texture/strokes/stroke_parts.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr float plot_width = 3.7F;      // units of the sheet per plot in a row …
constexpr float plot_height = 3.0F;     // … and vertically, with its garden
constexpr float same_plot_units = 8.F;  // plots farther apart are not duplicates
constexpr double turn_step = 0.3927;    // rad, 22.5°: a quarter has one direction
// Towns that grew over time have no grid: streets bend, plots vary in width, and rows of houses
// begin anywhere.
constexpr double bend_plots = 6.0;   // length of a street's bend, in plots …
constexpr double bend_rows = 0.9;    // … and its sideways offset, in rows
constexpr double width_plots = 2.2;  // extent of plots of one width, in plots …
constexpr double width_share = 0.5;  // … and the shift of their borders, in plots
constexpr int rows_of_block = 2;     // rows back to back, between two streets

glm::dvec2 ground_at(const StrokeScene& scene, std::size_t i) {
  const glm::dvec3 p = glm::dvec3(scene.guidance.position_m[i]) + scene.guidance.origin_m;
  return {p.x, p.y};
}

// The mapping between picture and ground around a pixel: metres of ground per pixel to the right
// and down, and its inverse.
struct GroundJacobian {
  glm::dvec2 right{0.0}, down{0.0};
  double area = 0.0;  // of the two, m²; 0: the ground is not visible from above

  glm::dvec2 to_picture(glm::dvec2 m) const {
    return glm::dvec2(m.x * down.y - m.y * down.x, right.x * m.y - right.y * m.x) / area;
  }
};

GroundJacobian ground_jacobian(const StrokeScene& scene, glm::vec2 position, std::size_t i) {
  const float step = std::max(1.F, std::round(1.5F * scene.scale()));
  const auto across = [&](glm::vec2 direction) {
    const glm::vec2 from = position - direction * step;
    const glm::vec2 to = position + direction * step;
    if (!scene.on_canvas(from) || !scene.on_canvas(to)) return glm::dvec2(0.0);
    const std::size_t a = scene.pixel(from);
    const std::size_t b = scene.pixel(to);
    for (const std::size_t k : {a, b})
      if (!(std::abs(scene.guidance.depth_m[k] / scene.guidance.depth_m[i] - 1.F) < 0.03F))
        return glm::dvec2(0.0);
    return (ground_at(scene, b) - ground_at(scene, a)) / (2.0 * static_cast<double>(step));
  };
  GroundJacobian lie;
  lie.right = across({1.F, 0.F});
  lie.down = across({0.F, 1.F});
  lie.area = lie.right.x * lie.down.y - lie.right.y * lie.down.x;
  return lie;
}

// A pitch of at least `min_m`, in steps of the square root of 2: neighbours agree on it.
double pitch_m(double min_m) {
  return exact::exp2(0.5 * std::ceil(2.0 * exact::log2(std::max(min_m, 1.0))));
}

bool find_plot(const StrokeScene& scene, Stream stream, glm::vec2 at, Plot& plot) {
  const std::size_t i = scene.pixel(at);
  if (scene.class_at(i) != settlement) return false;
  const GroundJacobian lie = ground_jacobian(scene, at, i);
  if (std::abs(lie.area) < 1e-6) return false;
  // Streets follow the relief; without a direction each quarter has its own.
  const glm::vec2 grain = scene.guidance.grain[i];
  double angle =
      0.6 * static_cast<double>(ground_noise(scene, i, Stream::street_directions, 900.0));
  if (std::abs(grain.x) + std::abs(grain.y) > 0.1F)
    angle = 0.5 * exact::atan2(static_cast<double>(grain.y), static_cast<double>(grain.x));
  const auto turn = static_cast<std::int64_t>(std::lround(angle / turn_step));
  const exact::Turn street = exact::turn(turn_step * static_cast<double>(turn));
  const glm::dvec2 along{street.cosine, street.sine};
  const glm::dvec2 across{-along.y, along.x};
  const auto plots_a_metre = [&](glm::dvec2 direction) {
    const glm::dvec2 d = lie.to_picture(direction) / static_cast<double>(scene.scale());
    return glm::length(d / glm::dvec2(plot_width, plot_height));
  };
  const double length = pitch_m(1.0 / plots_a_metre(along));
  const double depth = pitch_m(1.15 / plots_a_metre(across));
  const glm::dvec2 here = ground_at(scene, i);
  const auto bent = [&](std::uint64_t part, double sigma_m) {
    return gaussian_noise(stream_seed(scene.parameters.seed, Stream::street_directions, 1 + part),
                          here.x, here.y, sigma_m);
  };
  const double v = glm::dot(here, across) / depth + bend_rows * bent(0, bend_plots * length);
  const auto row = static_cast<std::int64_t>(std::floor(v));
  const std::int64_t block =
      row >= 0 ? row / rows_of_block : (row - rows_of_block + 1) / rows_of_block;
  const std::uint64_t key = stream_seed(scene.parameters.seed, stream);
  const double begins = random_uniform(key, block, turn, 1);
  const double u =
      glm::dot(here, along) / length + width_share * bent(1, width_plots * length) + 6.0 * begins;
  const auto column = static_cast<std::int64_t>(std::floor(u));
  plot.key =
      random_bits(key, column, row,
                  static_cast<std::uint64_t>(turn * 4096 + std::lround(length + 64.0 * depth)));
  // Rows are straighter than the gaps in them.
  const double aside = 0.5 + 0.36 * (random_uniform(plot.key, 0, 0) - 0.5);
  const double back = 0.5 + 0.2 * (random_uniform(plot.key, 0, 1) - 0.5);
  // Bends are smooth: at the nearest pixel, which decides, they hardly move a house.
  const glm::dvec2 to = along * ((static_cast<double>(column) + aside - u) * length) +
                        across * ((static_cast<double>(row) + back - v) * depth);
  const glm::dvec2 offset = lie.to_picture(to);
  plot.away_px = glm::length(offset);
  plot.position = at + glm::vec2(offset);
  if (plot.away_px > 4.0 * static_cast<double>(scene.scale()) || !scene.on_canvas(plot.position))
    return false;
  const std::size_t there = scene.pixel(plot.position);
  plot.pixel = static_cast<std::uint32_t>(there);
  plot.street = column % 6 == 0;
  // Between two blocks of rows runs a lane, across them another.
  const auto ground_px = [&](double plots_on, double rows_on) {
    return at + glm::vec2(
                    lie.to_picture(along * ((static_cast<double>(column) + plots_on - u) * length) +
                                   across * ((static_cast<double>(row) + rows_on - v) * depth)));
  };
  plot.lane_from = plot.lane_to = plot.position;
  if (plot.street) {
    plot.lane_from = ground_px(0.5, -0.1);
    plot.lane_to = ground_px(0.5, 1.1);
  } else if (row == block * rows_of_block) {
    plot.lane_from = ground_px(-0.1, 0.0);
    plot.lane_to = ground_px(1.1, 0.0);
  }
  return scene.class_at(there) == settlement &&
         std::abs(scene.guidance.depth_m[there] / scene.guidance.depth_m[i] - 1.F) < 0.03F;
}

}  // namespace

std::vector<Plot> find_plots(const StrokeScene& scene, Stream stream) {
  const float step = std::max(1.F, 1.4F * scene.scale());
  const glm::ivec2 sheet = scene.sheet_px();
  const PixelRect seeded = scene.seeded();
  const CellRange columns = StrokeScene::cells_within(
      seeded.x0, seeded.x1, step, static_cast<int>(static_cast<float>(sheet.x) / step));
  const CellRange lines = StrokeScene::cells_within(
      seeded.y0, seeded.y1, step, static_cast<int>(static_cast<float>(sheet.y) / step));
  const int down = std::max(0, lines.last - lines.first + 1);
  std::vector<std::vector<Plot>> rows(static_cast<std::size_t>(down));
  parallel_rows(down, [&](int row) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const glm::vec2 at = (glm::vec2(x, lines.first + row) + 0.5F) * step;
      Plot plot{};
      if (scene.on_canvas(at) && find_plot(scene, stream, at, plot))
        rows[static_cast<std::size_t>(row)].push_back(plot);
    }
  });
  std::vector<Plot> plots;
  for (const auto& row : rows) plots.insert(plots.end(), row.begin(), row.end());
  std::stable_sort(plots.begin(), plots.end(), [](const Plot& a, const Plot& b) {
    return a.key != b.key ? a.key < b.key : a.away_px < b.away_px;
  });
  std::vector<Plot> kept;
  for (std::size_t k = 0; k < plots.size(); ++k) {
    bool found_nearer = false;
    for (std::size_t other = k; other-- > 0 && plots[other].key == plots[k].key && !found_nearer;)
      found_nearer =
          glm::length(plots[other].position - plots[k].position) < same_plot_units * scene.scale();
    if (!found_nearer) kept.push_back(plots[k]);
  }
  return kept;
}

}  // namespace belvedere
