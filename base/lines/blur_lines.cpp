#include "base/lines/blur_lines.h"

#include <cstddef>

// This file is compiled once for each vector width by Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/lines/blur_lines.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace belvedere::blur_lines {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;

// `vectors` vectors from j on; they share loads of the weights.
template <int vectors>
HWY_INLINE void ConvolveSome(const float* centre, std::ptrdiff_t step, const float* kernel,
                             int radius, float* out) {
  const Floats d;
  const std::size_t n = hn::Lanes(d);
  const auto first = hn::Set(d, kernel[0]);
  auto a = hn::Mul(first, hn::LoadU(d, centre));
  auto b = a, c = a, e = a;
  if constexpr (vectors == 4) {
    b = hn::Mul(first, hn::LoadU(d, centre + n));
    c = hn::Mul(first, hn::LoadU(d, centre + 2 * n));
    e = hn::Mul(first, hn::LoadU(d, centre + 3 * n));
  }
  for (int k = 1; k <= radius; ++k) {
    const auto weight = hn::Set(d, kernel[k]);
    const float* before = centre - k * step;
    const float* after = centre + k * step;
    a = hn::Add(a, hn::Mul(weight, hn::Add(hn::LoadU(d, before), hn::LoadU(d, after))));
    if constexpr (vectors == 4) {
      b = hn::Add(b, hn::Mul(weight, hn::Add(hn::LoadU(d, before + n), hn::LoadU(d, after + n))));
      c = hn::Add(
          c, hn::Mul(weight, hn::Add(hn::LoadU(d, before + 2 * n), hn::LoadU(d, after + 2 * n))));
      e = hn::Add(
          e, hn::Mul(weight, hn::Add(hn::LoadU(d, before + 3 * n), hn::LoadU(d, after + 3 * n))));
    }
  }
  hn::StoreU(a, d, out);
  if constexpr (vectors == 4) {
    hn::StoreU(b, d, out + n);
    hn::StoreU(c, d, out + 2 * n);
    hn::StoreU(e, d, out + 3 * n);
  }
}

void Convolve(const float* centre, int count, int step, const float* kernel, int radius,
              float* out) {
  const int n = static_cast<int>(hn::Lanes(Floats()));
  int j = 0;
  for (; j + 4 * n <= count; j += 4 * n) ConvolveSome<4>(centre + j, step, kernel, radius, out + j);
  for (; j + n <= count; j += n) ConvolveSome<1>(centre + j, step, kernel, radius, out + j);
  for (; j < count; ++j) {
    float sum = kernel[0] * centre[j];
    for (int k = 1; k <= radius; ++k)
      sum += kernel[k] * (centre[j - k * step] + centre[j + k * step]);
    out[j] = sum;
  }
}

template <class V>
HWY_INLINE V Halved(V a, V b, V c, V d, V e) {
  const Floats tag;
  const auto inner =
      hn::Add(hn::Mul(hn::Set(tag, 0.375F), c), hn::Mul(hn::Set(tag, 0.25F), hn::Add(b, d)));
  return hn::Add(inner, hn::Mul(hn::Set(tag, 0.0625F), hn::Add(a, e)));
}

void Halve(const float* lines, int count, int step, float* out) {
  const Floats d;
  const int n = static_cast<int>(hn::Lanes(d));
  const auto plain = [&](const float* a, int s) {
    return 0.375F * a[2 * s] + 0.25F * (a[s] + a[3 * s]) + 0.0625F * (a[0] + a[4 * s]);
  };
  if (step == 1) {
    int j = 0;
    for (; 2 * (j + n) + 4 <= 2 * count + 3; j += n) {
      auto a = hn::Zero(d), b = a, c = a, e = a, f = a, unused = a;
      hn::LoadInterleaved2(d, lines + 2 * j, a, b);
      hn::LoadInterleaved2(d, lines + 2 * j + 2, c, e);
      hn::LoadInterleaved2(d, lines + 2 * j + 4, f, unused);
      hn::StoreU(Halved(a, b, c, e, f), d, out + j);
    }
    for (; j < count; ++j) out[j] = plain(lines + 2 * j, 1);
    return;
  }
  for (int j = 0; j < count; ++j) {
    const float* a = lines + static_cast<std::ptrdiff_t>(2 * j) * step;
    float* target = out + static_cast<std::ptrdiff_t>(j) * step;
    int l = 0;
    for (; l + n <= step; l += n)
      hn::StoreU(
          Halved(hn::LoadU(d, a + l), hn::LoadU(d, a + step + l), hn::LoadU(d, a + 2 * step + l),
                 hn::LoadU(d, a + 3 * step + l), hn::LoadU(d, a + 4 * step + l)),
          d, target + l);
    for (; l < step; ++l) target[l] = plain(a + l, step);
  }
}

template <class V>
HWY_INLINE V Even(V a, V b, V c) {
  const Floats d;
  return hn::Add(hn::Mul(hn::Set(d, 0.75F), b), hn::Mul(hn::Set(d, 0.125F), hn::Add(a, c)));
}

template <class V>
HWY_INLINE V Odd(V b, V c) {
  return hn::Mul(hn::Set(Floats(), 0.5F), hn::Add(b, c));
}

void Refine(const float* halved, int count, int step, float* out) {
  const Floats d;
  const int n = static_cast<int>(hn::Lanes(d));
  const auto plain = [&](const float* a, int i) {
    return i % 2 == 0 ? 0.75F * a[step] + 0.125F * (a[0] + a[2 * step])
                      : 0.5F * (a[step] + a[2 * step]);
  };
  if (step == 1) {
    int i = 0;
    for (; i + 2 * n <= count; i += 2 * n) {
      const float* at = halved + i / 2;
      const auto a = hn::LoadU(d, at);
      const auto b = hn::LoadU(d, at + 1);
      const auto c = hn::LoadU(d, at + 2);
      hn::StoreInterleaved2(Even(a, b, c), Odd(b, c), d, out + i);
    }
    for (; i < count; ++i) out[i] = plain(halved + i / 2, i);
    return;
  }
  for (int i = 0; i < count; ++i) {
    const float* a = halved + static_cast<std::ptrdiff_t>(i / 2) * step;
    float* target = out + static_cast<std::ptrdiff_t>(i) * step;
    int l = 0;
    if (i % 2 == 0)
      for (; l + n <= step; l += n)
        hn::StoreU(
            Even(hn::LoadU(d, a + l), hn::LoadU(d, a + step + l), hn::LoadU(d, a + 2 * step + l)),
            d, target + l);
    else
      for (; l + n <= step; l += n)
        hn::StoreU(Odd(hn::LoadU(d, a + step + l), hn::LoadU(d, a + 2 * step + l)), d, target + l);
    for (; l < step; ++l) target[l] = plain(a + l, i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::blur_lines
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere::blur_lines {
HWY_EXPORT(Convolve);
HWY_EXPORT(Halve);
HWY_EXPORT(Refine);

void convolve(const float* centre, int count, int step, const float* kernel, int radius,
              float* out) {
  HWY_DYNAMIC_DISPATCH(Convolve)(centre, count, step, kernel, radius, out);
}
void halve(const float* lines, int count, int step, float* out) {
  HWY_DYNAMIC_DISPATCH(Halve)(lines, count, step, out);
}
void refine(const float* halved, int count, int step, float* out) {
  HWY_DYNAMIC_DISPATCH(Refine)(halved, count, step, out);
}

}  // namespace belvedere::blur_lines
#endif
