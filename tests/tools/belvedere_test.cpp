// The program as users meet it: exit statuses, messages, what it writes. Each test runs the built
// program.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>
#include <vector>

#include "base/grid.h"
#include "base/memory/sanitized.h"
#include "renderer/image/image_io.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// ---- command line

TEST_F(Program, HelpAndVersionAreAnswers) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("render"), HasSubstr("synthesize"),
                              HasSubstr("Exit status"), HasSubstr("scenes/karwendel.toml")));
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(run({"--version"}).out, AllOf(HasSubstr("belvedere 0."), HasSubstr("Embree")));
  for (const char* command :
       {"render", "guidance", "synthesize", "check", "deform", "info", "diff", "schema"}) {
    EXPECT_THAT(run({command, "--help"}), Prints(HasSubstr("  belvedere " + std::string(command))))
        << command << "no example";
    EXPECT_THAT(help.out, HasSubstr(command));
  }
}

// Its 150 libraries would take .2 s of every start: it is loaded where a picture needs it.
TEST_F(Program, StartsWithoutOpenImageIO) {
#if defined(__clang__) || !defined(NDEBUG)
  GTEST_SKIP() << "only the release build by GCC loads it late";
#endif
  const std::string list = folder_ / "libraries";
  ASSERT_EQ(
      std::system(
          ("LD_TRACE_LOADED_OBJECTS=1 '" + test::build_folder() + "/belvedere' > " + list).c_str()),
      0);
  EXPECT_THAT(read_bytes(list), AllOf(HasSubstr("libembree"), Not(HasSubstr("OpenImageIO"))));
}

TEST_F(Program, WrongCommandLinesAreUsageErrors) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"nonsense"},
                                             {"render", "--nonsense"},
                                             {"info"},
                                             {"diff", "a"},
                                             {"render", "a", "b"},
                                             {"render", "x.toml", "--threads", "many"},
                                             {"render", "x.toml", "--tile", "0"},
                                             {"synthesize"},
                                             {"diff", "a", "b", "--max-mean", "-1"}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << fmt::format("{}", fmt::join(arguments, " "));
    EXPECT_THAT(outcome.err, StartsWith("belvedere: "));
    EXPECT_THAT(outcome.out, IsEmpty());
  }
}

TEST_F(Program, CommandsThatAreMissingOrMisspeltAreAskedFor) {
  const auto said = [&](const std::vector<std::string>& arguments) { return run(arguments).err; };
  EXPECT_THAT(said({}), HasSubstr("missing subcommand of belvedere\n  allowed: new, studio, fetch, "
                                  "check, render, guidance"));
  EXPECT_THAT(said({"rendr", "x.toml"}),
              HasSubstr("belvedere has no command \"rendr\"; did you mean \"render\"?"));
  EXPECT_THAT(said({"exemplar"}), HasSubstr("missing subcommand of belvedere exemplar\n  allowed: "
                                            "check, paint, pick, register, segment;"));
  EXPECT_THAT(said({"exemplar", "pain"}),
              HasSubstr("belvedere exemplar has no command \"pain\"; did you mean \"paint\"?"));
  EXPECT_THAT(said({"exemplar", "xyz"}), Not(HasSubstr("did you mean")));
  // Where there is a command, what is wrong with its options is said.
  EXPECT_THAT(said({"exemplar", "paint"}), HasSubstr("--out is required"));
}

// ---- scenes

TEST_F(Program, SceneMistakesNameFileLineAndColumn) {
  const std::string scene = write("bad.toml", "version = 1\n[camera]\npich_deg = 3\n");
  for (const char* command : {"check", "render", "guidance"}) {
    EXPECT_THAT(run({command, scene}), Ends(2, AllOf(HasSubstr(scene + ":3:1: "),
                                                     HasSubstr("did you mean \"pitch_deg\""))));
  }
  const Outcome set = run({"check", write_scene_file(), "--set", "output.width=1000000000"});
  EXPECT_EQ(set.status, 2);
  EXPECT_THAT(set.err,
              AllOf(HasSubstr("--set output.width=1000000000"), HasSubstr("16 … 65535 px")));
}

TEST_F(Program, DeepAndHugeScenesAreRefusedAtOnce) {
  std::string deep = "version = 1\na = ";
  for (int i = 0; i < 10'000; ++i) deep += "[";
  const std::string huge = write("huge.toml", "version = 1\n");
  fs::resize_file(huge, 100'000'000);
  for (const std::string& scene : {write("deep.toml", deep), huge}) {
    const Outcome outcome = run_prepared({"check", scene}, [] {
#ifdef BELVEDERE_SANITIZED
      const rlimit seconds{10, 10};
#else
      const rlimit seconds{1, 1};  // of processor time: more would end it by a signal
#endif
      setrlimit(RLIMIT_CPU, &seconds);
    });
    EXPECT_EQ(outcome.status, 2) << outcome.err;
  }
}

TEST_F(Program, FilesOutsideTheAllowedFoldersAreRefused) {
  const std::string scene =
      write("out.toml", "version = 1\n[[terrain.sources]]\nfile = \"../../etc/passwd\"\n");
  EXPECT_EQ(run({"check", scene}).status, 2);
  fs::create_symlink("/etc/passwd", path("dem.tif"));
  EXPECT_THAT(
      run({"check", write("link.toml", "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n")}),
      Ends(2, AllOf(HasSubstr("link.toml:3:8"), HasSubstr("outside"))));
}

// ---- signals, streams, memory

TEST_F(Program, SignalsStopItAndASecondOneEndsIt) {
  const std::string scene = write_large_scene();
  const auto start_tracing = [&] {
    fs::remove(path("stderr"));
    const pid_t child = start({"guidance", scene, "--out", path("result"), "--threads", "1"});
    // The terrain is done when the first lines are in the log.
    for (int i = 0; i < 1000 &&
                    read_bytes(path("stderr")).find("building the ray tracer") == std::string::npos;
         ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return child;
  };
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start_tracing();
    kill(child, signal);
    EXPECT_THAT(finish(child), Ends(75));
    EXPECT_TRUE(!fs::exists(path("result")) || fs::is_empty(path("result")))
        << "something half written is left";
  }
  const pid_t child = start_tracing();
  kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  const int status = finish(child).status;
  EXPECT_TRUE(status == 75 || status == 1000 + SIGINT) << status;
}

TEST_F(Program, ClosedStreamsDoNoHarm) {
  // A reader that closes the pipe is not an error; a full disk is one.
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  close(ends[0]);
  EXPECT_EQ(run_prepared({"schema"}, [&] { dup2(ends[1], STDOUT_FILENO); }).status, 0);
  close(ends[1]);
  EXPECT_THAT(run_prepared({"schema"}, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); }),
              Ends(4, HasSubstr("standard output")));
  // With no stdout at all, the first file that is opened must not become it.
  const Outcome none =
      run_prepared({"guidance", write_scene_file(), "--out", path("result"), "--json"}, [] {
        close(STDIN_FILENO);
        close(STDOUT_FILENO);
        close(STDERR_FILENO);
      });
  EXPECT_EQ(none.status, 0);
  EXPECT_EQ(read_image_info(path("result/guidance.exr")).width, 96);
}

TEST_F(Program, LocaleChangesNothing) {
  const std::string scene = write_scene_file();
  // From the start of the process, where libraries may read them, and in all that is made.
  const std::vector<std::string> german = {"LC_ALL=de_DE.UTF-8", "LC_NUMERIC=de_DE.UTF-8",
                                           "BELVEDERE_CACHE="};
  ASSERT_EQ(finish(execute({"guidance", scene, "--out", path("de"), "--set",
                            "camera.pitch_deg=-20.5", "--quiet"},
                           german))
                .status,
            0);
  ASSERT_EQ(
      run({"guidance", scene, "--out", path("c"), "--set", "camera.pitch_deg=-20.5", "--quiet"})
          .status,
      0);
  EXPECT_EQ(read_bytes(path("de/guidance.exr")), read_bytes(path("c/guidance.exr")));
}

TEST_F(Program, TooLittleMemoryIsALimit) {
  EXPECT_THAT(run({"render", write_scene_file(), "--out", path("result"), "--memory", "1"}),
              Ends(5, HasSubstr("MiB")));
#ifdef BELVEDERE_SANITIZED
  GTEST_SKIP() << "sanitizers need more address space than the rest of this test allows";
#endif
  // An allocation that fails: a grey TIFF of 400 MB that takes no disk, 4.5 GiB once it is a
  // picture.
  const std::string large = write_labels(
      "large.tif", 20000, 20000, [](int, int) { return 0; }, false);
  const Outcome starved = run_prepared({"diff", large, large}, [] {
    setenv("BELVEDERE_MEMORY_MIB", "100000", 1);
    const rlimit bytes{3UL << 30U, 3UL << 30U};
    setrlimit(RLIMIT_AS, &bytes);
  });
  EXPECT_EQ(starved.status, 5) << starved.err;
  EXPECT_THAT(starved.err, HasSubstr("not enough memory"));
}

}  // namespace
}  // namespace belvedere
