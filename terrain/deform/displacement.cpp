#include "terrain/deform/displacement.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <span>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Beyond so many lengths the kernel is below 1e-13, beyond so many reaches a weight below 1e-14.
constexpr double farthest_lengths = 19.0;
constexpr double farthest_reaches = 8.0;
constexpr double weight_of_still = 0.15;

double square_distance(glm::dvec2 a, glm::dvec2 b) { return square(a.x - b.x) + square(a.y - b.y); }

double matern(double square_of_lengths) {
  if (square_of_lengths > square(farthest_lengths)) return 0.0;
  const double t = std::sqrt(3.0 * square_of_lengths);
  return (1.0 + t) * exact::exp(-t);
}

// m_j².
double square_beyond_noise(const DisplacementParameters& parameters, const DisplacedPlace& place) {
  constexpr double noise_factor = 1.5;
  const double moved = 0.5 * (square(place.moved.lateral_m) + square(place.moved.upward_m));
  const double noise = 0.5 * (square(place.noise.lateral_m) + square(place.noise.upward_m));
  return std::clamp(moved - square(noise_factor) * noise, 0.0, square(parameters.max_m));
}

void check_displacement(const DisplacementParameters& p) {
  const auto require = [](bool holds, const std::string& where, double value, const char* allowed) {
    if (!holds) throw Error(ErrorKind::usage, where, fmt::format("{}", value), allowed);
  };
  constexpr double max_m = 1e5, farthest_m = 1e7;
  const auto length = [&](const char* name, double value) {
    require(value > 0.0 && value <= farthest_m, name, value, "metres, more than 0, up to 1e7");
  };
  length("length_m", p.length_m);
  length("reach_m", p.reach_m);
  length("still_m", p.still_m);
  length("max_m", p.max_m);
  for (std::size_t i = 0; i < p.places.size(); ++i) {
    const DisplacedPlace& place = p.places[i];
    const std::string where = fmt::format("places.{}", i);
    for (const double value : {place.moved.lateral_m, place.moved.upward_m})
      require(std::abs(value) <= max_m, where, value, "a displacement of -1e5 to 1e5 m");
    for (const double value : {place.noise.lateral_m, place.noise.upward_m})
      require(value > 0.0 && value <= max_m, where, value, "noise of more than 0, up to 1e5 m");
  }
}

// matern() from cubics between values and slopes at equal steps, within 1e-9.
class TabulatedMatern {
 public:
  TabulatedMatern() {
    for (int i = 0; i <= count; ++i) {
      const double t = i / steps, decay = exact::exp(-t);
      value_.push_back((1.0 + t) * decay);
      slope_.push_back(-t * decay / steps);
    }
  }
  double at(double square_of_lengths) const {
    const double t = std::sqrt(3.0 * square_of_lengths) * steps;
    if (!(t < count)) return 0.0;
    const auto i = static_cast<std::size_t>(t);
    const double x = t - static_cast<double>(i), y = 1.0 - x;
    return y * y * ((1.0 + 2.0 * x) * value_[i] + x * slope_[i]) +
           x * x * ((1.0 + 2.0 * y) * value_[i + 1] - y * slope_[i + 1]);
  }

 private:
  static constexpr double steps = 64.0;  // to a unit of t
  static constexpr int count = 64 * 33;  // to farthest_lengths
  std::vector<double> value_, slope_;
};

Cholesky with_noise(Matrix covariance, const std::vector<DisplacedPlace>& places,
                    double Displacement::*part) {
  for (std::size_t i = 0; i < places.size(); ++i) covariance(i, i) += square(places[i].noise.*part);
  std::optional<Cholesky> factors = Cholesky::of(std::move(covariance));
  if (!factors)
    throw Error(ErrorKind::usage, "places", "two of them are the same place without noise",
                "different places, or more noise");
  return *std::move(factors);
}

std::vector<double> parts_of(const std::vector<DisplacedPlace>& places,
                             double Displacement::*part) {
  std::vector<double> out;
  for (const DisplacedPlace& place : places) out.push_back(place.moved.*part);
  return out;
}

// Weights of the four nodes about t, 0…1 after the second (Catmull and Rom 1974).
std::array<double, 4> catmull_rom(double t) {
  return {0.5 * t * (-1.0 + t * (2.0 - t)), 1.0 + 0.5 * t * t * (3.0 * t - 5.0),
          0.5 * t * (1.0 + t * (4.0 - 3.0 * t)), 0.5 * t * t * (t - 1.0)};
}

}  // namespace

double displacement_size_m(const DisplacementParameters& parameters, glm::dvec2 position,
                           std::optional<std::size_t> without) {
  double weights = weight_of_still;
  double sum = 0.0;
  for (std::size_t i = 0; i < parameters.places.size(); ++i) {
    const DisplacedPlace& place = parameters.places[i];
    const double distance2 = square_distance(position, place.position) / square(parameters.reach_m);
    if (distance2 > square(farthest_reaches) || i == without) continue;
    const double weight = exact::exp(-0.5 * distance2);
    weights += weight;
    sum += weight * square_beyond_noise(parameters, place);
  }
  return std::sqrt(square(parameters.still_m) + sum / weights);
}

Matrix displacement_covariance(const DisplacementParameters& parameters) {
  const std::vector<DisplacedPlace>& places = parameters.places;
  std::vector<double> size;
  for (const DisplacedPlace& place : places)
    size.push_back(displacement_size_m(parameters, place.position));
  Matrix out(places.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < places.size(); ++k)
      out(i, k) = size[i] * size[k] *
                  matern(square_distance(places[i].position, places[k].position) /
                         square(parameters.length_m));
  return out;
}

DisplacementField::DisplacementField(DisplacementParameters parameters)
    : parameters_(std::move(parameters)) {
  if (parameters_.places.empty()) return;
  check_displacement(parameters_);
  const std::vector<DisplacedPlace>& places = parameters_.places;
  for (const DisplacedPlace& place : places)
    sizes_m_.push_back(displacement_size_m(parameters_, place.position));
  const Matrix covariance = displacement_covariance(parameters_);
  lateral_covariance_ = with_noise(covariance, places, &Displacement::lateral_m);
  upward_covariance_ = with_noise(covariance, places, &Displacement::upward_m);
  lateral_ = lateral_covariance_->solve(parts_of(places, &Displacement::lateral_m));
  upward_ = upward_covariance_->solve(parts_of(places, &Displacement::upward_m));
  // Each vertex of the ground asks for the field, at a cost of two exponentials a place.
  constexpr std::size_t min_places = 8;                // fewer are quicker exactly
  constexpr double near_nodes = 8.0, far_nodes = 4.0;  // to a length
  // Where sizes no longer differ, by 1e-5, and where the kernel is below 1e-5.
  constexpr double near_reaches = 5.0, far_lengths = 8.0;
  if (places.size() < min_places) return;
  const double near_step = std::min(parameters_.length_m, parameters_.reach_m) / near_nodes;
  near_ = tabulate(near_step, near_reaches * parameters_.reach_m);
  far_ = tabulate(parameters_.length_m / far_nodes, far_lengths * parameters_.length_m);
}

DisplacementField::Nodes DisplacementField::tabulate(double step_m, double margin_m) const {
  constexpr double max_nodes = 1 << 19;
  glm::dvec2 low = parameters_.places.front().position, high = low;
  for (const DisplacedPlace& place : parameters_.places) {
    low = glm::min(low, place.position);
    high = glm::max(high, place.position);
  }
  const glm::dvec2 count = glm::ceil((high - low + 2.0 * margin_m) / step_m) + 1.0;
  if (count.x * count.y > max_nodes) return {};
  Nodes nodes{low - margin_m, step_m, {static_cast<int>(count.x), static_cast<int>(count.y)}};
  // displacement_size_m() at the nodes: its weights are products of one by column and one by row.
  const std::vector<DisplacedPlace>& places = parameters_.places;
  const auto factors = [&](int nodes_along, int axis) {
    Matrix out(static_cast<std::size_t>(nodes_along), places.size());
    for (std::size_t n = 0; n < out.rows(); ++n)
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double at = nodes.first[axis] + step_m * static_cast<double>(n);
        out(n, i) =
            exact::exp(-0.5 * square((at - places[i].position[axis]) / parameters_.reach_m));
      }
    return out;
  };
  const Matrix by_column = factors(nodes.values.width(), 0);
  const Matrix by_row = factors(nodes.values.height(), 1);
  std::vector<double> beyond;
  for (const DisplacedPlace& place : places)
    beyond.push_back(square_beyond_noise(parameters_, place));
  const TabulatedMatern kernel;
  parallel_rows(nodes.values.height(), [&](int y) {
    const std::span<const double> row = by_row.row(static_cast<std::size_t>(y));
    for (int x = 0; x < nodes.values.width(); ++x) {
      const std::span<const double> column = by_column.row(static_cast<std::size_t>(x));
      double weights = weight_of_still, sum = 0.0;
      for (std::size_t i = 0; i < places.size(); ++i) {
        weights += row[i] * column[i];
        sum += row[i] * column[i] * beyond[i];
      }
      const double size = std::sqrt(square(parameters_.still_m) + sum / weights);
      const glm::dvec2 at = nodes.first + step_m * glm::dvec2(x, y);
      glm::dvec2 moved(0.0);
      for (std::size_t i = 0; i < places.size(); ++i)
        moved += size * sizes_m_[i] *
                 kernel.at(square_distance(at, places[i].position) / square(parameters_.length_m)) *
                 glm::dvec2(lateral_[i], upward_[i]);
      nodes.values(x, y) = moved;
    }
  });
  return nodes;
}

std::optional<glm::dvec2> DisplacementField::Nodes::at(glm::dvec2 position) const {
  const glm::dvec2 node = (position - first) / step_m;
  if (!(node.x >= 1.0 && node.y >= 1.0 && node.x < values.width() - 2.0 &&
        node.y < values.height() - 2.0))
    return {};
  const int x = static_cast<int>(node.x), y = static_cast<int>(node.y);
  const std::array<double, 4> across = catmull_rom(node.x - x), along = catmull_rom(node.y - y);
  glm::dvec2 sum(0.0);
  for (int row = 0; row < 4; ++row) {
    glm::dvec2 of_row(0.0);
    for (int column = 0; column < 4; ++column)
      of_row += across[static_cast<std::size_t>(column)] * values(x - 1 + column, y - 1 + row);
    sum += along[static_cast<std::size_t>(row)] * of_row;
  }
  return sum;
}

std::vector<double> DisplacementField::covariance_with(glm::dvec2 position) const {
  const double size = displacement_size_m(parameters_, position);
  std::vector<double> out;
  for (std::size_t i = 0; i < parameters_.places.size(); ++i)
    out.push_back(size * sizes_m_[i] *
                  matern(square_distance(position, parameters_.places[i].position) /
                         square(parameters_.length_m)));
  return out;
}

Displacement DisplacementField::at(glm::dvec2 position) const {
  std::optional<glm::dvec2> moved = near_.at(position);
  if (!moved) {
    if (near_.values.empty() || far_.values.empty()) return exactly_at(position);
    moved = far_.at(position);
  }
  return moved ? Displacement{moved->x, moved->y} : Displacement{};
}

Displacement DisplacementField::exactly_at(glm::dvec2 position) const {
  Displacement out;
  if (is_identity()) return out;
  const double size = displacement_size_m(parameters_, position);
  for (std::size_t i = 0; i < parameters_.places.size(); ++i) {
    const double kernel = matern(square_distance(position, parameters_.places[i].position) /
                                 square(parameters_.length_m));
    if (kernel == 0.0) continue;
    const double covariance = size * sizes_m_[i] * kernel;
    out.lateral_m += covariance * lateral_[i];
    out.upward_m += covariance * upward_[i];
  }
  return out;
}

Displacement DisplacementField::deviation(glm::dvec2 position) const {
  if (is_identity()) return {};
  const std::vector<double> covariance = covariance_with(position);
  const double whole = square(displacement_size_m(parameters_, position));
  const auto left = [&](const Cholesky& factors) {
    double known = 0.0;
    for (const double v : factors.whitened(covariance)) known += v * v;
    return std::sqrt(std::max(whole - known, 0.0));
  };
  return {left(*lateral_covariance_), left(*upward_covariance_)};
}

}  // namespace belvedere
