#include "tools/cli/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>

#include "renderer/image/provenance.h"
#include "tools/cli/commands.h"
#include "tools/cli/program.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// The code point at text[i], which is valid UTF-8; moves i to its last byte.
unsigned code_point(const std::string& text, std::size_t& i) {
  const auto lead = static_cast<unsigned char>(text[i]);
  const int more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
  unsigned code = lead & (0x3fU >> more);
  for (int k = 0; k < more && i + 1 < text.size(); ++k)
    code = code << 6U | (static_cast<unsigned char>(text[++i]) & 0x3fU);
  return code;
}

// Within a line. A bare "-" would become a hyphen that cannot be typed, "'" and "`" curved quotes.
std::string escaped(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if ((c & 0x80) != 0)
      out += fmt::format("\\[u{:04X}]", code_point(text, i));
    else if (c == '\\')
      out += "\\(rs";
    else if (c == '-')
      out += "\\-";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '`')
      out += "\\(ga";
    else
      out += c;
  }
  return out;
}

// A separate line: "." at its beginning would be a request.
std::string line(const std::string& text) {
  const std::string out = escaped(text);
  return (out.starts_with('.') ? "\\&" : "") + out + "\n";
}

// Preformatted text.
std::string shown(const std::string& text) {
  if (text.empty()) return {};
  std::string out = ".nf\n";
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) out += one.empty() ? ".sp\n" : line(one);
  return out + ".fi\n";
}

// "--set KEY=VALUE", names bold and values slanted.
std::string usage(const OptionDescription& option) {
  if (option.positional) return "\\fI" + escaped(option.names.front()) + "\\fR";
  std::string out;
  for (const std::string& name : option.names)
    out += std::string(out.empty() ? "" : ", ") + "\\fB" + escaped(name) + "\\fR";
  return option.value.empty() ? out : out + " \\fI" + escaped(option.value) + "\\fR";
}

std::string option_entry(const OptionDescription& option) {
  std::string text = option.meaning;
  if (!option.range.empty()) text += " [" + option.range + "]";
  if (!option.choices.empty()) text += fmt::format(" [{}]", fmt::join(option.choices, ", "));
  if (!option.preset.empty()) text += " (default: " + option.preset + ")";
  return ".TP\n" + usage(option) + "\n" + line(text);
}

// The shortest form: arguments, and required options.
std::string synopsis(const CommandDescription& command) {
  std::string out = "\\fB" + escaped(command.name) + "\\fR";
  for (const OptionDescription& option : command.options) {
    if (option.required)
      out += " " + usage(option);
    else if (option.positional)
      out += " [" + usage(option) + "]";
  }
  return out + " [\\fIOPTION\\fR ...]\n";
}

// A line of help has no full stop at its end.
std::string sentence(const std::string& text) {
  return text + (text.ends_with('?') || text.ends_with('.') ? "" : ".");
}

void add_command(const CommandDescription& command, std::string& out) {
  for (const CommandDescription& one : command.commands) add_command(one, out);
  if (!command.commands.empty()) return;
  out += ".SS " + escaped(command.name) + "\n" + line(sentence(command.meaning)) + ".PP\n" +
         synopsis(command);
  for (const bool positional : {true, false})
    for (const OptionDescription& option : command.options)
      if (option.positional == positional) out += option_entry(option);
  if (!command.footer.empty()) out += ".PP\n" + shown(command.footer);
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace

std::string man_page(const CommandDescription& program, const std::string& version) {
  // No date: the same program gives the same page.
  std::string out =
      fmt::format(".TH {} 1 \"\" \"{}\" \"User Commands\"\n", upper(program.name), version);
  out += ".SH NAME\n" + escaped(program.name) + " \\- " + escaped(program.meaning) + "\n";
  out += ".SH SYNOPSIS\n\\fB" + escaped(program.name) +
         "\\fR \\fICOMMAND\\fR [\\fIARGUMENT\\fR ...] [\\fIOPTION\\fR ...]\n";
  out += ".SH DESCRIPTION\n" + shown(program.description) + ".SH OPTIONS\n";
  for (const OptionDescription& option : program.options) out += option_entry(option);
  out += ".SH COMMANDS\n";
  for (const CommandDescription& command : program.commands) add_command(command, out);
  return out + ".SH EXIT STATUS\n" + shown(program.footer);
}

Action add_man(CommandOptions& command) {
  command.footer(
      "An installed program provides it as: man belvedere\n"
      "\n"
      "  belvedere man | man -l -");
  return [] {
    print_out(man_page(describe_program(), "belvedere " + program_version()));
    return 0;
  };
}

}  // namespace belvedere::tools
