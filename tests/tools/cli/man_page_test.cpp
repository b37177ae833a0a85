#include "tools/cli/man_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/files.h"
#include "tools/cli/program.h"

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

CommandDescription toy() {
  CommandDescription cut{.name = "toy cut",
                         .meaning = "Cuts",
                         .description = {},
                         .footer = ".5 or 'half'\n\n  toy cut a\\b",
                         .options = {},
                         .commands = {}};
  cut.options.push_back({.names = {"--at", "-a"},
                         .value = "X…",
                         .meaning = "Where",
                         .range = "0 … 1",
                         .choices = {},
                         .preset = ".5",
                         .positional = false,
                         .required = false});
  cut.options.push_back({.names = {"FILE"},
                         .value = "TEXT",
                         .meaning = "What",
                         .range = {},
                         .choices = {"a", "b"},
                         .preset = {},
                         .positional = true,
                         .required = true});
  return {.name = "toy",
          .meaning = "plays",
          .description = "Plays.",
          .footer = "0 done",
          .options = {},
          .commands = {cut}};
}

TEST(ManPage, SaysOptionsInTheMacrosOfMan) {
  const std::string page = man_page(toy(), "toy 1.0");
  EXPECT_THAT(page, AllOf(HasSubstr(".TH TOY 1 \"\" \"toy 1.0\""), HasSubstr("toy \\- plays\n"),
                          HasSubstr(".SS toy cut\nCuts.\n"),
                          HasSubstr("\\fBtoy cut\\fR \\fIFILE\\fR [\\fIOPTION\\fR ...]"),
                          HasSubstr(".TP\n\\fB\\-\\-at\\fR, \\fB\\-a\\fR \\fIX\\[u2026]\\fR\nWhere "
                                    "[0 \\[u2026] 1] (default: .5)\n"),
                          HasSubstr(".TP\n\\fIFILE\\fR\nWhat [a, b]\n")));
  EXPECT_LT(page.find("\\fIFILE\\fR\n"), page.find("\\-\\-at")) << "arguments come first";
}

TEST(ManPage, ShowsTextAsItStands) {
  // A point or an apostrophe at the beginning of a line would be a request, a backslash an escape.
  EXPECT_THAT(man_page(toy(), "toy 1.0"),
              HasSubstr(".nf\n\\&.5 or \\(aqhalf\\(aq\n.sp\n  toy cut a\\(rsb\n.fi\n"));
}

TEST(ManPage, OfTheProgramNamesEveryCommandAndOptionAndIsAscii) {
  const CommandDescription program = describe_program();
  const std::string page = man_page(program, "belvedere 0");
  for (const char c : page) ASSERT_EQ(c & 0x80, 0) << c;
  const auto look = [&](const CommandDescription& command, const auto& again) -> void {
    for (const CommandDescription& one : command.commands) again(one, again);
    if (!command.commands.empty()) return;
    const std::string heading = ".SS " + command.name + "\n";
    const std::size_t from = page.find(heading);
    ASSERT_NE(from, std::string::npos) << command.name;
    const std::string section = page.substr(from, page.find("\n.S", from + heading.size()) - from);
    for (const OptionDescription& option : command.options)
      for (std::string name : option.names) {
        for (std::size_t i = 0; (i = name.find('-', i)) != std::string::npos; i += 2)
          name.insert(i, "\\");
        EXPECT_THAT(section, HasSubstr(name)) << command.name;
      }
  };
  look(program, look);
}

TEST(ManPage, PassesGroffWithoutAWarning) {
  if (!std::filesystem::exists("/usr/bin/groff")) GTEST_SKIP() << "no groff here";
  const test::Folder folder;
  const std::string page = folder.write("page.1", man_page(describe_program(), "belvedere 0"));
  const std::string command = "groff -ww -man -Tutf8 -P-c -P-b -P-u '" + page + "' > '" +
                              (folder / "text") + "' 2> '" + (folder / "warnings") + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(test::read_bytes(folder / "warnings"), IsEmpty());
  const std::string text = test::read_bytes(folder / "text");
  EXPECT_NE(text.find("belvedere synthesize --picture STYLE --out FILE [OPTION ...]"),
            std::string::npos);
  EXPECT_EQ(text.find("\\f"), std::string::npos) << "a macro is shown instead of done";
}

}  // namespace
}  // namespace belvedere::tools
