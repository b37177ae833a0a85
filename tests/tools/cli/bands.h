#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "base/random.h"
#include "tests/renderer/image/picture_bytes.h"

// A painting of 120 × 90 pixels for tests of commands that look for classes.
namespace belvedere::test {

// Sky above, forest and meadow below.
inline glm::vec3 band_colour(int x, int y) {
  const glm::vec3 colour = y < 30
                               ? glm::vec3(.55F, .7F, .9F)
                               : (x < 60 ? glm::vec3(.12F, .25F, .1F) : glm::vec3(.6F, .75F, .35F));
  return colour + glm::vec3(static_cast<float>(random_index(20, 5, x / 2, y / 2)) / 400.F);
}

// The colours under what is transparent, of cut-out pictures that differ by them alone.
inline const std::string hidden_colours[] = {{"\xff\0\xff\0", 4}, {"\0\xff\0\0", 4}};

// A picture as PNG, transparent from column 80 on.
inline std::string cut_out(const Grid<glm::vec3>& picture, const std::string& hidden) {
  std::string rows;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      for (int c = 0; x < 80 && c < 3; ++c)
        rows += static_cast<char>(std::lround(picture(x, y)[c] * 255.F));
      rows += x < 80 ? "\xff" : hidden;
    }
  return make_png(picture.width(), picture.height(), 8, 6, rows);
}

}  // namespace belvedere::test
