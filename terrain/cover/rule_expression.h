#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"

namespace belvedere {

// Meaning of the names in an expression.
struct RuleNames {
  std::vector<std::string> variables;  // by slot; empty: not available here
  std::vector<std::pair<std::string, double>>
      constants;  // numbers, inserted when the expression is compiled
};

// Expressions are computed for this many cells at a time: enough to amortize the cost of each step,
// few enough for the cache.
inline constexpr int rule_block = 256;

// A small expression over named numbers, compiled once and then computed for blocks of cells:
//   + - * /    < > <= >=    and or not    ( )    numbers, names
//   min(a, b, …) max(a, b, …) clip(x) clip(x, low, high) abs sin cos exp sqrt
//   smoothstep(x, low, high)  0 below low, 1 above high, smooth between
//   hat(x, low, high, width)  1 inside low…high, falling to 0 over `width` around each bound, where
//   it is 1/2
// clip without bounds is to 0…1; clamp is another word for it. Comparisons and logic give 1 or 0;
// what is > 0 counts as true. Angles of sin and cos are radians. All values are floats.
class RuleExpression {
 public:
  enum class Operation : std::uint8_t {
    add,
    subtract,
    multiply,
    divide,
    less,
    less_equal,
    both,
    either,
    negate,
    invert,
    minimum,
    maximum,
    clip,
    absolute,
    sine,
    cosine,
    exponential,
    square_root,
    smooth_step,
    hat
  };

  // `where` and `position` are the file and the position of the text's opening quote; Error(usage)
  // gives file:line:column of the error.
  RuleExpression(const std::string& text, const RuleNames& names, const std::string& where,
                 ConfigPosition position);

  // Slots of the variables that the expression reads, ascending.
  const std::vector<int>& variables() const { return variables_; }

  // Memory for one thread.
  struct Scratch {
    std::vector<float> values;
  };
  // slots[i] points to rule_block values of variable i (only those in variables() are read); writes
  // rule_block values.
  void evaluate(const std::vector<const float*>& slots, float* out, Scratch& scratch) const;

 private:
  friend class RuleCompiler;
  // A variable (>= 0 in `index`), a constant or the result of an earlier step.
  struct Operand {
    enum class Kind : std::uint8_t { variable, constant, step } kind = Kind::constant;
    int index = 0;
  };
  struct Step {
    Operation operation = Operation::add;
    Operand operands[4];
    int count = 0;   // of operands
    int target = 0;  // the block of memory for the result
  };
  static void run(Operation operation, const float* const* operands, float* out);

  std::vector<Step> steps_;
  std::vector<float> constants_;  // a block each
  std::vector<int> variables_;
  Operand result_;
  int blocks_ = 0;
};

}  // namespace belvedere
