#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/math.h"
#include "base/math_exact.h"
#include "terrain/cover/rule_expression.h"

namespace belvedere {
namespace {

template <class F>
void each(const float* a, float* out, F&& f) {
  for (int i = 0; i < rule_block; ++i) out[i] = f(a[i]);
}
template <class F>
void each(const float* a, const float* b, float* out, F&& f) {
  for (int i = 0; i < rule_block; ++i) out[i] = f(a[i], b[i]);
}
template <class F>
void each(const float* a, const float* b, const float* c, float* out, F&& f) {
  for (int i = 0; i < rule_block; ++i) out[i] = f(a[i], b[i], c[i]);
}

}  // namespace

void RuleExpression::run(Operation operation, const float* const* o, float* out) {
  switch (operation) {
    case Operation::add:
      return each(o[0], o[1], out, [](float a, float b) { return a + b; });
    case Operation::subtract:
      return each(o[0], o[1], out, [](float a, float b) { return a - b; });
    case Operation::multiply:
      return each(o[0], o[1], out, [](float a, float b) { return a * b; });
    case Operation::divide:
      return each(o[0], o[1], out, [](float a, float b) { return a / b; });
    case Operation::less:
      return each(o[0], o[1], out, [](float a, float b) { return a < b ? 1.F : 0.F; });
    case Operation::less_equal:
      return each(o[0], o[1], out, [](float a, float b) { return a <= b ? 1.F : 0.F; });
    case Operation::both:
      return each(o[0], o[1], out, [](float a, float b) { return ((a > 0.F) & (b > 0.F)) ? 1.F : 0.F; });
    case Operation::either:
      return each(o[0], o[1], out, [](float a, float b) { return ((a > 0.F) | (b > 0.F)) ? 1.F : 0.F; });
    case Operation::negate:
      return each(o[0], out, [](float a) { return -a; });
    case Operation::invert:
      return each(o[0], out, [](float a) { return a > 0.F ? 0.F : 1.F; });
    case Operation::minimum:
      return each(o[0], o[1], out, [](float a, float b) { return a < b ? a : b; });
    case Operation::maximum:
      return each(o[0], o[1], out, [](float a, float b) { return a > b ? a : b; });
    case Operation::clip:
      return each(o[0], o[1], o[2], out, [](float x, float low, float high) {
        const float raised = x > low ? x : low;
        return raised < high ? raised : high;
      });
    case Operation::absolute:
      return each(o[0], out, [](float a) { return std::abs(a); });
    case Operation::sine:
      return each(o[0], out, [](float a) { return exact::sin(a); });
    case Operation::cosine:
      return each(o[0], out, [](float a) { return exact::cos(a); });
    case Operation::exponential:
      return each(o[0], out, [](float a) { return exact::exp(a); });
    case Operation::square_root:
      return each(o[0], out, [](float a) { return a > 0.F ? std::sqrt(a) : 0.F; });
    case Operation::smooth_step:
      return each(o[0], o[1], o[2], out, [](float x, float low, float high) {
        if (!(low < high)) return x < low ? 0.F : 1.F;
        return smoothstep(low, high, x);
      });
    case Operation::hat:
      for (int i = 0; i < rule_block; ++i) {
        const float inside = std::min(o[0][i] - o[1][i], o[2][i] - o[0][i]);
        const float width = o[3][i];
        out[i] = width > 0.F ? std::clamp(inside / width + 0.5F, 0.F, 1.F) : (inside >= 0.F ? 1.F : 0.F);
      }
      return;
  }
}

void RuleExpression::evaluate(const std::vector<const float*>& slots, float* out, Scratch& scratch) const {
  constexpr auto block = static_cast<std::size_t>(rule_block);
  scratch.values.resize(static_cast<std::size_t>(blocks_) * block);
  const auto pointer = [&](const Operand& operand) -> const float* {
    const auto index = static_cast<std::size_t>(operand.index);
    switch (operand.kind) {
      case Operand::Kind::variable:
        return slots[index];
      case Operand::Kind::constant:
        return constants_.data() + index * block;
      case Operand::Kind::step:
        break;
    }
    return scratch.values.data() + index * block;
  };
  for (const Step& step : steps_) {
    std::array<const float*, 4> operands{};
    for (int k = 0; k < step.count; ++k) operands[static_cast<std::size_t>(k)] = pointer(step.operands[k]);
    run(step.operation, operands.data(), scratch.values.data() + static_cast<std::size_t>(step.target) * block);
  }
  std::copy_n(pointer(result_), block, out);
}

}  // namespace belvedere
