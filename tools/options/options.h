#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tools/options/program_description.h"

// Of CLI11, whose headers are long and known to options.cpp alone.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace belvedere::tools {

template <typename T, typename... Known>
concept OneOf = (std::same_as<T, Known> || ...);

// What an option's value may be. An optional one tells whether it was given; a vector may be given several times or takes several words.
template <typename T>
concept OptionValue =
    OneOf<T, std::string, int, std::uint64_t, float, double, std::optional<std::string>, std::optional<int>, std::optional<std::uint64_t>,
          std::optional<double>, std::vector<std::string>, std::vector<int>, std::vector<float>, std::vector<double>,
          std::vector<std::vector<double>>, std::vector<std::pair<int, int>>, std::vector<std::pair<std::string, std::string>>,
          std::vector<std::tuple<std::string, std::string>>, std::vector<std::tuple<int, int, double>>,
          std::vector<std::tuple<std::string, std::string, std::string, double>>>;

// What a command's option may be told. A handle, to be copied: it names the option for needs() and excludes().
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& type_name(const std::string& name);  // what stands for its value in the help: "DIR"
  Option& show_default();                      // the help says the value that it has now
  Option& required(bool is = true);
  Option& environment(const std::string& variable);  // where its value comes from when it is not given

  // What else is refused, with the name of the option and what is allowed. The help says ranges, and whether they are of whole numbers.
  Option& range(int least, int most);
  Option& range(std::uint64_t least, std::uint64_t most);
  Option& range(double least, double most);
  Option& positive();
  Option& not_negative();
  Option& one_of(const std::vector<std::string>& words);
  Option& one_of(std::initializer_list<int> numbers);

  // How a vector is filled. Without any of these one option takes all words up to the next.
  Option& repeated();                       // one value, or one pair … of them, each time that it is given
  Option& list(char between);               // several values in one word
  Option& list(char between, int count);    // exactly so many
  Option& words(int count);                 // so many words are one value, where the type does not say it
  Option& takes(const std::string& meant);  // says what is `meant` where the name of another option stands among its words

  // Faults where this is given: without the other, or beside one of the others.
  Option& needs(const Option& other);
  Option& excludes(std::initializer_list<Option> others);

 private:
  CLI::Option* option_;
};

// The options of a command, and of a program the commands. A handle: what it adds lives as long as its CommandLine.
class CommandOptions {
 public:
  explicit CommandOptions(CLI::App* app) : app_(app) {}

  // Binds a value, which must outlive the command line; its value of now is that of an option that is not given. Names: "--out",
  // "--quiet,-q"; without dashes it is a word told by its place: "SCENE".
  template <OptionValue T>
  Option add_option(const std::string& names, T& value, const std::string& meaning);
  Option add_flag(const std::string& names, bool& value, const std::string& meaning);
  // What the help says below the options.
  void footer(const std::string& text);

  // One that was added before, to say more of it.
  Option option(const std::string& name);
  bool has_option(const std::string& name) const;

  // A word that goes before options of its own. Exactly one of the commands then has to be named.
  CommandOptions add_command(const std::string& name, const std::string& meaning);
  // Whether the line that was read names this command.
  bool is_named() const;

  // All of it as plain values. before: of its whole name, with a blank at its end.
  CommandDescription describe(const std::string& before = {}) const;

 private:
  CLI::App* app_;
};

// The command line of a program.
class CommandLine {
 public:
  // version: what --version prints; empty: there is no such option.
  CommandLine(const std::string& name, const std::string& description, const std::string& version = {});
  ~CommandLine();

  CommandOptions& options() { return options_; }
  // Sets the values that options are bound to. words: without the program's name. Returns what --help or --version prints; empty where
  // neither is asked for. Throws Error(usage) for what cannot be meant.
  std::string read(const std::vector<std::string>& words);

 private:
  std::unique_ptr<CLI::App> app_;
  CommandOptions options_;
};

}  // namespace belvedere::tools
