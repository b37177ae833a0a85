#include "tools/cli/terminal.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <functional>

namespace belvedere::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::MatchesRegex;
using ::testing::Not;

// Signals, closed streams and full disks are tested on the program itself: they change the process
// (belvedere_test.cpp).

TEST(Terminal, SecondsAreSaidAsPeopleDo) {
  EXPECT_EQ(describe_seconds(0.4), "0 s");
  EXPECT_EQ(describe_seconds(59.4), "59 s");
  EXPECT_EQ(describe_seconds(59.6), "1 min 00 s");
  EXPECT_EQ(describe_seconds(125.0), "2 min 05 s");
  EXPECT_EQ(describe_seconds(3599.6), "1 h 00 min");
  EXPECT_EQ(describe_seconds(4800.0), "1 h 20 min");
  EXPECT_EQ(describe_seconds(-3.0), "0 s");
  EXPECT_THAT(describe_seconds(1e300), MatchesRegex("[0-9]+ h [0-9]+ min"));
}

std::string said(bool quiet, const std::function<void(TerminalProgress&)>& work) {
  ::testing::internal::CaptureStderr();
  {
    TerminalProgress progress(quiet);
    work(progress);
  }
  return ::testing::internal::GetCapturedStderr();
}

void two_stages(TerminalProgress& progress) {
  progress.begin("reading", 0.0);
  progress.begin("tracing", 2.0);
  progress.advance(1.0);
  progress.note("a void was filled");
  progress.advance(1.0);
}

TEST(Terminal, InALogEveryStageIsALine) {
  EXPECT_THAT(
      said(false, two_stages),
      MatchesRegex("reading \\([0-9.]+ s\\)\nnote: a void was filled\ntracing \\([0-9.]+ s\\)\n"));
  EXPECT_THAT(said(true, two_stages), IsEmpty());
  EXPECT_THAT(said(false, [](TerminalProgress& progress) { progress.end(); }), IsEmpty());
}

// Tiles pass through the same stages: one line for each stage, not for each tile.
TEST(Terminal, RepeatedStagesAreAddedUp) {
  const std::string log = said(false, [](TerminalProgress& progress) {
    for (int tile = 0; tile < 3; ++tile) {
      progress.begin("tracing", 0.0);
      progress.begin("light", 0.0);
    }
    progress.begin("writing", 0.0);
  });
  const std::string line = " \\([0-9.]+ s\\)\n";
  // The first line of a stage appears when the next new stage begins; the rest at the end.
  EXPECT_THAT(
      log, MatchesRegex("tracing" + line + "light" + line + "tracing" + line + "writing" + line));
}

TEST(Terminal, OnATerminalABarIsDrawnOver) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  if (terminal < 0 || grantpt(terminal) != 0 || unlockpt(terminal) != 0)
    GTEST_SKIP() << "no pseudo terminal here";
  const int screen = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  ASSERT_GE(screen, 0);
  const int before = dup(STDERR_FILENO);
  dup2(screen, STDERR_FILENO);
  {
    TerminalProgress progress(false);
    progress.begin("tracing", 4.0);
    progress.note("a void was filled");
  }
  dup2(before, STDERR_FILENO);
  close(before);
  close(screen);
  // A terminal returns what was written piece by piece, until its other side is closed.
  std::string text;
  std::array<char, 4096> shown{};
  for (ssize_t size = read(terminal, shown.data(), shown.size()); size > 0;
       size = read(terminal, shown.data(), shown.size()))
    text.append(shown.data(), static_cast<std::size_t>(size));
  close(terminal);
  EXPECT_THAT(text, AllOf(HasSubstr("\r\033[Ktracing ░"), HasSubstr("  0 %"),
                          HasSubstr("\r\033[Knote: a void was filled"), Not(HasSubstr("left"))));
}

}  // namespace
}  // namespace belvedere::tools
