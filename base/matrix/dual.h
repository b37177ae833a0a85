#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "base/math_exact.h"

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

}  // namespace belvedere
