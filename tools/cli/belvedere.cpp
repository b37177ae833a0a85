#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/error.h"
#include "renderer/image/provenance.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"

namespace {

using belvedere::Error;
using belvedere::ErrorKind;
using belvedere::tools::Command;

constexpr const char* description =
    "Belvedere renders panorama maps in the look of a painting, from an elevation model,\n"
    "a land-cover map and a scene file that says where you stand and where you look.\n\n"
    "  belvedere render                                      a demo; needs no data\n"
    "  belvedere check scenes/karwendel.toml --data ../data  is everything there?\n"
    "  belvedere render scenes/karwendel.toml --data ../data --out karwendel\n"
    "  belvedere COMMAND --help                              all about one command";

constexpr const char* footer =
    "Exit status: 0 done, 2 command line or scene file, 3 input data, 4 output, 5 over a limit\n"
    "(memory, size), 75 stopped by you, 70 a fault of the program.";

// Where the command line ends before a command, or goes on with a word that is none: CLI11 says "A subcommand is required" to both.
// Nothing where a command was found.
void require_command(const CLI::App& program, int argc, char** argv) {
  const CLI::App* group = &program;
  std::string so_far = "belvedere";
  std::string word;
  for (int i = 1; i < argc && word.empty(); ++i) {
    const std::string next = argv[i];
    if (next.starts_with('-')) continue;
    const auto known = group->get_subcommands([&](const CLI::App* command) { return command->get_name() == next; });
    if (known.empty()) {
      word = next;
      break;
    }
    group = known.front();
    so_far += " " + next;
    if (group->get_subcommands({}).empty()) return;
  }
  std::vector<std::string> names;
  std::string allowed;
  for (const CLI::App* command : group->get_subcommands({})) {
    names.push_back(command->get_name());
    allowed += (allowed.empty() ? "" : ", ") + names.back();
  }
  allowed += fmt::format(". {} --help says what each does", so_far);
  if (word.empty()) throw Error(ErrorKind::usage, "command line", fmt::format("what shall {} do?", so_far), allowed);
  const std::string near = belvedere::nearest_word(word, names);
  throw Error(ErrorKind::usage, "command line",
              fmt::format("{} has no command \"{}\"{}", so_far, word, near.empty() ? "" : "; did you mean \"" + near + "\"?"), allowed);
}

int run(int argc, char** argv) {
  CLI::App program(description, "belvedere");
  program.set_version_flag("--version", "belvedere " + belvedere::program_version() + "\n" + belvedere::library_versions());
  program.require_subcommand(1);
  program.footer(footer);
  program.get_formatter()->column_width(34);
  std::vector<Command> commands;
  for (const auto add : belvedere::tools::all_commands()) commands.push_back(add(program));
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help) {  // --help and --version
    std::ostringstream out;
    program.exit(help, out, out);
    std::string text = out.str();
    if (!text.ends_with('\n')) text += '\n';
    belvedere::tools::print_out(text);
    return 0;
  } catch (const CLI::ParseError& problem) {
    require_command(program, argc, argv);
    throw Error(ErrorKind::usage, "command line", problem.what(), "belvedere --help, or belvedere COMMAND --help, says what there is");
  }
  for (const Command& command : commands)
    if (command.options->parsed()) return command.run();
  throw Error(ErrorKind::bug, "command line", "a command that does nothing");
}

}  // namespace

int main(int argc, char** argv) {
  belvedere::tools::prepare_process();
  const auto fail = [](const std::string& message, ErrorKind kind) {
    belvedere::tools::print_error("belvedere: " + message + "\n");
    return static_cast<int>(kind);
  };
  try {
    const int status = run(argc, argv);
    belvedere::tools::finish_output();
    return status;
  } catch (const Error& error) {
    const std::string asked =
        error.kind() == ErrorKind::bug ? "\n  This is a fault of the program, not of your data. Please report it." : "";
    return fail(error.what() + asked, error.kind());
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory\n  allowed: a smaller output.width and output.height, or a smaller terrain.extent",
                ErrorKind::limit);
  } catch (const std::exception& error) {
    return fail(std::string("unexpected: ") + error.what() + "\n  This is a fault of the program, not of your data. Please report it.",
                ErrorKind::bug);
  } catch (...) {
    return fail("unexpected: an error without a description\n  This is a fault of the program. Please report it.", ErrorKind::bug);
  }
}
