#pragma once

namespace belvedere::exact {

// Functions that give the same bits on every machine: they use only sums, products, quotients and
// square roots of doubles, which IEEE 754 rounds exactly. Functions of C libraries differ in the
// last bit, and so would pixels. Each states its largest error against the true value. Use them for
// everything that affects a pixel.

struct Turn {
  double cosine;
  double sine;
};
// Both for an angle in radians, |angle| ≤ 1e6; error below 3e-16 up to |angle| = 10, beyond it
// below 1e-16 · |angle|.
Turn turn(double angle_rad);
double cos(double angle_rad);
double sin(double angle_rad);
double tan(double angle_rad);  // relative error below 1e-15 up to |angle| = 1.5

// Angle of (x, y) counterclockwise from the x axis, -π…π; 0 at the origin. Error below 6e-16.
double atan2(double y, double x);
double atan(double slope);
double asin(double sine);  // -1 … 1; error below 1e-15, also of acos
double acos(double cosine);

// For x of at least 1e-300; infinity for infinity, minus infinity for 0, NaN below; relative error
// below 4e-16, absolute below 1e-16 near 1. log2 of a power of two is exact.
double log2(double x);
double log(double x);
double log10(double x);  // relative error below 6e-16; not exact for powers of ten

// Relative error below 4e-16 · (1 + |exponent|); 0 below exponents of 2 of -1000, infinite above
// 1000. exp2 of a whole number is exact.
double exp2(double exponent);
double exp(double exponent);

// base ≥ 0, and 0 for 0 (exponent > 0); relative error below 1e-15 · (1 + |exponent · log2(base)|).
double pow(double base, double exponent);

double cbrt(double x);  // relative error below 4e-16

// √(x² + y²); the squares must stay within the range of a double.
double hypot(double x, double y);

}  // namespace belvedere::exact
