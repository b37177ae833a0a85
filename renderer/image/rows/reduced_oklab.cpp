#include "renderer/image/rows/reduced_oklab.h"

#include <cstdint>
#include <utility>

#include "base/parallel.h"
#include "renderer/image/oklab.h"

namespace belvedere {

Grid<glm::vec3> reduced_oklab(const Grid<glm::vec3>& picture, glm::ivec2 size) {
  const auto range = [](int i, int count, int whole) {
    const std::int64_t from = std::int64_t{i} * whole / count;
    const std::int64_t to = (std::int64_t{i + 1} * whole + count - 1) / count;
    return std::pair(static_cast<int>(from), static_cast<int>(to));
  };
  Grid<glm::vec3> out(size.x, size.y);
  parallel_rows(size.y, [&](int y) {
    const auto [top, bottom] = range(y, size.y, picture.height());
    for (int x = 0; x < size.x; ++x) {
      const auto [left, right] = range(x, size.x, picture.width());
      glm::dvec3 sum(0.0);
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) sum += glm::dvec3(picture(u, v));
      out(x, y) = glm::vec3(
          to_oklab(glm::vec3(sum / static_cast<double>((bottom - top) * (right - left)))));
    }
  });
  return out;
}

}  // namespace belvedere
