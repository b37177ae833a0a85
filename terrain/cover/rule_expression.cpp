#include "terrain/cover/rule_expression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string_view>

#include "base/error.h"

namespace belvedere {
namespace {

constexpr int deepest_nesting = 100;

bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

struct Token {
  enum class Kind { number, name, symbol, end } kind = Kind::end;
  std::string_view text;
  double number = 0.0;
  std::size_t offset = 0;
};

}  // namespace

// Recursive descent: text to steps in one pass. Constants are folded, so a parameter costs nothing
// per cell.
class RuleCompiler {
 public:
  using Operation = RuleExpression::Operation;
  using Operand = RuleExpression::Operand;

  RuleCompiler(RuleExpression& out, const std::string& text, const RuleNames& names,
               const std::string& where, ConfigPosition position)
      : out_(out), text_(text), names_(names), where_(where), position_(position) {}

  void compile() {
    next();
    const Value value = parse_or();
    if (token_.kind != Token::Kind::end)
      fail(token_.offset, "unexpected " + quoted(token_),
           "an operator or the end of the expression");
    out_.result_ = value.operand;
    spread_constants();
    std::sort(out_.variables_.begin(), out_.variables_.end());
    out_.variables_.erase(std::unique(out_.variables_.begin(), out_.variables_.end()),
                          out_.variables_.end());
  }

 private:
  // A block of memory is free again once the step that reads it is written: blocks are allocated
  // like a stack.
  struct Value {
    Operand operand;
  };

  struct Function {
    std::string_view name;
    Operation operation;
    int min;
    int max;
  };
  static constexpr std::array<Function, 11> functions = {
      {{"min", Operation::minimum, 2, 16},
       {"max", Operation::maximum, 2, 16},
       {"clip", Operation::clip, 1, 3},
       {"clamp", Operation::clip, 1, 3},
       {"abs", Operation::absolute, 1, 1},
       {"sin", Operation::sine, 1, 1},
       {"cos", Operation::cosine, 1, 1},
       {"exp", Operation::exponential, 1, 1},
       {"sqrt", Operation::square_root, 1, 1},
       {"smoothstep", Operation::smooth_step, 3, 3},
       {"hat", Operation::hat, 4, 4}}};

  [[noreturn]] void fail(std::size_t offset, const std::string& found,
                         const std::string& allowed) const {
    // One line: the text starts after its quote. Several lines (""" in TOML): after the line of the
    // quotes.
    ConfigPosition position = position_;
    if (position.line > 0) {
      if (text_.find('\n') == std::string::npos) {
        position.column += 1 + static_cast<int>(offset);
      } else {
        const std::string_view before = std::string_view(text_).substr(0, offset);
        const std::size_t newline = before.rfind('\n');
        position.line += 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
        position.column =
            1 + static_cast<int>(newline == std::string_view::npos ? offset : offset - newline - 1);
      }
      throw Error(ErrorKind::usage, config_where(where_, position), found, allowed);
    }
    throw Error(ErrorKind::usage, where_,
                fmt::format("{} at character {} of \"{}\"", found, offset + 1, text_), allowed);
  }

  static std::string quoted(const Token& token) {
    return token.kind == Token::Kind::end ? std::string("end of the expression")
                                          : fmt::format("\"{}\"", token.text);
  }

  void next() {
    const std::string_view text = text_;
    while (at_ < text.size() &&
           (text[at_] == ' ' || text[at_] == '\t' || text[at_] == '\n' || text[at_] == '\r'))
      ++at_;
    token_ = {};
    token_.offset = at_;
    if (at_ == text.size()) return;
    const char c = text[at_];
    std::size_t length = 1;
    if (is_digit(c) || (c == '.' && at_ + 1 < text.size() && is_digit(text[at_ + 1]))) {
      token_.kind = Token::Kind::number;
      // from_chars instead of strtod: the locale must not change the meaning of a rule.
      const auto [end, fault] =
          std::from_chars(text.data() + at_, text.data() + text.size(), token_.number);
      if (fault != std::errc() || !std::isfinite(token_.number)) fail(at_, "number too large", "");
      length = static_cast<std::size_t>(end - (text.data() + at_));
      if (at_ + length < text.size() && is_name_start(text[at_ + length]))
        fail(at_ + length, "letter directly after a number", "an operator");
    } else if (is_name_start(c)) {
      token_.kind = Token::Kind::name;
      while (at_ + length < text.size() &&
             (is_name_start(text[at_ + length]) || is_digit(text[at_ + length])))
        ++length;
    } else if (std::string_view("+-*/<>(),").find(c) != std::string_view::npos) {
      token_.kind = Token::Kind::symbol;
      if ((c == '<' || c == '>') && at_ + 1 < text.size() && text[at_ + 1] == '=') length = 2;
    } else {
      fail(at_, fmt::format("unexpected character \"{}\"", text.substr(at_, 1)),
           "numbers, names, + - * / < > <= >= and or not ( ) ,");
    }
    token_.text = text.substr(at_, length);
    at_ += length;
  }

  bool is(std::string_view text) const {
    return (token_.kind == Token::Kind::symbol || token_.kind == Token::Kind::name) &&
           token_.text == text;
  }
  bool accept(std::string_view text) {
    if (!is(text)) return false;
    next();
    return true;
  }
  void expect(std::string_view text) {
    if (!accept(text))
      fail(token_.offset, "unexpected " + quoted(token_), fmt::format("\"{}\"", text));
  }

  Value constant(double value) {
    constants_.push_back(static_cast<float>(value));
    return {{Operand::Kind::constant, static_cast<int>(constants_.size()) - 1}};
  }

  // Only the constants that a step still reads are kept, each as a whole block.
  void spread_constants() {
    std::vector<int> block_of(constants_.size(), -1);
    const auto keep = [&](Operand& operand) {
      if (operand.kind != Operand::Kind::constant) return;
      int& block = block_of[static_cast<std::size_t>(operand.index)];
      if (block < 0) {
        block = static_cast<int>(out_.constants_.size()) / rule_block;
        out_.constants_.insert(out_.constants_.end(), rule_block,
                               constants_[static_cast<std::size_t>(operand.index)]);
      }
      operand.index = block;
    };
    for (RuleExpression::Step& step : out_.steps_)
      for (int k = 0; k < step.count; ++k) keep(step.operands[k]);
    keep(out_.result_);
  }

  Value emit(Operation operation, std::initializer_list<Value> values) {
    RuleExpression::Step step;
    step.operation = operation;
    bool known = true;
    int k = 0;
    for (const Value& v : values) {
      known = known && v.operand.kind == Operand::Kind::constant;
      if (v.operand.kind == Operand::Kind::step) --top_;
      step.operands[k++] = v.operand;
    }
    step.count = k;
    if (known) {
      std::array<std::array<float, rule_block>, 4> blocks{};
      std::array<const float*, 4> operands{};
      std::array<float, rule_block> result{};
      for (int i = 0; i < k; ++i) {
        blocks[static_cast<std::size_t>(i)].fill(
            constants_[static_cast<std::size_t>(step.operands[i].index)]);
        operands[static_cast<std::size_t>(i)] = blocks[static_cast<std::size_t>(i)].data();
      }
      RuleExpression::run(operation, operands.data(), result.data());
      return constant(static_cast<double>(result[0]));
    }
    step.target = top_++;
    out_.blocks_ = std::max(out_.blocks_, top_);
    out_.steps_.push_back(step);
    return {{Operand::Kind::step, step.target}};
  }

  Value parse_or() {
    Value value = parse_and();
    while (accept("or")) value = emit(Operation::either, {value, parse_and()});
    return value;
  }
  Value parse_and() {
    const std::size_t steps = out_.steps_.size();
    const int top = top_;
    Value value = parse_not();
    while (accept("and")) {
      const Value right = parse_not();
      const bool never = is_false(value) || is_false(right);
      value = emit(Operation::both, {value, right});
      if (!never) continue;
      // Branches that a parameter turns off are not computed. Their variables stay listed, so that
      // the validity of a rule does not depend on parameters.
      out_.steps_.resize(steps);
      top_ = top;
      value = constant(0.0);
    }
    return value;
  }
  bool is_false(const Value& value) const {
    return value.operand.kind == Operand::Kind::constant &&
           !(constants_[static_cast<std::size_t>(value.operand.index)] > 0.F);
  }
  Value parse_not() {
    const Depth depth(*this);
    if (accept("not")) return emit(Operation::invert, {parse_not()});
    return parse_comparison();
  }
  Value parse_comparison() {
    const Value left = parse_sum();
    const bool less = is("<");
    const bool less_equal = is("<=");
    const bool greater = is(">");
    if (!less && !less_equal && !greater && !is(">=")) return left;
    next();
    const Value right = parse_sum();
    if (is("<") || is("<=") || is(">") || is(">="))
      fail(token_.offset, "chained comparison", "\"and\" between two comparisons");
    // a > b is b < a; the blocks of both are freed together, so their order does not matter.
    return less || less_equal
               ? emit(less ? Operation::less : Operation::less_equal, {left, right})
               : emit(greater ? Operation::less : Operation::less_equal, {right, left});
  }
  Value parse_sum() {
    Value value = parse_product();
    while (is("+") || is("-")) {
      const Operation operation = is("+") ? Operation::add : Operation::subtract;
      next();
      value = emit(operation, {value, parse_product()});
    }
    return value;
  }
  Value parse_product() {
    Value value = parse_sign();
    while (is("*") || is("/")) {
      const Operation operation = is("*") ? Operation::multiply : Operation::divide;
      next();
      value = emit(operation, {value, parse_sign()});
    }
    return value;
  }
  Value parse_sign() {
    const Depth depth(*this);
    if (accept("-")) return emit(Operation::negate, {parse_sign()});
    if (accept("+")) return parse_sign();
    return parse_primary();
  }
  Value parse_primary() {
    const Token token = token_;
    if (token.kind == Token::Kind::number) {
      next();
      return constant(token.number);
    }
    if (accept("(")) {
      const Value value = parse_or();
      expect(")");
      return value;
    }
    if (token.kind != Token::Kind::name || token.text == "and" || token.text == "or" ||
        token.text == "not")
      fail(token.offset, "unexpected " + quoted(token), "a number, a name, a function or \"(\"");
    next();
    if (is("(")) return parse_call(token);
    const auto variable = std::find(names_.variables.begin(), names_.variables.end(), token.text);
    if (variable != names_.variables.end()) {
      const int slot = static_cast<int>(variable - names_.variables.begin());
      out_.variables_.push_back(slot);
      return {{Operand::Kind::variable, slot}};
    }
    for (const auto& [name, value] : names_.constants)
      if (name == token.text) return constant(value);
    std::vector<std::string> known;
    std::copy_if(names_.variables.begin(), names_.variables.end(), std::back_inserter(known),
                 [](const auto& n) { return !n.empty(); });
    for (const auto& [name, value] : names_.constants) known.push_back(name);
    fail_unknown(token, "name", known);
  }

  Value parse_call(const Token& name) {
    const auto function = std::find_if(functions.begin(), functions.end(),
                                       [&](const Function& f) { return f.name == name.text; });
    if (function == functions.end()) {
      std::vector<std::string> known;
      known.reserve(functions.size());
      for (const Function& f : functions) known.emplace_back(f.name);
      fail_unknown(name, "function", known);
    }
    expect("(");
    std::vector<Value> values;
    do {
      values.push_back(parse_or());
      // min and max of many are reduced two at a time, which keeps memory and steps small.
      if (function->max == 16 && values.size() == 2 && is(","))
        values = {emit(function->operation, {values[0], values[1]})};
      else if (function->max == 16 && values.size() == 2)
        break;
    } while (accept(","));
    if (!is(")")) fail(token_.offset, "unexpected " + quoted(token_), "\",\" or \")\"");
    const int count = static_cast<int>(values.size());
    const bool fits = count >= function->min && count <= function->max &&
                      !(function->operation == Operation::clip && count == 2);
    if (!fits)
      fail(name.offset, fmt::format("{} with {} value{}", name.text, count, count == 1 ? "" : "s"),
           call_form(function->name));
    next();
    switch (count) {
      case 1:
        if (function->operation == Operation::clip)
          return emit(Operation::clip, {values[0], constant(0.0), constant(1.0)});
        return emit(function->operation, {values[0]});
      case 2:
        return emit(function->operation, {values[0], values[1]});
      case 3:
        return emit(function->operation, {values[0], values[1], values[2]});
      default:
        return emit(function->operation, {values[0], values[1], values[2], values[3]});
    }
  }

  static std::string call_form(std::string_view name) {
    if (name == "min" || name == "max") return fmt::format("{}(a, b, …)", name);
    if (name == "clip" || name == "clamp") return fmt::format("{0}(x) or {0}(x, low, high)", name);
    if (name == "smoothstep") return "smoothstep(x, low, high)";
    if (name == "hat") return "hat(x, low, high, width)";
    return fmt::format("{}(x)", name);
  }

  [[noreturn]] void fail_unknown(const Token& token, std::string_view what,
                                 const std::vector<std::string>& known) const {
    fail(token.offset,
         fmt::format("unknown {} \"{}\"{}", what, token.text, nearest_word_hint(token.text, known)),
         fmt::format("{}", fmt::join(known, ", ")));
  }

  // Counts nesting, so that a hostile file cannot exhaust the stack.
  class Depth {
   public:
    explicit Depth(RuleCompiler& compiler) : compiler_(compiler) {
      if (++compiler_.depth_ > deepest_nesting)
        compiler_.fail(compiler_.token_.offset, "expression nested too deeply",
                       fmt::format("at most {} levels", deepest_nesting / 2));
    }
    ~Depth() { --compiler_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    RuleCompiler& compiler_;
  };

  RuleExpression& out_;
  const std::string& text_;
  const RuleNames& names_;
  const std::string& where_;
  ConfigPosition position_;
  std::vector<float> constants_;
  Token token_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int top_ = 0;
};

RuleExpression::RuleExpression(const std::string& text, const RuleNames& names,
                               const std::string& where, ConfigPosition position) {
  RuleCompiler(*this, text, names, where, position).compile();
}

}  // namespace belvedere
