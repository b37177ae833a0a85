#include "tools/cli/program.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <sstream>
#include <utility>

#include "base/config.h"
#include "base/error.h"
#include "renderer/image/provenance.h"
#include "tools/cli/commands.h"
#include "tools/cli/terminal.h"

namespace belvedere::tools {
namespace {

constexpr const char* meaning = "renders panorama maps in the look of a painting";

constexpr const char* description =
    "Belvedere renders panorama maps in the look of a painting, from an elevation model,\n"
    "a land-cover map and a scene file that says where you stand and where you look.\n\n"
    "  belvedere render                                      a demo; needs no data\n"
    "  belvedere check scenes/karwendel.toml --data ../data  is everything there?\n"
    "  belvedere render scenes/karwendel.toml --data ../data --out karwendel\n"
    "  belvedere COMMAND --help                              all about one command";

constexpr const char* footer =
    "Exit status: 0 done, 1 diff or verify found a difference, 2 command line or scene file, 3 input data, 4 output, 5 over a limit\n"
    "(memory, size), 75 stopped by you, 70 a fault of the program.";

struct Program {
  std::unique_ptr<CLI::App> options;
  std::vector<std::pair<const CLI::App*, Action>> actions;
};

CLI::App& group_of(CLI::App& program, const std::string& name) {
  if (name.empty()) return program;
  const auto made = program.get_subcommands([&](const CLI::App* command) { return command->get_name() == name; });
  if (!made.empty()) return *made.front();
  for (const CommandGroup& group : command_groups())
    if (name == group.name) return *program.add_subcommand(group.name, group.meaning)->require_subcommand(1);
  throw Error(ErrorKind::bug, "command table", "there is no group " + name);
}

Program make_program() {
  Program program;
  program.options = std::make_unique<CLI::App>(description, "belvedere");
  CLI::App& options = *program.options;
  options.set_version_flag("--version", "belvedere " + program_version() + "\n" + library_versions());
  options.require_subcommand(1);
  options.footer(footer);
  options.get_formatter()->column_width(34);
  for (const Command& row : all_commands()) {
    CLI::App* command = group_of(options, row.group).add_subcommand(row.name, row.meaning);
    program.actions.emplace_back(command, row.add(*command));
  }
  return program;
}

// Where the command line ends before a command, or goes on with a word that is none: CLI11 says "A subcommand is required" to both.
// Nothing where a command was found.
void require_command(const CLI::App& program, const std::vector<std::string>& arguments) {
  const CLI::App* group = &program;
  std::string so_far = "belvedere";
  std::string word;
  for (const std::string& next : arguments) {
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
  const std::string near = nearest_word(word, names);
  throw Error(ErrorKind::usage, "command line",
              fmt::format("{} has no command \"{}\"{}", so_far, word, near.empty() ? "" : "; did you mean \"" + near + "\"?"), allowed);
}

// CLI11 writes what checks say of a value behind its name: "HOW:{off,common}", "N:INT in [8 - 4096]".
void describe_value(const CLI::Option& option, OptionDescription& out) {
  const std::string text = option.get_type_name();
  std::size_t end = text.size();
  for (const char* check : {":{", ":INT in [", ":UINT in [", ":FLOAT in [", ":NONNEGATIVE", ":POSITIVE"})
    end = std::min(end, text.find(check));
  out.value = text.substr(0, end);
  const std::string check = text.substr(end);
  if (check.starts_with(":{")) {
    std::istringstream choices(check.substr(2, check.rfind('}') - 2));
    for (std::string choice; std::getline(choices, choice, ',');) out.choices.push_back(choice);
  }
  const std::size_t from = check.find('[');
  const std::size_t between = check.find(" - ", from);
  if (from != std::string::npos && between != std::string::npos)
    out.range = check.substr(from + 1, between - from - 1) + " … " + check.substr(between + 3, check.rfind(']') - between - 3);
}

OptionDescription describe_option(const CLI::Option& option) {
  OptionDescription out;
  out.positional = !option.nonpositional();
  if (out.positional) out.names.push_back(option.get_name(true));
  for (const std::string& name : option.get_lnames()) out.names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) out.names.push_back("-" + name);
  out.meaning = option.get_description();
  out.required = option.get_required();
  out.preset = option.get_default_str();
  if (option.get_items_expected_max() > 0) describe_value(option, out);
  return out;
}

CommandDescription describe_command(const CLI::App& command, const std::string& before) {
  CommandDescription out{.name = before + command.get_name(),
                         .meaning = command.get_description(),
                         .description = {},
                         .footer = command.get_footer(),
                         .options = {},
                         .commands = {}};
  for (const CLI::Option* option : command.get_options()) out.options.push_back(describe_option(*option));
  for (const CLI::App* one : command.get_subcommands({})) out.commands.push_back(describe_command(*one, out.name + " "));
  return out;
}

}  // namespace

int run_program(const std::vector<std::string>& arguments) {
  const Program program = make_program();
  try {
    program.options->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them from the back
  } catch (const CLI::Success& help) {                                                       // --help and --version
    std::ostringstream out;
    program.options->exit(help, out, out);
    std::string text = out.str();
    if (!text.ends_with('\n')) text += '\n';
    print_out(text);
    return 0;
  } catch (const CLI::ParseError& problem) {
    require_command(*program.options, arguments);
    throw Error(ErrorKind::usage, "command line", problem.what(), "belvedere --help, or belvedere COMMAND --help, says what there is");
  }
  for (const auto& [command, run] : program.actions)
    if (command->parsed()) return run();
  throw Error(ErrorKind::bug, "command line", "a command that does nothing");
}

CommandDescription describe_program() {
  const Program program = make_program();
  CommandDescription out = describe_command(*program.options, "");
  out.description = std::exchange(out.meaning, meaning);
  return out;
}

}  // namespace belvedere::tools
