#include "texture/synthesis/guide_stack.h"

#include <fmt/core.h>

#include "base/error.h"

namespace belvedere {

void check_guide_stack(const GuideStack& stack, const std::string& where) {
  if (stack.label.empty())
    throw Error(ErrorKind::usage, where, "no labels", "a label (class) for every pixel");
  const std::string size =
      fmt::format("{} × {}, the size of its labels", stack.width(), stack.height());
  for (std::size_t i = 0; i < stack.guides.size(); ++i) {
    const Guide& guide = stack.guides[i];
    if (guide.name.empty())
      throw Error(ErrorKind::usage, where, "a guide without a name", "a name such as \"altitude\"");
    for (std::size_t j = 0; j < i; ++j) {
      if (stack.guides[j].name == guide.name) {
        throw Error(ErrorKind::usage, where, fmt::format("two guides named \"{}\"", guide.name),
                    "unique names");
      }
    }
    if (!guide.values.same_size(stack.label)) {
      throw Error(ErrorKind::usage, where,
                  fmt::format("guide \"{}\" of {} × {} pixels", guide.name, guide.values.width(),
                              guide.values.height()),
                  size);
    }
  }
  if (!stack.depth_m.empty() && !stack.depth_m.same_size(stack.label)) {
    throw Error(
        ErrorKind::usage, where,
        fmt::format("depths of {} × {} pixels", stack.depth_m.width(), stack.depth_m.height()),
        size);
  }
}

}  // namespace belvedere
