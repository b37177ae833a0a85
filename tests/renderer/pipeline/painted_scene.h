#pragma once

#include <string>
#include <vector>

#include "renderer/image/image_io.h"
#include "tests/grids.h"
#include "tests/renderer/image/picture_bytes.h"
#include "tests/scenes.h"

namespace belvedere::test {

// A painting of reds beside a scene: eleven stripes, one for each class from id 1 on but those from
// `classes` on, each lighter to the right.
inline void write_painting(const Folder& folder, int classes = 12) {
  constexpr int stripe = 8;
  Grid<glm::vec3> red(12 * stripe, 40);
  std::string ids;
  for (const auto [x, y] : test::cells(red)) {
    const float light = static_cast<float>(x % stripe) / static_cast<float>(stripe);
    red(x, y) = glm::vec3(0.3F + 0.6F * light, 0.1F + 0.2F * light, 0.05F);
    ids += static_cast<char>(1 + (x / stripe) % classes);
  }
  write_png8(folder / "red.png", red, {});
  write_bytes(folder / "classes.png", make_png(red.width(), red.height(), 8, 0, ids));
}

// The small scene with that painting.
inline LoadedScene painted_scene(const Folder& folder, std::vector<std::string> settings = {}) {
  settings.insert(settings.begin(),
                  "exemplar.0={ picture = \"red.png\", classes = \"classes.png\", stroke_px = 1 }");
  return small_scene(settings, folder.path());
}

}  // namespace belvedere::test
