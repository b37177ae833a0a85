#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/grid.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/terrain/generalize/plan_curvature.h"

namespace belvedere {
namespace {

constexpr int size = 100;
constexpr double grass_cell_m = 20.0;

TEST(PlanCurvature, IsTheNegativeOfGrassPlanc) {
  // r.param.scale fits the same quadric to 3 × 3 cells; its planc counts hollows as positive.
  if (std::system("test -x /usr/bin/grass") != 0)
    GTEST_SKIP() << "needs GRASS GIS (Debian: grass-core)";
  Grid<float> hills = test::grid_of(size, size, [&](int x, int y) {
    return 12.0 * x - 7.0 * y + 90.0 * std::sin(x / 7.0) * std::cos(y / 9.0) +
           40.0 * std::sin((x + 2 * y) / 11.0);
  });
  const test::Folder folder;
  folder.write("z.bin",
               {reinterpret_cast<const char*>(hills.data()), hills.size() * sizeof(float)});
  folder.write("run.sh",
               "set -e\n"
               "g.region n=2000 s=0 e=2000 w=0 rows=100 cols=100\n"
               "r.in.bin -f input=z.bin output=z bytes=4 north=2000 south=0 east=2000 west=0 "
               "rows=100 cols=100\n"
               "for run in 1 2; do\n"
               "  r.param.scale --overwrite input=z output=k method=planc size=3\n"
               "  r.out.bin -f input=k output=$1.$run bytes=4 null=-9999\n"
               "done\n");
  const auto planc = [&](const std::string& name) {
    const std::string command = "cd '" + folder.path() +
                                "' && grass --tmp-location XY --exec bash run.sh " + name +
                                " > log.txt 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << test::read_bytes(folder / "log.txt");
    return std::array{test::read_bytes(folder / (name + ".1")),
                      test::read_bytes(folder / (name + ".2"))};
  };
  // r.param.scale occasionally fails: two equal results are right.
  std::vector<std::string> runs;
  std::string bytes;
  bool agreed = false;
  for (int i = 0; i < 4 && !agreed; ++i)
    for (const std::string& run : planc(std::to_string(i))) {
      if (agreed) break;
      bytes = run;
      agreed = std::find(runs.begin(), runs.end(), bytes) != runs.end();
      runs.push_back(bytes);
    }
  ASSERT_TRUE(agreed);
  ASSERT_EQ(bytes.size(), hills.size() * sizeof(float));
  Grid<float> theirs(size, size);
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<char*>(theirs.data()));
  const Grid<float> ours = test::curvature_by_rows(hills, grass_cell_m, true);
  double largest = 0.0;
  for (int y = 1; y + 1 < size; ++y)
    for (int x = 1; x + 1 < size; ++x) {
      // Their results are floats from differences of large sums: accurate to a fraction of the
      // curvature, or of that of a circle of 100 km.
      EXPECT_NEAR(theirs(x, y), -ours(x, y), 1e-3 * std::abs(ours(x, y)) + 1e-5) << x << ' ' << y;
      largest = std::max(largest, std::abs(static_cast<double>(ours(x, y))));
    }
  EXPECT_GT(largest, 1e-3);
}

}  // namespace
}  // namespace belvedere
