#include "tools/cli/terminal.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "base/error.h"
#include "base/text/json.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

volatile std::sig_atomic_t stop_asked = 0;
int output_problem = 0;  // errno of the first failed write to stdout

extern "C" void on_signal(int) {
  stop_asked = 1;
  // The next signal ends the program at once.
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

constexpr auto redraw_every = std::chrono::milliseconds(100);
constexpr int bar_cells = 24;

}  // namespace

void prepare_process() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    const int opened = open("/dev/null", O_RDWR);  // the lowest free number, which is this one
    static_cast<void>(opened);
  }
  // Makes a closed pipe and a file size limit errors of the write instead of signals that end the
  // program and leave half a file.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupted() { return stop_asked != 0; }

void print_out(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() && output_problem == 0)
    output_problem = errno;
}

void print_result(const RunOptions& options, const Json& json, const std::string& text) {
  if (options.json)
    print_out(json.str() + "\n");
  else if (!options.quiet)
    print_out(text);
}

void finish_output() {
  if (std::fflush(stdout) != 0 && output_problem == 0) output_problem = errno;
  // A reader may close the pipe early: `belvedere info x.exr | head -1` is not an error.
  if (output_problem != 0 && output_problem != EPIPE)
    throw Error(ErrorKind::output, "standard output",
                "cannot be written: " + std::generic_category().message(output_problem));
}

void print_error(std::string_view text) {
  static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
  std::fflush(stderr);
}

std::string describe_seconds(double seconds) {
  const long s = std::lround(std::clamp(seconds, 0.0, 1e7));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

TerminalProgress::TerminalProgress(bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begun_(Clock::now()),
      drawn_at_(begun_) {}

TerminalProgress::~TerminalProgress() {
  try {
    end();
  } catch (const std::bad_alloc&) {  // a line is missing
  }
}

void TerminalProgress::begin(std::string_view stage, double total) {
  if (interrupted()) throw Error(ErrorKind::interrupted, "", "stopped");
  const std::lock_guard lock(mutex_);
  close_stage();
  if (std::find(seen_.begin(), seen_.end(), stage) == seen_.end()) {
    print_closed();
    seen_.emplace_back(stage);
  }
  stage_ = stage;
  total_ = total;
  done_ = 0.0;
  begun_ = Clock::now();
  if (quiet_) return;
  if (terminal_) draw(begun_);
}

void TerminalProgress::advance(double amount) {
  if (interrupted()) throw Error(ErrorKind::interrupted, "", "stopped");
  const std::lock_guard lock(mutex_);
  done_ += amount;
  if (quiet_ || !terminal_) return;
  const Clock::time_point now = Clock::now();
  if (now - drawn_at_ >= redraw_every) draw(now);
}

void TerminalProgress::note(std::string_view text) {
  const std::lock_guard lock(mutex_);
  if (quiet_) return;
  if (drawn_) print_error("\r\033[K");
  drawn_ = false;
  print_error(fmt::format("note: {}\n", text));
}

void TerminalProgress::end() {
  const std::lock_guard lock(mutex_);
  close_stage();
  print_closed();
}

// Tiles of a picture pass through the same stages again and again: their times are added up.
void TerminalProgress::close_stage() {
  if (stage_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
  const auto same = std::find_if(closed_.begin(), closed_.end(),
                                 [this](const auto& closed) { return closed.first == stage_; });
  if (same != closed_.end())
    same->second += seconds;
  else
    closed_.emplace_back(stage_, seconds);
  stage_.clear();
}

// Finished stages leave one line each with their duration, on a terminal and in a log alike.
void TerminalProgress::print_closed() {
  if (!quiet_) {
    if (drawn_) print_error("\r\033[K");
    for (const auto& [stage, seconds] : closed_)
      print_error(fmt::format("{} ({:.1f} s)\n", stage, seconds));
  }
  closed_.clear();
  drawn_ = false;
}

void TerminalProgress::draw(Clock::time_point now) {
  drawn_at_ = now;
  drawn_ = true;
  if (!(total_ > 0.0)) {
    print_error(fmt::format("\r\033[K{} …", stage_));
    return;
  }
  const double share = std::clamp(done_ / total_, 0.0, 1.0);
  const auto full = static_cast<int>(std::lround(share * bar_cells));
  std::string bar;
  for (int i = 0; i < bar_cells; ++i) bar += i < full ? "█" : "░";
  const double seconds = std::chrono::duration<double>(now - begun_).count();
  // No estimate is better than a very early one.
  const bool known = share > 0.02 && seconds > 1.0;
  print_error(
      fmt::format("\r\033[K{} {} {:3.0f} %{}", stage_, bar, 100.0 * share,
                  known ? ", " + describe_seconds(seconds * (1.0 - share) / share) + " left" : ""));
}

}  // namespace belvedere::tools
