#include "tools/cli/features/swatches.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/grids.h"
#include "tests/paths.h"

namespace belvedere::tools {
namespace {

// Every painted kind of the built-in styles is visible in both seasons, and is in the
// documentation.
TEST(Swatches, EveryKindThatIsPaintedIsSeenAndDocumented) {
  std::ifstream file(test::source_folder() + "/docs/features.md");
  std::stringstream text;
  text << file.rdbuf();
  for (const char* name : {"classic", "ski"}) {
    const FeatureStyle style = load_feature_style(name);
    FeatureStyle none = style;
    const int bare = style.find("path");
    none.kinds[static_cast<std::size_t>(bare)].width_mm = 0.0;
    none.kinds[static_cast<std::size_t>(bare)].min_px = 0.0;
    const Grid<glm::vec3> ground = make_swatch(none, bare);
    for (std::size_t k = 0; k < style.kinds.size(); ++k) {
      const Grid<glm::vec3> swatch = make_swatch(style, static_cast<int>(k));
      EXPECT_THAT(text.str(), testing::HasSubstr('`' + style.kinds[k].name + '`'));
      if (swatch.empty()) {
        EXPECT_TRUE(style.kinds[k].ground) << style.kinds[k].name;
        continue;
      }
      EXPECT_THAT(text.str(),
                  testing::HasSubstr("images/features/" + style.kinds[k].name + ".jpg"));
      int summer = 0;
      int winter = 0;
      for (const auto [x, y] : test::cells(swatch))
        if (swatch(x, y) != ground(x, y)) ++(2 * x < swatch.width() ? summer : winter);
      EXPECT_GT(summer, 150) << style.kinds[k].name;
      EXPECT_GT(winter, 150) << style.kinds[k].name;
    }
  }
}

}  // namespace
}  // namespace belvedere::tools
