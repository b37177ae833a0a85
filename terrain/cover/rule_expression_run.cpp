#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/math_exact.h"
#include "terrain/cover/rule_expression.h"

// The first part of this file is compiled once for each vector width by Highway.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/cover/rule_expression_run.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace belvedere::rule_steps {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Values = hn::Vec<Floats>;

// Some values of all operands are read before any is written, since a result may replace an
// operand.
template <class F>
HWY_INLINE void each_1(const float* const* o, float* out, F&& f) {
  const Floats d;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_block); i += hn::Lanes(d))
    hn::StoreU(f(hn::LoadU(d, o[0] + i)), d, out + i);
}
template <class F>
HWY_INLINE void each_2(const float* const* o, float* out, F&& f) {
  const Floats d;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_block); i += hn::Lanes(d))
    hn::StoreU(f(hn::LoadU(d, o[0] + i), hn::LoadU(d, o[1] + i)), d, out + i);
}
template <class F>
HWY_INLINE void each_3(const float* const* o, float* out, F&& f) {
  const Floats d;
  for (std::size_t i = 0; i < static_cast<std::size_t>(rule_block); i += hn::Lanes(d))
    hn::StoreU(f(hn::LoadU(d, o[0] + i), hn::LoadU(d, o[1] + i), hn::LoadU(d, o[2] + i)), d,
               out + i);
}

// 0…1; NaN is kept, as by std::clamp.
HWY_INLINE Values Unit(Values v) {
  const Floats d;
  const Values zero = hn::Zero(d);
  const Values one = hn::Set(d, 1.F);
  return hn::IfThenElse(hn::Lt(v, zero), zero, hn::IfThenElse(hn::Lt(one, v), one, v));
}

// All operations without calls of the mathematics library; comparisons as in docs/class_rules.md.
void RunStep(RuleExpression::Operation operation, const float* const* o, float* out) {
  using Operation = RuleExpression::Operation;
  const Floats d;
  const Values zero = hn::Zero(d);
  const Values one = hn::Set(d, 1.F);
  switch (operation) {
    case Operation::add:
      return each_2(o, out, [](Values a, Values b) HWY_ATTR { return hn::Add(a, b); });
    case Operation::subtract:
      return each_2(o, out, [](Values a, Values b) HWY_ATTR { return hn::Sub(a, b); });
    case Operation::multiply:
      return each_2(o, out, [](Values a, Values b) HWY_ATTR { return hn::Mul(a, b); });
    case Operation::divide:
      return each_2(o, out, [](Values a, Values b) HWY_ATTR { return hn::Div(a, b); });
    case Operation::less:
      return each_2(o, out, [&](Values a, Values b) HWY_ATTR {
        return hn::IfThenElseZero(hn::Lt(a, b), one);
      });
    case Operation::less_equal:
      return each_2(o, out, [&](Values a, Values b) HWY_ATTR {
        return hn::IfThenElseZero(hn::Le(a, b), one);
      });
    case Operation::both:
      return each_2(o, out, [&](Values a, Values b) HWY_ATTR {
        return hn::IfThenElseZero(hn::And(hn::Gt(a, zero), hn::Gt(b, zero)), one);
      });
    case Operation::either:
      return each_2(o, out, [&](Values a, Values b) HWY_ATTR {
        return hn::IfThenElseZero(hn::Or(hn::Gt(a, zero), hn::Gt(b, zero)), one);
      });
    case Operation::negate:
      return each_1(o, out, [](Values a) HWY_ATTR { return hn::Neg(a); });
    case Operation::invert:
      return each_1(o, out,
                    [&](Values a) HWY_ATTR { return hn::IfThenZeroElse(hn::Gt(a, zero), one); });
    case Operation::minimum:
      return each_2(o, out,
                    [](Values a, Values b) HWY_ATTR { return hn::IfThenElse(hn::Lt(a, b), a, b); });
    case Operation::maximum:
      return each_2(o, out,
                    [](Values a, Values b) HWY_ATTR { return hn::IfThenElse(hn::Gt(a, b), a, b); });
    case Operation::clip:
      return each_3(o, out, [](Values x, Values low, Values high) HWY_ATTR {
        const Values raised = hn::IfThenElse(hn::Gt(x, low), x, low);
        return hn::IfThenElse(hn::Lt(raised, high), raised, high);
      });
    case Operation::absolute:
      return each_1(o, out, [](Values a) HWY_ATTR { return hn::Abs(a); });
    case Operation::square_root:
      return each_1(o, out, [&](Values a) HWY_ATTR {
        return hn::IfThenElseZero(hn::Gt(a, zero), hn::Sqrt(a));
      });
    case Operation::smooth_step:
      return each_3(o, out, [&](Values x, Values low, Values high) HWY_ATTR {
        const Values t = Unit(hn::Div(hn::Sub(x, low), hn::Sub(high, low)));
        const Values smooth =
            hn::Mul(hn::Mul(t, t), hn::Sub(hn::Set(d, 3.F), hn::Mul(hn::Set(d, 2.F), t)));
        return hn::IfThenElse(hn::Lt(low, high), smooth, hn::IfThenZeroElse(hn::Lt(x, low), one));
      });
    case Operation::hat:
      for (std::size_t i = 0; i < static_cast<std::size_t>(rule_block); i += hn::Lanes(d)) {
        const Values x = hn::LoadU(d, o[0] + i);
        const Values above = hn::Sub(x, hn::LoadU(d, o[1] + i));
        const Values below = hn::Sub(hn::LoadU(d, o[2] + i), x);
        const Values width = hn::LoadU(d, o[3] + i);
        const Values inside = hn::IfThenElse(hn::Lt(below, above), below, above);
        const Values soft = Unit(hn::Add(hn::Div(inside, width), hn::Set(d, 0.5F)));
        hn::StoreU(hn::IfThenElse(hn::Gt(width, zero), soft,
                                  hn::IfThenElseZero(hn::Ge(inside, zero), one)),
                   d, out + i);
      }
      return;
    case Operation::sine:
    case Operation::cosine:
    case Operation::exponential:
      return;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace belvedere::rule_steps
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace belvedere {
namespace rule_steps {
HWY_EXPORT(RunStep);
}  // namespace rule_steps

void RuleExpression::run(Operation operation, const float* const* o, float* out) {
  switch (operation) {
    case Operation::sine:
      for (int i = 0; i < rule_block; ++i) out[i] = static_cast<float>(exact::sin(o[0][i]));
      return;
    case Operation::cosine:
      for (int i = 0; i < rule_block; ++i) out[i] = static_cast<float>(exact::cos(o[0][i]));
      return;
    case Operation::exponential:
      for (int i = 0; i < rule_block; ++i) out[i] = static_cast<float>(exact::exp(o[0][i]));
      return;
    default:
      HWY_DYNAMIC_DISPATCH(rule_steps::RunStep)(operation, o, out);
  }
}

void RuleExpression::evaluate(const std::vector<const float*>& slots, float* out,
                              Scratch& scratch) const {
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
    for (int k = 0; k < step.count; ++k)
      operands[static_cast<std::size_t>(k)] = pointer(step.operands[k]);
    run(step.operation, operands.data(),
        scratch.values.data() + static_cast<std::size_t>(step.target) * block);
  }
  std::copy_n(pointer(result_), block, out);
}

}  // namespace belvedere
#endif
