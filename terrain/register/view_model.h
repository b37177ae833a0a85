#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "base/math_exact.h"
#include "terrain/deform/displacement.h"
#include "terrain/register/control_pairs.h"

namespace belvedere {

// A number with its exact derivatives by N unknowns: arithmetic on it follows the rules of
// differentiation (forward mode), so a formula written once gives its value and its slope.
template <std::size_t N>
struct Dual {
  double value = 0.0;
  std::array<double, N> slope = {};

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): formulas
  // The unknown of that index.
  static Dual unknown(double value, std::size_t index) {
    Dual out(value);
    out.slope[index] = 1.0;
    return out;
  }
  // f of a number: its value there, and its derivative.
  Dual mapped(double f, double derivative) const {
    Dual out(f);
    for (std::size_t i = 0; i < N; ++i) out.slope[i] = derivative * slope[i];
    return out;
  }

  friend Dual operator-(const Dual& a) { return a.mapped(-a.value, -1.0); }
  friend Dual operator+(const Dual& a, const Dual& b) {
    return combined(a, b, a.value + b.value, 1.0, 1.0);
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return combined(a, b, a.value - b.value, 1.0, -1.0);
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return combined(a, b, a.value * b.value, b.value, a.value);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double quotient = a.value / b.value;
    return combined(a, b, quotient, 1.0 / b.value, -quotient / b.value);
  }

  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return a.mapped(root, 0.5 / root);
  }
  friend Dual exp(const Dual& a) {
    const double power = exact::exp(a.value);
    return a.mapped(power, power);
  }
  friend Dual log(const Dual& a) { return a.mapped(exact::log(a.value), 1.0 / a.value); }
  friend Dual sin(const Dual& a) { return a.mapped(exact::sin(a.value), exact::cos(a.value)); }
  friend Dual cos(const Dual& a) { return a.mapped(exact::cos(a.value), -exact::sin(a.value)); }
  friend Dual atan2(const Dual& y, const Dual& x) {
    const double square = x.value * x.value + y.value * y.value;
    return combined(y, x, exact::atan2(y.value, x.value), x.value / square, -y.value / square);
  }

 private:
  static Dual combined(const Dual& a, const Dual& b, double value, double by_a, double by_b) {
    Dual out(value);
    for (std::size_t i = 0; i < N; ++i) out.slope[i] = by_a * a.slope[i] + by_b * b.slope[i];
    return out;
  }
};

// How a painter may have seen the land, in numbers that pairs can tell. The true camera is not
// looked for: height of the eye, bend, pitch and horizon trade off exactly. Instead two curves of
// distance give the direction of a place (E, N, z), d its horizontal distance from the eye, L the
// extent of the pairs, x = d / L, b the valleys' altitude:
//   azimuth  a = atan2(E - Ex, N - Ny) + s / d              s, h: what it is displaced, m
//   tangent  t = (e(d) (z - b) - D(d) + h) / d              of its elevation
//   e(d) = e0 + e1 ln x + e2 ln² x                          vertical exaggeration
//   D(d) / L = D0 + D1 x + D2 x² + Σ c_k max(0, x - x_k)³   eye above b, and bend, in one
// A camera takes p = a - azimuth and t to pixels, f in pixels, (cx, cy) the middle:
//   cylinder  u = cx + f p              v = cy - f t
//   panini    u = cx + f S sin p        v = cy + f tan q - f S t   S = 2 / (1 + cos p)
//   plane     u = cx + f sin p / w      v = cy - f (t cos q - sin q cos p) / w
//             w = cos q cos p + t sin q, q the pitch
enum class ViewKind : std::uint8_t { cylinder, panini, plane };
std::string_view view_kind_name(ViewKind kind);  // as in `camera.projection`

namespace view_unknown {
constexpr std::size_t east = 0, north = 1;  // of the eye from the origin, in L
constexpr std::size_t azimuth = 2;          // of the middle, rad
constexpr std::size_t log_focal = 3;        // ln f
constexpr std::size_t pitch = 4;            // q, rad; a cylinder's is in D1
constexpr std::size_t exaggeration = 5;     // e0, e1, e2
constexpr std::size_t drop = 8;             // D0, D1, D2
constexpr std::size_t bend = 11;            // c_k
constexpr std::size_t middle = 14;          // cx, cy from the picture's centre, in its width
constexpr std::size_t count = 16;
}  // namespace view_unknown
constexpr std::array<double, 3> view_knots = {0.4, 0.8, 1.2};  // x_k

using ViewUnknowns = std::array<double, view_unknown::count>;
using ViewNumber = Dual<view_unknown::count>;

// Constants of a view, known before its unknowns are fitted.
struct ViewFrame {
  ViewKind kind = ViewKind::cylinder;
  glm::dvec2 size_px{0.0};  // of the picture
  glm::dvec2 origin{0.0};   // mean of the pairs' places, CRS
  double extent_m = 1.0;    // L
  double valley_m = 0.0;    // b: a tenth of the pairs lies lower
  bool cropped = false;     // the middle may lie beside the picture's centre
};
// The frame of a picture and its control pairs, of which there is at least one.
ViewFrame view_frame(ViewKind kind, glm::dvec2 size_px, bool cropped,
                     std::span<const ControlPair> pairs);

// Distance of a place from the eye, m; at least a fiftieth of L.
double view_distance_m(const ViewFrame& frame, const ViewUnknowns& view, glm::dvec2 position);
// The factors of e0, e1, e2, D0, D1, D2, c_k in a place's tangent.
std::array<double, 9> tangent_factors(const ViewFrame& frame, double distance_m, double altitude_m);
// e(d) and D(d) - L D0 …: the curves themselves.
double view_exaggeration(const ViewFrame& frame, const ViewUnknowns& view, double distance_m);
double view_drop_m(const ViewFrame& frame, const ViewUnknowns& view, double distance_m);

struct ViewPixel {
  ViewNumber u, v;
};
// The pixel of a place, with derivatives.
ViewPixel project_in_view(const ViewFrame& frame, const ViewUnknowns& view, glm::dvec2 position,
                          double altitude_m, const Displacement& displaced = {});

// How far a pair's place is displaced if its pixel shows it, with derivatives, and the pixels that
// a metre of both takes up.
struct ViewDisplacement {
  ViewNumber lateral_m, upward_m;
  Displacement px_per_m;
};
ViewDisplacement displacement_in_view(const ViewFrame& frame, const ViewUnknowns& view,
                                      const ControlPair& pair);

// Whether a painting may be seen like that: a focal length of an eighth to fifty widths, an eye at
// most ten extents away, pixels that move with their places.
bool is_plausible(const ViewFrame& frame, const ViewUnknowns& view,
                  std::span<const ControlPair> pairs);

// Regularization of unknowns that the pairs do not determine: residuals in standard deviations.
std::vector<ViewNumber> view_priors(const ViewFrame& frame, const ViewUnknowns& view);

}  // namespace belvedere
