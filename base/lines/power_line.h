#pragma once

namespace belvedere {

// out[i] = float(exact::pow(bases[i], exponent)) for i < count, to the bit: the same series in the
// same order, vectorized. `out` may be `bases`.
void power_line(const float* bases, double exponent, int count, float* out);

}  // namespace belvedere
