#include "tools/cli/program.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/files.h"
#include "tools/cli/commands.h"

namespace belvedere::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string refused_run(const std::vector<std::string>& arguments) {
  return test::usage_error([&] { run_program(arguments); });
}

TEST(ProgramRun, AsksForTheCommandAndNamesTheNearest) {
  EXPECT_THAT(refused_run({}), HasSubstr("missing subcommand of belvedere"));
  EXPECT_THAT(refused_run({"chekc"}), HasSubstr("did you mean \"check\"?"));
  EXPECT_THAT(refused_run({"exemplar", "chekc"}),
              HasSubstr("belvedere exemplar has no command \"chekc\"; did you mean \"check\"?"));
  EXPECT_THAT(refused_run({"exemplar", "render"}),
              HasSubstr("allowed: check, paint, pick, register, segment;"));
  EXPECT_THAT(refused_run({"--nonsense"}), HasSubstr("missing subcommand of belvedere"));
  // If the command is found, the error is in what follows.
  EXPECT_THAT(refused_run({"diff", "a"}), Not(HasSubstr("missing subcommand")));
}

const CommandDescription& find(const CommandDescription& in, const std::string& word) {
  const auto found = std::find_if(in.commands.begin(), in.commands.end(),
                                  [&](const auto& c) { return c.word() == word; });
  if (found == in.commands.end()) throw Error(ErrorKind::bug, "test", "there is no " + word);
  return *found;
}
const OptionDescription& option(const CommandDescription& in, const std::string& name) {
  const auto has = [&](const OptionDescription& o) {
    return std::find(o.names.begin(), o.names.end(), name) != o.names.end();
  };
  const auto found = std::find_if(in.options.begin(), in.options.end(), has);
  if (found == in.options.end()) throw Error(ErrorKind::bug, "test", "there is no " + name);
  return *found;
}

TEST(ProgramDescription, NamesEveryRowOfTheTable) {
  const CommandDescription program = describe_program();
  EXPECT_EQ(program.name, "belvedere");
  for (const Command& row : all_commands()) {
    const std::string group = row.group;
    const CommandDescription& command =
        find(group.empty() ? program : find(program, group), row.name);
    EXPECT_EQ(command.meaning, row.meaning);
    EXPECT_EQ(command.name, "belvedere " + (group.empty() ? "" : group + " ") + row.name);
  }
}

TEST(ProgramDescription, TellsOfOptionsWhatTheirValuesMayBe) {
  const CommandDescription program = describe_program();
  const CommandDescription& render = find(program, "render");
  EXPECT_TRUE(option(render, "SCENE").positional);
  EXPECT_THAT(option(render, "--quiet").names, ElementsAre("--quiet", "-q"));
  EXPECT_THAT(option(render, "--quiet").value, IsEmpty());
  EXPECT_EQ(option(render, "--tile").value, "N");
  EXPECT_EQ(option(render, "--tile").range, "8 … 4096");
  EXPECT_EQ(option(render, "--tile").preset, "32");
  EXPECT_EQ(option(render, "--data").value, "DIR");
  EXPECT_FALSE(option(render, "--out").required);
  const CommandDescription& synthesize = find(program, "synthesize");
  EXPECT_THAT(option(synthesize, "--harmonize").choices,
              ElementsAre("off", "common", "first", "regions"));
  EXPECT_EQ(option(synthesize, "--label").value, "STYLE TARGET");
  EXPECT_TRUE(option(synthesize, "--out").required);
  // A colon may be part of the name of a value.
  EXPECT_EQ(option(find(program, "deform"), "--bend").value, "M:DEG,M:DEG…");
}

}  // namespace
}  // namespace belvedere::tools
