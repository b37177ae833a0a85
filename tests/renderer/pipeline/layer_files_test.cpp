// Layers of a whole picture: those over its strokes are roads, lifts, names. Unpacked by Python.
#include "renderer/pipeline/layer_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "base/cache/cache.h"
#include "base/grid_part.h"
#include "renderer/image/image_io.h"
#include "renderer/pipeline/pipeline.h"
#include "tests/files.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

struct Layer {
  Grid<glm::vec3> colour;
  Grid<float> opacity;
};

class LayerFiles : public testing::Test {
 protected:
  // Every layer's own picture is in an archive at OUT/layers.
  std::string make(const std::string& name, const std::vector<std::string>& more,
                   const SheetRequest& request = {}) const {
    std::vector<std::string> settings = {"output.width=320", "output.height=200",
                                         "output.formats=[\"tif\"]", "synthesis.enabled=false"};
    settings.insert(settings.end(), more.begin(), more.end());
    SheetRequest own = request;
    own.layers = {"ora"};
    own.channels = GuidanceChoice{std::vector<std::string>{}};
    const std::string out = folder_ / name;
    render(test::small_scene(settings, folder_.path()), out, {.cache = test::shared_cache()}, own);
    EXPECT_EQ(std::system(("cd " + out + " && python3 -m zipfile -e panorama.ora layers").c_str()),
              0);
    return out;
  }
  static Layer layer(const std::string& out, const std::string& name) {
    Layer one;
    one.colour = read_picture(out + "/layers/data/" + name + ".png", &one.opacity);
    return one;
  }
  static double max_off(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
    double off = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (int c = 0; c < 3; ++c)
        off = std::max(off, static_cast<double>(std::abs(a[i][c] - b[i][c])));
    return off;
  }
  test::Folder folder_;
};

TEST_F(LayerFiles, NamesAreAHiddenLayerThatMakesThePictureWithNames) {
  const std::vector<std::string> named = {"labels.summits=6", "labels.in_picture=true",
                                          "labels.min_prominence_m=40"};
  const std::string out = make("whole", named);
  EXPECT_NE(
      test::read_bytes(out + "/layers/stack.xml")
          .find("src=\"data/names.png\" x=\"0\" y=\"0\" opacity=\"1.0\" visibility=\"hidden\""),
      std::string::npos);
  const Layer names = layer(out, "names");
  Grid<glm::vec3> picture = read_picture(out + "/panorama.tif");
  const Grid<glm::vec3> clean = picture;
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture[i] += names.opacity[i] * (names.colour[i] - picture[i]);
  EXPECT_GT(max_off(picture, clean), 0.3);
  EXPECT_LT(max_off(picture, read_picture(out + "/panorama_names.tif")), 1e-3);
  const PixelRect part{60, 20, 260, 140};
  SheetRequest request;
  request.part = part;
  const Layer cut = layer(make("part", named, request), "names");
  EXPECT_TRUE(cut.opacity == part_of(names.opacity, part));
  EXPECT_TRUE(cut.colour == part_of(names.colour, part));
}

TEST_F(LayerFiles, ASceneWithoutRoadsAndNamesHasNoLayersOfThem) {
  const std::string out = make("bare", {});
  EXPECT_TRUE(fs::exists(out + "/layers/data/ground.png"));
  EXPECT_FALSE(fs::exists(out + "/layers/data/features.png"));
  EXPECT_FALSE(fs::exists(out + "/layers/data/names.png"));
  const std::string lost =
      make("lost", {"labels.points.0={ file = \"none.csv\", optional = true }"});
  EXPECT_FALSE(fs::exists(lost + "/layers/data/names.png")) << "nothing is there to name";
}

}  // namespace
}  // namespace belvedere
