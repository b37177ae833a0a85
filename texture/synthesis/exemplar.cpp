#include "texture/synthesis/exemplar.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace belvedere {

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
