#include "texture/synthesis/exemplar.h"

#include <algorithm>
#include <cmath>
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

void check_exemplar(const Exemplar& exemplar) {
  const std::string where = fmt::format("exemplar \"{}\"", exemplar.name);
  const Grid<Rgb8>& picture = exemplar.picture;
  if (picture.empty())
    throw Error(ErrorKind::usage, where, "no picture",
                "a picture and a label for each of its texels");
  if (picture.width() > Exemplar::largest_side || picture.height() > Exemplar::largest_side) {
    throw Error(ErrorKind::limit, where,
                fmt::format("{} × {} texels", picture.width(), picture.height()),
                fmt::format("at most {} texels on a side", Exemplar::largest_side));
  }
  check_guide_stack(exemplar.guides, where);
  if (!picture.same_size(exemplar.guides.label)) {
    throw Error(ErrorKind::usage, where,
                fmt::format("labels of {} × {}", exemplar.guides.width(), exemplar.guides.height()),
                fmt::format("{} × {}, the size of its picture", picture.width(), picture.height()));
  }
}

Rgb8 to_rgb8(glm::vec3 encoded) {
  Rgb8 rgb{};
  for (int c = 0; c < 3; ++c)
    rgb[static_cast<std::size_t>(c)] =
        static_cast<std::uint8_t>(std::lround(std::clamp(encoded[c], 0.F, 1.F) * 255.F));
  return rgb;
}

}  // namespace belvedere
