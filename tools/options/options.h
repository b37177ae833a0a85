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

#include "base/error.h"
#include "tools/options/program_description.h"

// Declarations of CLI11, whose long headers are included in options.cpp only.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace belvedere::tools {

template <typename T, typename... Known>
concept OneOf = (std::same_as<T, Known> || ...);

// Types of an option's value. An optional one stays empty if the option is not given; a vector may
// be given several times or takes several words.
template <typename T>
concept OptionValue =
    OneOf<T, std::string, int, std::uint64_t, float, double, std::optional<std::string>,
          std::optional<int>, std::optional<std::uint64_t>, std::optional<double>,
          std::vector<std::string>, std::vector<int>, std::vector<float>, std::vector<double>,
          std::vector<std::vector<double>>, std::vector<std::pair<int, int>>,
          std::vector<std::pair<std::string, std::string>>,
          std::vector<std::tuple<std::string, std::string>>,
          std::vector<std::tuple<int, int, double>>,
          std::vector<std::tuple<std::string, std::string, std::string, double>>>;

// Use of the files that an option names. All words of an option that name a file are inputs, unless
// it says otherwise; CommandLine::declare_files() tells file_guard() of both.
enum class FileUse {
  reads,   // files that are there are inputs
  input,   // an input, which has to exist unless it is an address
  edits,   // a file that is read and saved: neither
  writes,  // a result, replaced if it is there
  page,    // an HTML page, which is replaced only if this program wrote it
  folder,  // a folder of pages and pictures, likewise
  later,   // results that the command declares itself, when it knows their names
};
struct FileUses;  // of the options of a program

// Settings of a command's option. A handle, to be copied: it identifies the option for needs() and
// excludes().
class Option {
 public:
  Option(CLI::Option* option, CLI::App* command, std::shared_ptr<FileUses> uses)
      : option_(option), command_(command), uses_(std::move(uses)) {}

  Option& show_default();  // the help shows its present value
  Option& required(bool is = true);
  // Options whose target may hold files of others get --force: pages, folders, and results that
  // consist of several files, of which `all` gives the paths.
  Option& files(FileUse use, std::vector<std::string> (*all)(const std::string& path) = nullptr);
  Option& environment(
      const std::string& variable);  // where its value comes from when it is not given

  // Further checks, which refuse with the name of the option and what is allowed. The help shows
  // ranges, and whether they are of whole numbers.
  Option& range(int min, int max);
  Option& range(std::uint64_t min, std::uint64_t max);
  Option& range(double min, double max);
  Option& not_negative();
  Option& one_of(const std::vector<std::string>& words);
  Option& one_of(std::initializer_list<int> numbers);

  // How a vector is filled. By default one option takes all words up to the next.
  Option& repeated();          // one value, or one pair … of them, each time it is given
  Option& list(char between);  // several values in one word
  Option& list(char between, int count);  // exactly this number
  Option& words(int count);  // number of words of one value, where the type does not determine it
  Option& takes(const std::string& meant);  // error message of what is `meant` where the name of
                                            // another option is among its words

  // Errors if this is given: without the other, or together with one of the others.
  Option& needs(const Option& other);
  Option& excludes(std::initializer_list<Option> others);

 private:
  CLI::Option* option_;
  CLI::App* command_;
  std::shared_ptr<FileUses> uses_;
};

// The options of a command, and the commands of a program. A handle: what it adds lives as long as
// its CommandLine.
class CommandOptions {
 public:
  CommandOptions(CLI::App* app, std::shared_ptr<FileUses> uses)
      : app_(app), uses_(std::move(uses)) {}

  // Binds a value, which must outlive the command line; its present value is the default. Names:
  // "--out", "--quiet,-q"; without dashes it is a positional argument: "SCENE". After a space the
  // name of its value in the help: "--out DIR", "--size,-s PX".
  template <OptionValue T>
  Option add_option(const std::string& names, T& value, const std::string& meaning);
  Option add_flag(const std::string& names, bool& value, const std::string& meaning);
  // --force, for results that the command declares itself.
  void add_force(bool& force);
  // Text of the help below the options.
  void footer(const std::string& text);

  // An option that was added before, to set more of it.
  Option option(const std::string& name);
  bool has_option(const std::string& name) const;

  // A subcommand with its own options. Exactly one of the subcommands then has to be given.
  // heading: above it in the help of this command.
  CommandOptions add_command(const std::string& name, const std::string& meaning,
                             const std::string& heading = "Commands");
  // Whether the parsed line names this command.
  bool is_named() const;

  // All of it as plain values. before: prefix of its full name, with a space at its end.
  CommandDescription describe(const std::string& before = {}) const;

 private:
  CLI::App* app_;
  std::shared_ptr<FileUses> uses_;
};

// The command line of a program.
class CommandLine {
 public:
  // version: output of --version; empty: no such option.
  CommandLine(const std::string& name, const std::string& description,
              const std::string& version = {});
  ~CommandLine();

  CommandOptions& options() { return options_; }
  // Sets the values that options are bound to. words: without the program's name. Returns the
  // output of --help or --version; empty where neither is asked for. Throws Error(usage) for an
  // invalid line.
  std::string read(const std::vector<std::string>& words);
  // After it, before the work: tells file_guard() of the files that the line names, inputs first.
  // Error(input) for a missing input, and what the guard throws.
  void declare_files() const;

 private:
  std::unique_ptr<CLI::App> app_;
  std::shared_ptr<FileUses> uses_;
  CommandOptions options_;
};

// Run settings that most commands share.
struct RunOptions {
  int threads = 0;  // 0: all
  bool quiet = false;
  bool json = false;
};
// --threads, --quiet and --json. `unchanged`: what the number of threads does not change, "pixel".
void add_run_options(CommandOptions& command, RunOptions& options,
                     const std::string& unchanged = "pixel");

// Refuses a command line that does not make sense.
[[noreturn]] inline void refuse(const std::string& where, const std::string& found,
                                const std::string& allowed) {
  throw Error(ErrorKind::usage, where, found, allowed);
}

}  // namespace belvedere::tools
