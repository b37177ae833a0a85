#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/progress.h"

namespace belvedere {
class Json;
}

namespace belvedere::tools {

struct RunOptions;

// Prepares the process: closed standard streams are replaced by /dev/null, so that no file of ours
// becomes "the terminal"; a closed pipe is an error code instead of a signal; SIGINT and SIGTERM
// request a stop, a second one ends at once.
void prepare_process();
// Whether SIGINT or SIGTERM was received.
bool interrupted();

// Text to stdout. Write errors are remembered; finish_output() flushes and throws Error(output), or
// does nothing where the reader closed the pipe.
void print_out(std::string_view text);
// The result in the requested form: as JSON, as text or, if quiet, not at all.
void print_result(const RunOptions& options, const Json& json, const std::string& text);
void finish_output();
// Text to stderr; errors of that are ignored.
void print_error(std::string_view text);

// Stages on stderr: a bar with percent and time left on a terminal, else one line per stage.
// advance() throws Error(interrupted) after a signal, quiet or not.
class TerminalProgress : public Progress {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  void begin(std::string_view stage, double total) override;
  void advance(double amount) override;
  void note(std::string_view text) override;
  // Ends the last stage; the destructor does so too.
  void end();

 private:
  using Clock = std::chrono::steady_clock;
  void close_stage();
  void print_closed();
  void draw(Clock::time_point now);

  std::mutex mutex_;
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;  // a bar is on the current line
  std::string stage_;
  std::vector<std::string> seen_;                       // stages that began so far
  std::vector<std::pair<std::string, double>> closed_;  // without a line yet; seconds
  double total_ = 0.0;
  double done_ = 0.0;
  Clock::time_point begun_;
  Clock::time_point drawn_at_;
};

// "3 s", "2 min 05 s", "1 h 20 min"
std::string describe_seconds(double seconds);

}  // namespace belvedere::tools
