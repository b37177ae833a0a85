#include "tools/report/generalize_report_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/image/image_io.h"
#include "terrain/generalize/generalize_presets.h"
#include "terrain/generalize/mask.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

// A plain with a rough patch near the south-eastern corner and a smaller one in the north-western.
Grid<float> two_patches() {
  Grid<float> out(900, 900, 500.F);
  for (const auto [x, y] : test::cells(900, 900)) {
    const bool south = x > 600 && y > 600;
    const bool north = x < 150 && y < 150;
    if (south || north) out(x, y) += static_cast<float>(60.0 * std::abs(std::sin(x / 5.0)));
  }
  return out;
}
Grid<float> near_is_south(int side) {
  Grid<float> share(side, side);
  for (int y = 0; y < side; ++y)
    std::fill_n(share.row(y), side, static_cast<float>(y) / static_cast<float>(side));
  return share;
}

// The largest difference in steps of 8 bits; pictures of another size are as different as can be.
double largest_step(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
  if (!a.same_size(b)) return 255.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c)
      largest = std::max(largest, 255.0 * std::abs(static_cast<double>(a[i][c] - b[i][c])));
  return largest;
}

// Mean difference of neighbours along the row.
double roughness(const Grid<glm::vec3>& picture) {
  double sum = 0.0;
  for (const auto [x, y] : test::cells({1, 0, picture.width(), picture.height()}))
    sum += std::abs(picture(x, y).g - picture(x - 1, y).g);
  return sum / static_cast<double>(picture.size());
}

TEST(GeneralizeFigures, WindowsLieWhereRidgesAre) {
  const FigureWindows windows = choose_windows(two_patches(), {30.0, 30.0}, near_is_south(900));
  EXPECT_EQ(windows.ridges, (PixelRect{480, 480, 900, 900}));
  EXPECT_EQ(windows.near, windows.ridges) << "the near quarter has the same";
  EXPECT_EQ(windows.far, (PixelRect{0, 0, 420, 420})) << "of the far quarter the smaller patch";
}

// Each picture is that of its caption: made here from the terrain and the paper's parameters.
TEST(GeneralizeFigures, AddsTheFiveOfThePaper) {
  const test::Folder folder;
  Report page(folder.path());
  Grid<float> ground(120, 110);
  Grid<float> share(120, 110);
  for (const auto [x, y] : test::cells(120, 110)) {
    ground(x, y) = static_cast<float>(
        y > 80 ? 780.0 : 800.0 + 200.0 * std::abs(std::sin(x / 9.0)) + 8.0 * std::sin(y / 2.0));
    share(x, y) = static_cast<float>(y) / 110.F;
  }
  const glm::dvec2 cell{30.0, 30.0};
  const GeneralizeReportInput input{"t", "c", ground, ground, cell, {}, {}};
  add_paper_figures(page, input, share, choose_windows(ground, cell, share), silent_progress());
  const auto filtered = [&](const GeneralizeParameters& parameters,
                            const Grid<float>& distance = {}, const Grid<float>& mask = {}) {
    GeneralizeGrids grids;
    grids.foreground_share = distance;
    grids.mask = mask;
    return generalize(ground, cell, grids, parameters, silent_progress());
  };
  const GeneralizeParameters figure2 = find_generalize_preset("figure2")->bands;
  EXPECT_EQ(figure2.foreground, (std::vector<float>{1.F, 1.F, 2.F, .25F, 0.F}));
  GeneralizeParameters global;
  global.foreground = global.background = {1.F, 1.F, 0.4F, 0.1F, 0.F};
  GeneralizeParameters local = global;
  local.foreground_ridges = local.background_ridges = {0.F, 0.F, 0.7F, 1.F, 1.1F};
  local.foreground_valleys = local.background_valleys = {0.F, 0.F, 0.4F, 0.6F, 0.6F};
  const Grid<float> by_distance = filtered(find_generalize_preset("figure4")->bands, share);
  const auto relief = [&](const Grid<float>& altitude_m) {
    return relief_picture(altitude_m, cell, window_px);
  };
  const auto change = [&](const Grid<float>& after) {
    return change_picture(ground, after, cell, 20.F, window_px);
  };
  struct Expected {
    const char* file;
    const char* caption;
    Grid<glm::vec3> picture;
  };
  // The windows are the whole terrain, which is smaller than one.
  const std::vector<Expected> expected = {
      {"figure1_gaussian_5", "G5", {}},
      {"figure1_laplacian_1", "L1,", {}},
      {"figure2_original", "original", relief(ground)},
      {"figure2_filtered", "filtered", relief(filtered(figure2))},
      {"figure3_original", "original", relief(ground)},
      {"figure3_global", "the same weights everywhere", relief(filtered(global))},
      {"figure3_local", "additional weights along ridges", relief(filtered(local))},
      {"figure4_near_original", "near, original", relief(ground)},
      {"figure4_near_filtered", "near, filtered", relief(by_distance)},
      {"figure4_far_original", "far, original", relief(ground)},
      {"figure4_far_filtered", "far, filtered", relief(by_distance)},
      {"figure5_original", "original", relief(ground)},
      {"figure5_everywhere", "filtered everywhere", change(filtered(figure2))},
      {"figure5_masked", "steep ground only",
       change(filtered(figure2, {}, slope_mask(ground, cell, SlopeRange{})))}};
  const std::string text = page.page({});
  std::size_t at = 0;
  for (const auto& [file, caption, picture] : expected) {
    at = text.find("\"" + std::string(file) + ".png\"", at);
    ASSERT_NE(at, std::string::npos) << file << " in its order";
    const std::size_t words = text.find("\"caption\": \"", at) + 12;
    EXPECT_EQ(text.compare(words, std::string(caption).size(), caption), 0)
        << text.substr(words, 40);
    if (!picture.empty()) {
      EXPECT_LT(largest_step(read_picture(folder / (std::string(file) + ".png")), picture), 0.51)
          << file;
    }
  }
  // Figure 1: what is coarser has less detail.
  double before = 1e9;
  for (int level = 5; level >= 1; --level) {
    const double now =
        roughness(read_picture(folder / ("figure1_gaussian_" + std::to_string(level) + ".png")));
    EXPECT_LT(now, before) << level;
    before = now;
  }
}

}  // namespace
}  // namespace belvedere::tools
