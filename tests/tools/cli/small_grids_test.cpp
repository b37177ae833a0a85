// Every command on grids that are as small as grids can be: a result or an error, never a signal, a
// bug or a value that is no number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/cli/small_commands.h"
#include "tools/cli/commands.h"

namespace belvedere {
namespace {

using test::GridSize;
using test::SmallCase;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class SmallGrids : public test::SmallCommands, public ::testing::WithParamInterface<SmallCase> {
 protected:
  void run_on(const std::vector<GridSize>& sizes);
};

void SmallGrids::run_on(const std::vector<GridSize>& sizes) {
  for (const GridSize& size : sizes) {
    write_files(size);
    const std::string label =
        fmt::format("{} of {} x {}", GetParam().command, size.width, size.height);
    for (std::size_t i = 0; i < GetParam().lines.size(); ++i) {
      const Outcome outcome = run(line_of(GetParam(), i), without_cache());
      EXPECT_THAT(outcome.status, AnyOf(0, 2, 3, 5)) << label << ": " << outcome.err;
      EXPECT_THAT(outcome.out + outcome.err, Not(ContainsRegex("(^|[^a-z])-?nan([^a-z]|$)")))
          << label;
      if (outcome.status != 0 && GetParam().command != "verify") {  // whose result is a list
        EXPECT_THAT(outcome.err, HasSubstr("belvedere: ")) << label;
        EXPECT_THAT(outcome.out, testing::IsEmpty()) << label;
      }
    }
  }
}
TEST_P(SmallGrids, EndWithAResultOrAnError) { run_on({{1, 1, false}}); }
INSTANTIATE_TEST_SUITE_P(Commands, SmallGrids, ::testing::ValuesIn(test::small_cases),
                         test::name_of_case);

// A flat one of an ordinary size is a division by nothing as well.
using SmallGridsLong = SmallGrids;
TEST_P(SmallGridsLong, EndWithAResultOrAnError) {
  run_on({{1, 9, false}, {9, 1, false}, {2, 2, false}, {12, 12, true}});
}
INSTANTIATE_TEST_SUITE_P(Commands, SmallGridsLong, ::testing::ValuesIn(test::small_cases),
                         test::name_of_case);

TEST(SmallGridsTable, HasEveryCommand) {
  std::set<std::string> covered = test::without_grids;
  covered.insert(test::serving.begin(), test::serving.end());
  for (const SmallCase& row : test::small_cases) covered.insert(row.command);
  std::set<std::string> known;
  for (const tools::Command& row : tools::all_commands())
    known.insert(*row.group == '\0' ? row.name : std::string(row.group) + " " + row.name);
  EXPECT_EQ(covered, known) << "a command is missing in the table, or is no longer there";
}

}  // namespace
}  // namespace belvedere
