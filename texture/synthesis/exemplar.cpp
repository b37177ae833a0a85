#include "texture/synthesis/exemplar.h"

#include <fmt/format.h>

#include "base/error.h"

namespace belvedere {

void check_exemplar(const Exemplar& exemplar) {
  const std::string where = fmt::format("exemplar \"{}\"", exemplar.name);
  const Grid<Rgb8>& picture = exemplar.picture;
  if (picture.empty()) throw Error(ErrorKind::usage, where, "no picture", "a picture and a label for each of its texels");
  if (picture.width() > Exemplar::largest_side || picture.height() > Exemplar::largest_side) {
    throw Error(ErrorKind::limit, where, fmt::format("{} × {} texels", picture.width(), picture.height()),
                fmt::format("at most {} texels on a side", Exemplar::largest_side));
  }
  check_guide_stack(exemplar.guides, where);
  if (!picture.same_size(exemplar.guides.label)) {
    throw Error(ErrorKind::usage, where, fmt::format("labels of {} × {}", exemplar.guides.width(), exemplar.guides.height()),
                fmt::format("{} × {}, the size of its picture", picture.width(), picture.height()));
  }
}

}  // namespace belvedere
