#include "tools/options/options.h"

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "base/files/file_guard.h"
#include "base/text/missing_file.h"

namespace belvedere::tools {

struct FileUses {
  struct Use {
    FileUse use = FileUse::reads;
    std::vector<std::string> (*all)(const std::string& path) = nullptr;
  };
  std::map<const CLI::Option*, Use> of;
};

namespace {

// Where the help's right column begins.
constexpr int meaning_column = 34;

const std::string force_meaning =
    "Also replaces files in a folder of results that this program did not write or that were "
    "changed since";

// CLI11 puts constraints behind the name of the value: "HOW:{off,common}", "N:INT in [8 - 4096]".
void describe_value(const CLI::Option& option, OptionDescription& out) {
  const std::string text = option.get_type_name();
  std::size_t end = text.size();
  for (const char* check :
       {":{", ":INT in [", ":UINT in [", ":FLOAT in [", ":NONNEGATIVE", ":POSITIVE"})
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
    out.range = check.substr(from + 1, between - from - 1) + " … " +
                check.substr(between + 3, check.rfind(']') - between - 3);
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
  for (const CLI::Option* option : command.get_options())
    out.options.push_back(describe_option(*option));
  for (const CLI::App* one : command.get_subcommands({}))
    out.commands.push_back(describe_command(*one, out.name + " "));
  return out;
}

// The path in a word: all of it, or what stands behind the "=" of a setting or before that of a
// name.
std::vector<std::string> paths_in(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) return {word};
  return {word, word.substr(0, equals), word.substr(equals + 1)};
}

// CLI11's own look-up may not throw, and ends the program where memory is short.
const CLI::Option* find_option(const CLI::App& app, const std::string& name) {
  const std::vector<const CLI::Option*> found =
      app.get_options([&](const CLI::Option* option) { return option->check_name(name); });
  return found.empty() ? nullptr : found.front();
}

void require_input(const std::string& path, const std::string& option) {
  std::error_code ignored;
  if (path.find("://") != std::string::npos || std::filesystem::exists(path, ignored)) return;
  const Error missing = missing_file(path);
  throw Error(missing.kind(), option, path + ": " + missing.found(), "an existing file");
}

// Declares the files of the command that was named: inputs first, so that results are compared with
// all of them.
void declare_files_of(const CLI::App& app, const FileUses& uses) {
  const auto use_of = [&](const CLI::Option* option) {
    const auto found = uses.of.find(option);
    return found == uses.of.end() ? FileUses::Use{} : found->second;
  };
  FileGuard& guard = file_guard();
  const std::vector<const CLI::Option*> options = app.get_options();
  for (const CLI::Option* option : options) {
    const FileUse use = use_of(option).use;
    if (use != FileUse::reads && use != FileUse::input) continue;
    for (const std::string& word : option->results()) {
      if (use == FileUse::input) require_input(word, option->get_name());
      for (const std::string& path : paths_in(word)) guard.reads(path, option->get_name());
    }
  }
  const CLI::Option* force = find_option(app, "--force");
  const bool replace = force != nullptr && force->count() > 0;
  for (const CLI::Option* option : options) {
    const std::string name = option->get_name();
    const auto [use, all] = use_of(option);
    for (const std::string& path : option->results()) {
      const auto only_own = [&](const std::filesystem::path& file) {
        guard.writes_into(file.parent_path().string(), name, replace, {{file.filename().string()}});
      };
      if (use == FileUse::writes) {
        guard.writes(path, name);
        // Results that the user did not name are replaced like the files of a folder.
        if (all != nullptr)
          for (const std::string& one : all(path))
            if (one != path) only_own(one);
      }
      if (use == FileUse::page) only_own(path);
      if (use == FileUse::folder) guard.writes_into(path, name, replace);
    }
  }
  for (const CLI::App* command : app.get_subcommands()) declare_files_of(*command, uses);
}

}  // namespace

Option& Option::files(FileUse use, std::vector<std::string> (*all)(const std::string& path)) {
  uses_->of[option_] = {use, all};
  if ((use == FileUse::page || use == FileUse::folder || all != nullptr) &&
      find_option(*command_, "--force") == nullptr)
    command_->add_flag("--force", force_meaning);
  return *this;
}

Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::required(bool is) {
  option_->required(is);
  return *this;
}

Option& Option::environment(const std::string& variable) {
  option_->envname(variable);
  return *this;
}

Option& Option::range(int min, int max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

Option& Option::range(std::uint64_t min, std::uint64_t max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

Option& Option::range(double min, double max) {
  option_->check(CLI::Range(min, max));
  return *this;
}

Option& Option::not_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

Option& Option::one_of(std::initializer_list<int> numbers) {
  option_->check(CLI::IsMember(numbers));
  return *this;
}

Option& Option::repeated() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::list(char between) {
  option_->delimiter(between);
  return *this;
}

Option& Option::list(char between, int count) {
  option_->delimiter(between)->expected(count);
  return *this;
}

Option& Option::words(int count) {
  option_->type_size(count);
  return *this;
}

// An option of several words takes the next option's name as a value if one of its own is missing,
// and the message would then be misleading.
Option& Option::takes(const std::string& meant) {
  option_->check(CLI::Validator(
      [meant](const std::string& word) {
        return word.starts_with("--") ? fmt::format("needs {}, but {} follows", meant, word) : "";
      },
      ""));
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(std::initializer_list<Option> others) {
  for (const Option& other : others) option_->excludes(other.option_);
  return *this;
}

template <OptionValue T>
Option CommandOptions::add_option(const std::string& names, T& value, const std::string& meaning) {
  const std::size_t space = names.find(' ');
  CLI::Option* const option = app_->add_option(names.substr(0, space), value, meaning);
  if (space != std::string::npos) option->type_name(names.substr(space + 1));
  return Option(option, app_, uses_);
}
template Option CommandOptions::add_option(const std::string&, std::string&, const std::string&);
template Option CommandOptions::add_option(const std::string&, int&, const std::string&);
template Option CommandOptions::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option CommandOptions::add_option(const std::string&, float&, const std::string&);
template Option CommandOptions::add_option(const std::string&, double&, const std::string&);
template Option CommandOptions::add_option(const std::string&, std::optional<std::string>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::optional<int>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::optional<std::uint64_t>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::optional<double>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::vector<std::string>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::vector<int>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::vector<float>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::vector<double>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::vector<std::vector<double>>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&, std::vector<std::pair<int, int>>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&,
                                           std::vector<std::pair<std::string, std::string>>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&,
                                           std::vector<std::tuple<std::string, std::string>>&,
                                           const std::string&);
template Option CommandOptions::add_option(const std::string&,
                                           std::vector<std::tuple<int, int, double>>&,
                                           const std::string&);
template Option CommandOptions::add_option(
    const std::string&, std::vector<std::tuple<std::string, std::string, std::string, double>>&,
    const std::string&);

Option CommandOptions::add_flag(const std::string& names, bool& value, const std::string& meaning) {
  return Option(app_->add_flag(names, value, meaning), app_, uses_);
}

void CommandOptions::add_force(bool& force) { add_flag("--force", force, force_meaning); }

void CommandOptions::footer(const std::string& text) { app_->footer(text); }

Option CommandOptions::option(const std::string& name) {
  return Option(app_->get_option(name), app_, uses_);
}

bool CommandOptions::has_option(const std::string& name) const {
  return find_option(*app_, name) != nullptr;
}

CommandOptions CommandOptions::add_command(const std::string& name, const std::string& meaning,
                                           const std::string& heading) {
  app_->require_subcommand(1);
  return CommandOptions(app_->add_subcommand(name, meaning)->group(heading), uses_);
}

bool CommandOptions::is_named() const { return app_->parsed(); }

CommandDescription CommandOptions::describe(const std::string& before) const {
  return describe_command(*app_, before);
}

CommandLine::CommandLine(const std::string& name, const std::string& description,
                         const std::string& version)
    : app_(std::make_unique<CLI::App>(description, name)),
      uses_(std::make_shared<FileUses>()),
      options_(app_.get(), uses_) {
  if (!version.empty()) app_->set_version_flag("--version", version);
  app_->get_formatter()->column_width(meaning_column);
}

CommandLine::~CommandLine() = default;

std::string CommandLine::read(const std::vector<std::string>& words) {
  try {
    app_->parse(
        std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the back
  } catch (const CLI::Success& asked) {                           // --help and --version
    std::ostringstream out;
    app_->exit(asked, out, out);
    std::string text = out.str();
    if (!text.ends_with('\n')) text += '\n';
    return text;
  } catch (const CLI::ParseError& problem) {
    const std::string name = app_->get_name();
    const std::string of_commands =
        app_->get_subcommands({}).empty() ? "" : fmt::format(", or {} COMMAND --help", name);
    throw Error(ErrorKind::usage, "command line", problem.what(),
                fmt::format("see {} --help{}", name, of_commands));
  }
  return {};
}

void CommandLine::declare_files() const { declare_files_of(*app_, *uses_); }

void add_run_options(CommandOptions& command, RunOptions& options, const std::string& unchanged) {
  command
      .add_option("--threads N", options.threads,
                  "Processor threads; 0, the default, takes all. Changes no " + unchanged)
      .range(0, 4096);
  command.add_flag("--quiet,-q", options.quiet, "No progress, no notes");
  command.add_flag("--json", options.json, "The result as JSON on standard output");
}

}  // namespace belvedere::tools
