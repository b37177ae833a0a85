#include "tools/cli/shell_completion.h"

#include <fmt/format.h>

#include <memory>

#include "base/error.h"
#include "tools/cli/commands.h"
#include "tools/cli/program.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// How the value of an option is completed.
enum class Values { none, choices, folders, files, scenes };

Values values_of(const OptionDescription& option) {
  const auto says = [&](const char* word) { return option.value.find(word) != std::string::npos; };
  if (!option.choices.empty()) return Values::choices;
  if (option.positional) return option.names.front() == "SCENE" ? Values::scenes : Values::files;
  if (says("DIR")) return Values::folders;
  for (const char* word : {"FILE", "STYLE", "MASK", "MATCH", "PALETTE"})
    if (says(word)) return Values::files;
  return Values::none;
}

std::string names_of(const CommandDescription& command) {
  std::string out;
  for (const OptionDescription& option : command.options)
    if (!option.positional)
      out += fmt::format("{}{}", out.empty() ? "" : " ", fmt::join(option.names, " "));
  return out;
}

std::string words_of(const std::vector<CommandDescription>& commands) {
  std::string out;
  for (const CommandDescription& command : commands)
    out += (out.empty() ? "" : " ") + command.word();
  return out;
}

const OptionDescription* first_argument(const CommandDescription& command) {
  for (const OptionDescription& option : command.options)
    if (option.positional) return &option;
  return nullptr;
}

// Within '…'.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// ---- bash

const char* bash_head = R"(# Completion for bash, made by `belvedere completion bash`.
_belvedere_files() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen "$@" -- "$word")
}

# Scene files and folders; where none begins like that, any file.
_belvedere_scenes() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -X '!*.toml' -- "$word"; compgen -d -- "$word")
  [ ${#COMPREPLY[@]} -gt 0 ] || _belvedere_files -f
}

_belvedere_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
}

_belvedere() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=belvedere i
  COMPREPLY=()
  # bash takes --option=value for three words.
  if [ "$word" = "=" ]; then
    word=""
  elif [ "$before" = "=" ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command ${COMP_WORDS[i]}" in
)";

void add_bash_names(const CommandDescription& command, std::string& out) {
  for (const CommandDescription& one : command.commands) {
    out += (out.empty() ? "" : " | ") + quoted(one.name);
    add_bash_names(one, out);
  }
}

std::string bash_values(const OptionDescription& option) {
  switch (values_of(option)) {
    case Values::choices:
      return fmt::format("_belvedere_words {}",
                         quoted(fmt::format("{}", fmt::join(option.choices, " "))));
    case Values::folders:
      return "_belvedere_files -d";
    case Values::files:
      return "_belvedere_files -f";
    case Values::scenes:
      return "_belvedere_scenes";
    case Values::none:
      break;
  }
  return ":";
}

void add_bash_command(const CommandDescription& command, std::string& out) {
  out += fmt::format("    {})\n", quoted(command.name));
  std::string cases;
  for (const OptionDescription& option : command.options)
    if (!option.positional && !option.value.empty())
      cases += fmt::format("        {}) {}; return ;;\n", fmt::join(option.names, " | "),
                           bash_values(option));
  if (!cases.empty()) out += "      case \"$before\" in\n" + cases + "      esac\n";
  const OptionDescription* argument = first_argument(command);
  const std::string other = !command.commands.empty()
                                ? "_belvedere_words " + quoted(words_of(command.commands))
                            : argument != nullptr ? bash_values(*argument)
                                                  : std::string("_belvedere_files -f");
  out += fmt::format(
      "      case \"$word\" in\n        -*) _belvedere_words {} ;;\n        *) {} ;;\n      esac "
      ";;\n",
      quoted(names_of(command)), other);
  for (const CommandDescription& one : command.commands) add_bash_command(one, out);
}

std::string bash_completion(const CommandDescription& program) {
  std::string names;
  add_bash_names(program, names);
  std::string out =
      bash_head + fmt::format("      {}) command+=\" ${{COMP_WORDS[i]}}\" ;;\n", names);
  out += "    esac\n  done\n  case \"$command\" in\n";
  add_bash_command(program, out);
  return out + "  esac\n}\ncomplete -F _belvedere belvedere\n";
}

// ---- zsh

// Characters that separate the fields of a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += (c == ':' || c == '[' || c == ']' || c == '\\' ? "\\" : "") + std::string(1, c);
  return out;
}

std::string zsh_function(const CommandDescription& command) {
  std::string out = "_" + command.name;
  for (char& c : out)
    if (c == ' ') c = '_';
  return out;
}

std::string zsh_values(const OptionDescription& option) {
  switch (values_of(option)) {
    case Values::choices:
      return fmt::format("({})", fmt::join(option.choices, " "));
    case Values::folders:
      return "_files -/";
    case Values::files:
      return "_files";
    case Values::scenes:
      return "_files -g \"*.toml(-.)\"";
    case Values::none:
      break;
  }
  return " ";
}

void add_zsh_command(const CommandDescription& command, std::string& out) {
  for (const CommandDescription& one : command.commands) add_zsh_command(one, out);
  out += zsh_function(command) + "() {\n";
  if (!command.commands.empty()) out += "  local line state\n";
  out += "  _arguments" + std::string(command.commands.empty() ? "" : " -C");
  const OptionDescription* argument = first_argument(command);  // further ones are files as well
  if (argument != nullptr)
    out += " \\\n    " +
           quoted("*:" + zsh_text(argument->names.front()) + ":" + zsh_values(*argument));
  for (const OptionDescription& option : command.options) {
    if (option.positional) continue;
    for (const std::string& name : option.names)
      out += " \\\n    " + quoted("*" + name + "[" + zsh_text(option.meaning) + "]" +
                                  (option.value.empty()
                                       ? ""
                                       : ":" + zsh_text(option.value) + ":" + zsh_values(option)));
  }
  if (command.commands.empty()) {
    out += "\n}\n\n";
    return;
  }
  std::string words;
  std::string cases;
  for (const CommandDescription& one : command.commands) {
    words += fmt::format("{}{}\\:{}", words.empty() ? "" : " ", one.word(),
                         "\"" + zsh_text(one.meaning) + "\"");
    cases += fmt::format("    {}) {} ;;\n", one.word(), zsh_function(one));
  }
  out += " \\\n    " + quoted("1:command:((" + words + "))") + " \\\n    '*::argument:->rest'\n";
  out += "  [ \"$state\" = rest ] || return 0\n  case \"$line[1]\" in\n" + cases + "  esac\n}\n\n";
}

std::string zsh_completion(const CommandDescription& program) {
  std::string out =
      "#compdef belvedere\n# Completion for zsh, made by `belvedere completion zsh`.\n\n";
  add_zsh_command(program, out);
  return out + "_belvedere \"$@\"\n";
}

// ---- fish

void add_fish_command(const CommandDescription& command, const std::string& when,
                      std::string& out) {
  const auto line = [&](const std::string& rest, const std::string& meaning) {
    out += fmt::format("complete -c belvedere{} {} -d {}\n",
                       when.empty() ? "" : " -n " + quoted(when), rest, quoted(meaning));
  };
  for (const OptionDescription& option : command.options) {
    if (option.positional && option.choices.empty())
      continue;  // files, which fish completes by itself
    std::string rest;
    for (const std::string& name : option.positional ? std::vector<std::string>() : option.names)
      rest += (rest.empty() ? "" : " ") +
              (name.starts_with("--") ? "-l " + name.substr(2) : "-s " + name.substr(1));
    switch (values_of(option)) {
      case Values::choices:
        rest += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
        break;
      case Values::folders:
        rest += " -x -a '(__fish_complete_directories)'";
        break;
      case Values::files:
      case Values::scenes:
        rest += " -r -F";
        break;
      case Values::none:
        if (!option.value.empty()) rest += " -x";
    }
    line(rest, option.meaning);
  }
  const std::string words = words_of(command.commands);
  const std::string also = when.empty() ? "" : when + "; and ";
  for (const CommandDescription& one : command.commands) {
    const std::string none = also + "not __fish_seen_subcommand_from " + words;
    out += fmt::format("complete -c belvedere -f -n {} -a {} -d {}\n", quoted(none), one.word(),
                       quoted(one.meaning));
  }
  for (const CommandDescription& one : command.commands) {
    std::string seen = also + "__fish_seen_subcommand_from " + one.word();
    // Excludes commands of groups: `exemplar check` is not `check`.
    for (const CommandDescription& other : command.commands)
      if (!other.commands.empty() && other.name != one.name)
        seen += "; and not __fish_seen_subcommand_from " + other.word();
    add_fish_command(one, seen, out);
  }
}

std::string fish_completion(const CommandDescription& program) {
  std::string out = "# Completion for fish, made by `belvedere completion fish`.\n";
  add_fish_command(program, "", out);
  return out;
}

struct Shell {
  const char* name;
  std::string (*script)(const CommandDescription& program);
};
constexpr Shell shells[] = {
    {"bash", bash_completion}, {"fish", fish_completion}, {"zsh", zsh_completion}};

}  // namespace

std::vector<std::string> completed_shells() {
  std::vector<std::string> names;
  for (const Shell& shell : shells) names.emplace_back(shell.name);
  return names;
}

std::string shell_completion(const CommandDescription& program, const std::string& shell) {
  for (const Shell& known : shells)
    if (shell == known.name) return known.script(program);
  throw Error(ErrorKind::usage, "shell", "\"" + shell + "\"",
              fmt::format("{}", fmt::join(completed_shells(), ", ")));
}

Action add_completion(CommandOptions& command) {
  const auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "The shell").required().one_of(completed_shells());
  command.footer(
      "An installed program includes all of them. Without installation:\n"
      "\n"
      "  belvedere completion bash > ~/.local/share/bash-completion/completions/belvedere\n"
      "  belvedere completion fish > ~/.config/fish/completions/belvedere.fish\n"
      "  belvedere completion zsh > ~/.zfunc/_belvedere      where ~/.zfunc is part of $fpath");
  return [shell] {
    print_out(shell_completion(describe_program(), *shell));
    return 0;
  };
}

}  // namespace belvedere::tools
