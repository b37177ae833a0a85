#include "base/lines/power_line.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/math_exact.h"

// This file is compiled once for each vector width by Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/lines/power_line.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef BELVEDERE_POWER_LINE
#define BELVEDERE_POWER_LINE
namespace belvedere::power_lines {
constexpr double ln2 = 0.69314718055994530942;
constexpr double root_half = 0.70710678118654752440;
constexpr double whole_from =
    0x1p52;  // added to a small whole number, moves its bits to the end of the sum
constexpr double max_exponent = 1000.0;  // the limit of exact::exp2
// 1 / n, as in exact::pow.
constexpr auto parts = [] {
  std::array<double, 24> of{};
  for (int n = 1; n < 24; ++n) of[static_cast<std::size_t>(n)] = 1.0 / n;
  return of;
}();
}  // namespace belvedere::power_lines
#endif

HWY_BEFORE_NAMESPACE();
namespace belvedere::power_lines {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void Powers(const float* bases, double exponent, int count, float* out) {
  const hn::ScalableTag<double> d;
  const hn::RebindToUnsigned<decltype(d)> bits;
  const hn::Rebind<float, decltype(d)> narrow;
  const auto one = [&](double value) HWY_ATTR { return hn::Set(d, value); };
  const int n = static_cast<int>(hn::Lanes(d));
  int i = 0;
  for (; i + n <= count; i += n) {
    const auto x = hn::PromoteTo(d, hn::LoadU(narrow, bases + i));
    const auto plain = hn::And(hn::Gt(x, hn::Zero(d)), hn::Le(x, one(3.5e38)));
    // x = 2^whole · m with √½ ≤ m < √2.
    const auto word = hn::BitCast(bits, x);
    const auto field =
        hn::BitCast(d, hn::Or(hn::ShiftRight<52>(word), hn::Set(bits, std::uint64_t{0x433} << 52)));
    auto whole = hn::Sub(hn::Sub(field, one(whole_from)), one(1022.0));
    auto m = hn::BitCast(d, hn::Or(hn::And(word, hn::Set(bits, (std::uint64_t{1} << 52) - 1)),
                                   hn::Set(bits, std::uint64_t{0x3FE} << 52)));
    const auto small = hn::Lt(m, one(root_half));
    m = hn::IfThenElse(small, hn::Mul(m, one(2.0)), m);
    whole = hn::IfThenElse(small, hn::Sub(whole, one(1.0)), whole);
    // split_log() and log2() of base/math_exact.cpp.
    const auto s = hn::Div(hn::Sub(m, one(1.0)), hn::Add(m, one(1.0)));
    const auto z = hn::Mul(s, s);
    auto sum = hn::Zero(d);
    for (std::size_t k = 22; k > 0; k -= 2) sum = hn::Add(one(parts[k - 1]), hn::Mul(z, sum));
    const auto rest = hn::Mul(hn::Mul(one(2.0), s), sum);
    const auto log2 = hn::Add(whole, hn::Div(rest, one(ln2)));
    // exp2() and scaled_exp().
    const auto power = hn::Mul(one(exponent), log2);
    const auto in_range = hn::And(plain, hn::Le(hn::Abs(power), one(max_exponent)));
    if (!hn::AllTrue(d, in_range)) {
      for (int k = i; k < i + n; ++k)
        out[k] = static_cast<float>(exact::pow(static_cast<double>(bases[k]), exponent));
      continue;
    }
    const auto up = hn::Floor(hn::Add(power, one(0.5)));
    const auto left = hn::Mul(hn::Sub(power, up), one(ln2));
    auto series = one(1.0);
    for (std::size_t k = 14; k > 0; --k)
      series = hn::Add(one(1.0), hn::Mul(hn::Mul(left, one(parts[k])), series));
    const auto scale =
        hn::ShiftLeft<52>(hn::BitCast(bits, hn::Add(hn::Add(up, one(1023.0)), one(whole_from))));
    hn::StoreU(hn::DemoteTo(narrow, hn::Mul(series, hn::BitCast(d, scale))), narrow, out + i);
  }
  for (; i < count; ++i)
    out[i] = static_cast<float>(exact::pow(static_cast<double>(bases[i]), exponent));
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::power_lines
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere {
namespace power_lines {
HWY_EXPORT(Powers);
}  // namespace power_lines

void power_line(const float* bases, double exponent, int count, float* out) {
  HWY_DYNAMIC_DISPATCH(power_lines::Powers)(bases, exponent, count, out);
}

}  // namespace belvedere
#endif
