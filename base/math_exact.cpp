#include "base/math_exact.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace belvedere::exact {
namespace {

constexpr double pi = 3.14159265358979323846;
// π/2 in parts: the first has 33 bits, so its products with the quarter turns of angles up to 1e6
// are exact.
constexpr double half_pi_high = 0x1.921fb544p+0;
constexpr double half_pi_low = 0x1.0b4611a626331p-34;
constexpr double ln2 = 0.69314718055994530942;
constexpr double log10_e = 0.43429448190325182765;
constexpr double root_half = 0.70710678118654752440;

// 1 / (n (n + 1)), the ratio of consecutive terms of the sine and cosine series, and 1 / n;
// computed at compile time.
constexpr auto step_parts = [] {
  std::array<double, 18> of{};
  for (int n = 1; n < 18; ++n) of[static_cast<std::size_t>(n)] = 1.0 / (n * (n + 1.0));
  return of;
}();
constexpr auto parts = [] {
  std::array<double, 24> of{};
  for (int n = 1; n < 24; ++n) of[static_cast<std::size_t>(n)] = 1.0 / n;
  return of;
}();

// Taylor series of sine and cosine for |x| ≤ π/4; the remainder is below x^19 / 19! = 9e-20.
Turn small_turn(double x) {
  const double z = x * x;
  double sine = 1.0;
  for (std::size_t n = 16; n > 0; n -= 2) sine = 1.0 - z * step_parts[n] * sine;
  double cosine = 1.0;
  for (std::size_t n = 18; n > 0; n -= 2) cosine = 1.0 - z * step_parts[n - 1] * cosine;
  return {cosine, x * sine};
}

// atan of 0 ≤ t ≤ 1. Two halvings of the angle, t → t / (1 + √(1 + t²)), reduce it to .199; the
// remainder of the series is t^25 / 25 = 1e-19.
double small_atan(double t) {
  for (int halving = 0; halving < 2; ++halving) t = t / (1.0 + std::sqrt(1.0 + t * t));
  const double z = t * t;
  double sum = 0.0;
  for (std::size_t n = 24; n > 0; n -= 2) sum = parts[n - 1] - z * sum;
  return 4.0 * t * sum;
}

// The bits of a double: 52 of the fraction, then 11 of the exponent + 1023, then the sign.
constexpr int fraction_bits = 52;
constexpr std::uint64_t fraction_mask = (std::uint64_t{1} << fraction_bits) - 1;

struct Parts {
  double fraction;  // ½ … 1
  int exponent;
};

// x = fraction · 2^exponent as by frexp, for x > 0 and finite: from the bits, without a library
// call.
Parts split(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int biased = static_cast<int>(bits >> fraction_bits);
  if (biased == 0) {  // subnormal: normalized first
    const Parts of = split(x * 0x1p54);
    return {of.fraction, of.exponent - 54};
  }
  return {std::bit_cast<double>((bits & fraction_mask) | (std::uint64_t{1022} << fraction_bits)),
          biased - 1022};
}

// 2^whole for |whole| ≤ 1022, so that the result is normal.
double power_of_two(double whole) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023)
                               << fraction_bits);
}

struct BinaryLog {
  double whole;
  double natural_rest;  // of the remainder, -ln2/2 … ln2/2
};

// x = 2^whole · m with √½ ≤ m < √2; log m = 2 artanh((m - 1) / (m + 1)), where |…| ≤ .172: the
// remainder of the series is .172^23 / 23 = 1e-19.
BinaryLog split_log(double x) {
  auto [m, exponent] = split(x);
  if (m < root_half) {
    m *= 2.0;
    --exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double z = s * s;
  double sum = 0.0;
  for (std::size_t n = 22; n > 0; n -= 2) sum = parts[n - 1] + z * sum;
  return {static_cast<double>(exponent), 2.0 * s * sum};
}

bool loggable(double x) { return x > 0.0 && x <= std::numeric_limits<double>::max(); }
double log_of_edge(double x) {
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  return x > 0.0 ? x : std::numeric_limits<double>::quiet_NaN();
}

// 2^whole · e^rest for |rest| ≤ .36 and |whole| ≤ 1000: the remainder of the series is rest^15 /
// 15! = 2e-19.
double scaled_exp(double whole, double rest) {
  double sum = 1.0;
  for (std::size_t n = 14; n > 0; --n) sum = 1.0 + rest * parts[n] * sum;
  return sum * power_of_two(whole);
}

}  // namespace

Turn turn(double angle_rad) {
  const double quarters = std::floor(angle_rad / (0.5 * pi) + 0.5);
  const Turn rest = small_turn((angle_rad - quarters * half_pi_high) - quarters * half_pi_low);
  switch (static_cast<long long>(quarters) & 3) {
    case 0:
      return rest;
    case 1:
      return {-rest.sine, rest.cosine};
    case 2:
      return {-rest.cosine, -rest.sine};
    default:
      return {rest.sine, -rest.cosine};
  }
}

double cos(double angle_rad) { return turn(angle_rad).cosine; }
double sin(double angle_rad) { return turn(angle_rad).sine; }

double tan(double angle_rad) {
  const Turn at = turn(angle_rad);
  return at.sine / at.cosine;
}

double atan2(double y, double x) {
  const double across = std::abs(x);
  const double up = std::abs(y);
  if (across == 0.0 && up == 0.0) return 0.0;
  double angle = up <= across ? small_atan(up / across) : 0.5 * pi - small_atan(across / up);
  if (x < 0.0) angle = pi - angle;
  return y < 0.0 ? -angle : angle;
}

double atan(double slope) { return atan2(slope, 1.0); }
// The other leg of the triangle as a product: 1 - sine² would lose digits near 1.
double asin(double sine) { return atan2(sine, std::sqrt((1.0 - sine) * (1.0 + sine))); }
double acos(double cosine) { return atan2(std::sqrt((1.0 - cosine) * (1.0 + cosine)), cosine); }

double log2(double x) {
  if (!loggable(x)) return log_of_edge(x);
  const BinaryLog of = split_log(x);
  return of.whole + of.natural_rest / ln2;
}

double log(double x) {
  if (!loggable(x)) return log_of_edge(x);
  const BinaryLog of = split_log(x);
  return of.whole * ln2 + of.natural_rest;
}

double log10(double x) { return log(x) * log10_e; }

double exp2(double exponent) {
  if (std::isnan(exponent)) return exponent;
  if (exponent < -1000.0) return 0.0;
  if (exponent > 1000.0) return std::numeric_limits<double>::infinity();
  const double whole = std::floor(exponent + 0.5);
  return scaled_exp(whole, (exponent - whole) * ln2);
}

double exp(double exponent) { return exp2(exponent / ln2); }

double pow(double base, double exponent) {
  if (std::isnan(base)) return base;
  return base > 0.0 ? exp2(exponent * log2(base)) : 0.0;
}

double cbrt(double x) {
  if (x == 0.0 || !std::isfinite(x)) return x;
  const double size = std::abs(x);
  const double root = exp2(log2(size) / 3.0);
  const double better =
      root - (root * root * root - size) /
                 (3.0 * root * root);  // a Newton step removes the error of the power
  return x < 0.0 ? -better : better;
}

double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace belvedere::exact
