#include "tools/cli/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <map>
#include <new>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/memory/zeroed_memory.h"
#include "renderer/image/provenance.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

constexpr const char* program_meaning = "renders panorama maps in the look of a painting";

constexpr const char* program_description =
    "Belvedere renders panorama maps in the look of a painting, from an elevation model,\n"
    "a land-cover map and a scene file with the viewpoint and the direction of view.\n"
    "\n"
    "  belvedere render                                      a demo; needs no data\n"
    "  belvedere check scenes/karwendel.toml --data ../data  checks a scene and its files\n"
    "  belvedere render scenes/karwendel.toml --data ../data --out karwendel\n"
    "  belvedere COMMAND --help                              help on one command";

constexpr const char* program_footer =
    "Exit status: 0 done, 1 diff or verify found a difference, 2 command line or scene file, 3 "
    "input data, 4 output, 5 over a limit\n"
    "(memory, size), 75 interrupted, 70 internal error.";

using Groups = std::map<std::string, CommandOptions>;

// Groups are listed in the help where their first command is.
CommandOptions& group_of(const std::string& name, CommandOptions& program, Groups& made) {
  if (name.empty()) return program;
  if (const auto found = made.find(name); found != made.end()) return found->second;
  for (const CommandGroup& group : command_groups())
    if (name == group.name)
      return made.emplace(name, program.add_command(group.name, group.meaning, group.heading))
          .first->second;
  throw Error(ErrorKind::bug, "command table", "there is no group " + name);
}

struct Program {
  CommandLine line{"belvedere", program_description,
                   "belvedere " + program_version() + "\n" + library_versions()};
  std::vector<std::pair<CommandOptions, Action>> actions;

  Program() {
    line.options().footer(program_footer);
    Groups groups;
    for (const Command& row : all_commands()) {
      CommandOptions command = group_of(row.group, line.options(), groups)
                                   .add_command(row.name, row.meaning,
                                                row.heading != nullptr ? row.heading : "Commands");
      const Action action = row.add(command);
      actions.emplace_back(command, action);
    }
  }
};

// Where the command line ends before a command, or continues with an unknown word: CLI11 answers "A
// subcommand is required" to both. Nothing where a command was found.
void require_command(const CommandDescription& program, const std::vector<std::string>& arguments) {
  const CommandDescription* group = &program;
  std::string word;
  for (const std::string& next : arguments) {
    if (next.starts_with('-')) continue;
    const auto known = std::find_if(group->commands.begin(), group->commands.end(),
                                    [&](const auto& command) { return command.word() == next; });
    if (known == group->commands.end()) {
      word = next;
      break;
    }
    group = &*known;
    if (group->commands.empty()) return;
  }
  std::vector<std::string> names;
  for (const CommandDescription& command : group->commands) names.push_back(command.word());
  const std::string allowed = fmt::format("{}; see {} --help", fmt::join(names, ", "), group->name);
  if (word.empty())
    throw Error(ErrorKind::usage, "command line",
                fmt::format("missing subcommand of {}", group->name), allowed);
  throw Error(
      ErrorKind::usage, "command line",
      fmt::format("{} has no command \"{}\"{}", group->name, word, nearest_word_hint(word, names)),
      allowed);
}

}  // namespace

int run_program(const std::vector<std::string>& words) {
  Program program;
  std::string text;
  try {
    text = program.line.read(words);
  } catch (const Error&) {
    require_command(program.line.options().describe(), words);
    throw;
  }
  if (!text.empty()) {
    print_out(text);
    return 0;
  }
  try {
    program.line.declare_files();
    for (const auto& [command, run] : program.actions)
      if (command.is_named()) return run();
  } catch (...) {
    file_guard().remove_empty_folders();
    throw;
  }
  throw Error(ErrorKind::bug, "command line", "a command that does nothing");
}

CommandDescription describe_program() {
  Program program;
  CommandDescription out = program.line.options().describe();
  out.description = std::exchange(out.meaning, program_meaning);
  return out;
}

int program_main(int argc, char** argv) {
  prepare_process();
  reuse_freed_memory();
  const auto fail = [](const std::string& message, ErrorKind kind) {
    print_error("belvedere: " + message + "\n");
    return static_cast<int>(kind);
  };
  try {
    const int status = run_program({argv + (argc > 0 ? 1 : 0), argv + argc});
    finish_output();
    return status;
  } catch (const Error& error) {
    const std::string asked =
        error.kind() == ErrorKind::bug
            ? "\n"
              "  This is a bug of the program, not an error in your data. Please report it."
            : "";
    return fail(error.what() + asked, error.kind());
  } catch (const std::bad_alloc&) {
    return fail(
        "not enough memory\n"
        "  allowed: a smaller output.width and output.height, or a smaller terrain.extent",
        ErrorKind::limit);
  } catch (const std::exception& error) {
    return fail(std::string("internal error: ") + error.what() +
                    "\n"
                    "  This is a bug of the program, not an error in your data. Please report it.",
                ErrorKind::bug);
  } catch (...) {
    return fail(
        "internal error without a description\n"
        "  This is a bug of the program. Please report it.",
        ErrorKind::bug);
  }
}

}  // namespace belvedere::tools
