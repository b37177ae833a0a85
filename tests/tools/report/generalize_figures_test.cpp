#include "tools/report/generalize_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/files.h"

namespace belvedere::tools {
namespace {

using ::testing::HasSubstr;

// A plain with a rough patch near the south-eastern corner and a smaller one in the north-western.
Grid<float> two_patches() {
  Grid<float> out(900, 900, 500.F);
  for (int y = 0; y < 900; ++y) {
    for (int x = 0; x < 900; ++x) {
      const bool south = x > 600 && y > 600;
      const bool north = x < 150 && y < 150;
      if (south || north) out(x, y) += static_cast<float>(60.0 * std::abs(std::sin(x / 5.0)));
    }
  }
  return out;
}
Grid<float> near_is_south(int side) {
  Grid<float> share(side, side);
  for (int y = 0; y < side; ++y)
    std::fill_n(share.row(y), side, static_cast<float>(y) / static_cast<float>(side));
  return share;
}

TEST(GeneralizeFigures, WindowsLieWhereRidgesAre) {
  const FigureWindows windows = choose_windows(two_patches(), {30.0, 30.0}, near_is_south(900));
  EXPECT_EQ(windows.ridges, (PixelRect{480, 480, 900, 900}));
  EXPECT_EQ(windows.near, windows.ridges) << "the near quarter has the same";
  EXPECT_EQ(windows.far, (PixelRect{0, 0, 420, 420})) << "of the far quarter the smaller patch";
}

TEST(GeneralizeFigures, AddsTheFiveOfThePaper) {
  const test::Folder folder;
  Report page(folder.path());
  Grid<float> ground(120, 110);
  for (int y = 0; y < 110; ++y)
    for (int x = 0; x < 120; ++x)
      ground(x, y) = static_cast<float>(800.0 + 200.0 * std::abs(std::sin(x / 9.0)) + y);
  const GeneralizeGrids grids;
  const GeneralizeParameters parameters;
  const GeneralizeReportInput input{"t", "c", ground, ground, {30.0, 30.0}, grids, parameters};
  const Grid<float> share(120, 110, 0.5F);
  add_paper_figures(page, input, share, choose_windows(ground, input.cell_m, share),
                    silent_progress());
  const std::string text = page.page({});
  for (const char* id : {"figure1", "figure2", "figure3", "figure4", "figure5"})
    EXPECT_THAT(text, HasSubstr(std::string("\"id\": \"") + id + "\"")) << id;
  EXPECT_TRUE(std::ifstream(folder / "figure5_masked.png").good());
}

}  // namespace
}  // namespace belvedere::tools
