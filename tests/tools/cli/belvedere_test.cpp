// The program as users meet it: exit statuses, messages, what it writes. Each test runs the built program.
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
#include "renderer/image/image_io.h"
#include "renderer/scene/scene_file.h"
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
  EXPECT_THAT(help.out, AllOf(HasSubstr("render"), HasSubstr("synthesize"), HasSubstr("Exit status"), HasSubstr("scenes/karwendel.toml")));
  EXPECT_THAT(help.err, IsEmpty());
  EXPECT_THAT(run({"--version"}).out, AllOf(HasSubstr("belvedere 0."), HasSubstr("Embree")));
  for (const char* command : {"render", "guidance", "synthesize", "check", "deform", "info", "diff", "schema"}) {
    const Outcome one = run({command, "--help"});
    EXPECT_EQ(one.status, 0) << command;
    EXPECT_THAT(one.out, HasSubstr("  belvedere " + std::string(command))) << "no example";
    EXPECT_THAT(help.out, HasSubstr(command));
  }
}

TEST_F(Program, WrongCommandLinesAreUsageErrors) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{{},
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
  EXPECT_THAT(said({}), HasSubstr("what shall belvedere do?\n  allowed: render, guidance"));
  EXPECT_THAT(said({"rendr", "x.toml"}), HasSubstr("belvedere has no command \"rendr\"; did you mean \"render\"?"));
  EXPECT_THAT(said({"exemplar"}), HasSubstr("what shall belvedere exemplar do?\n  allowed: check, compare, paint."));
  EXPECT_THAT(said({"exemplar", "pain"}), HasSubstr("belvedere exemplar has no command \"pain\"; did you mean \"paint\"?"));
  EXPECT_THAT(said({"exemplar", "xyz"}), Not(HasSubstr("did you mean")));
  // Where there is a command, what is wrong with its options is said.
  EXPECT_THAT(said({"exemplar", "paint"}), HasSubstr("--out is required"));
}

TEST_F(Program, SchemaPrintsTheTwoReferences) {
  EXPECT_EQ(run({"schema"}).out, scene_json_schema());
  EXPECT_EQ(run({"schema", "--markdown"}).out, scene_reference());
}

// ---- scenes

TEST_F(Program, SceneMistakesNameFileLineAndColumn) {
  const std::string scene = write("bad.toml", "version = 1\n[camera]\npich_deg = 3\n");
  for (const char* command : {"check", "render", "guidance"}) {
    const Outcome outcome = run({command, scene});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(scene + ":3:1: "), HasSubstr("did you mean \"pitch_deg\"")));
  }
  const Outcome set = run({"check", write_scene_file(), "--set", "output.width=1000000000"});
  EXPECT_EQ(set.status, 2);
  EXPECT_THAT(set.err, AllOf(HasSubstr("--set output.width=1000000000"), HasSubstr("16 … 65535 px")));
}

TEST_F(Program, DeepAndHugeScenesAreRefusedAtOnce) {
  std::string deep = "version = 1\na = ";
  for (int i = 0; i < 10'000; ++i) deep += "[";
  const std::string huge = write("huge.toml", "version = 1\n");
  fs::resize_file(huge, 100'000'000);
  for (const std::string& scene : {write("deep.toml", deep), huge}) {
    const Outcome outcome = run({"check", scene}, [] {
      const rlimit seconds{1, 1};  // of processor time: more would end it by a signal
      setrlimit(RLIMIT_CPU, &seconds);
    });
    EXPECT_EQ(outcome.status, 2) << outcome.err;
  }
}

TEST_F(Program, FilesOutsideTheAllowedFoldersAreRefused) {
  const std::string scene = write("out.toml", "version = 1\n[[terrain.sources]]\nfile = \"../../etc/passwd\"\n");
  EXPECT_EQ(run({"check", scene}).status, 2);
  fs::create_symlink("/etc/passwd", path("dem.tif"));
  const Outcome outcome = run({"check", write("link.toml", "version = 1\n[[terrain.sources]]\nfile = \"dem.tif\"\n")});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("link.toml:3:8"), HasSubstr("outside")));
}

TEST_F(Program, MissingFilesAreAllNamed) {
  const std::string scene = write("missing.toml",
                                  "version = 1\n[[terrain.sources]]\nfile = \"a.tif\"\nget_from = \"https://example.org/a\"\n"
                                  "[[terrain.sources]]\nfile = \"b.tif\"\n[camera]\nposition = [0, 0]\n");
  for (const char* command : {"check", "render", "guidance"}) {
    const Outcome outcome = run({command, scene, "--out", path("result")}, [] {});
    EXPECT_EQ(outcome.status, command == std::string("check") ? 2 : 3);  // check has no --out
    if (command == std::string("check")) continue;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("a.tif"), HasSubstr("b.tif"), HasSubstr("https://example.org/a")));
    EXPECT_FALSE(fs::exists(path("result")));
  }
  EXPECT_EQ(run({"check", scene}).status, 3);
  EXPECT_EQ(run({"check", path("nowhere.toml")}).status, 3);
}

TEST_F(Program, GuidanceIsWrittenAndTold) {
  const std::string scene = write_scene_file("title = \"Test hills\"\n");
  const Outcome outcome = run({"guidance", scene, "--out", path("result"), "--json", "--threads", "1"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"width\": 96"), HasSubstr("guidance.exr"), HasSubstr("\"bytes\": ")));
  // No terminal: one line a stage, nothing drawn over.
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("s)\n"), Not(HasSubstr("\r")), Not(HasSubstr("\033"))));

  const Outcome info = run({"info", path("result/guidance.exr")});
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.out, AllOf(HasSubstr("96 × 64 pixels"), HasSubstr("landcover.id (uint)"), HasSubstr("belvedere:version"),
                              HasSubstr("Test hills")));
  EXPECT_THAT(run({"info", path("result/guidance.exr"), "--json"}).out, AllOf(StartsWith("{\n"), HasSubstr("\"format\": \"openexr\"")));

  // The same from other threads and tiles, quietly.
  const Outcome again = run({"guidance", scene, "--out", path("again"), "--quiet", "--threads", "2", "--tile", "8"});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, IsEmpty());
  EXPECT_THAT(again.out, IsEmpty());
  EXPECT_EQ(read_bytes(path("again/guidance.exr")), read_bytes(path("result/guidance.exr")));
  const Outcome diff = run({"diff", path("again/guidance.exr"), path("result/guidance.exr")});
  EXPECT_EQ(diff.status, 0) << diff.out;
}

TEST_F(Program, CameraUnderGroundIsAUsageError) {
  const Outcome outcome = run({"check", write_scene_file(), "--set", "camera.position=[9000, 9000]", "--set", "camera.height_m=-900"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("camera.height_m"), HasSubstr("below the ground")));
}

TEST_F(Program, CheckReportsWhatItSaw) {
  const Outcome outcome = run({"check", write_scene_file(), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"valid\": true"), HasSubstr("\"cell_m\": 200"), HasSubstr("\"classes\": {")));
}

TEST_F(Program, CheckSaysWhatBecameOfSmallPatches) {
  const std::string scene = write_scene_file("[land_cover]\nsmallest_patch_m2 = 1e6\n");
  const Outcome words = run({"check", scene});
  ASSERT_EQ(words.status, 0) << words.err;
  EXPECT_THAT(words.out, AllOf(HasSubstr("land cover: "), HasSubstr("before small ones were taken out")));
  EXPECT_THAT(run({"check", scene, "--json"}).out, HasSubstr("\"patches_before\": "));
  EXPECT_THAT(run({"check", write_scene_file()}).out, Not(HasSubstr("land cover: ")));
}

TEST_F(Program, UnwritableFolderIsAnOutputError) {
  write("file", "in the way");
  const Outcome outcome = run({"guidance", write_scene_file(), "--out", path("file/result")});
  EXPECT_EQ(outcome.status, 4);
  EXPECT_THAT(outcome.err, HasSubstr("file"));
}

// ---- signals, streams, memory

TEST_F(Program, SignalsStopItAndASecondOneEndsIt) {
  // Small terrain, a picture that takes minutes with one thread.
  const std::string scene =
      write("large.toml",
            "version = 1\n[terrain.synthetic]\nwidth = 96\nheight = 96\ncell_m = 200\n[camera]\nposition = [9000, -9000]\n"
            "height_m = 9000\npitch_deg = -25\n[output]\nwidth = 16000\nheight = 8000\n");
  const auto start_tracing = [&] {
    fs::remove(path("stderr"));
    const pid_t child = start({"guidance", scene, "--out", path("result"), "--threads", "1"});
    // The terrain is done when the first lines stand in the log.
    for (int i = 0; i < 1000 && read_bytes(path("stderr")).find("building the ray tracer") == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return child;
  };
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start_tracing();
    kill(child, signal);
    const Outcome outcome = finish(child);
    EXPECT_EQ(outcome.status, 75) << outcome.err;
    EXPECT_TRUE(fs::is_empty(path("result"))) << "something half written is left";
  }
  const pid_t child = start_tracing();
  kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  const int status = finish(child).status;
  EXPECT_TRUE(status == 75 || status == 1000 + SIGINT) << status;
}

TEST_F(Program, ClosedStreamsDoNoHarm) {
  // A reader that went away is no failure; a full disk is one.
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  close(ends[0]);
  EXPECT_EQ(run({"schema"}, [&] { dup2(ends[1], STDOUT_FILENO); }).status, 0);
  close(ends[1]);
  const Outcome full = run({"schema"}, [] { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); });
  EXPECT_EQ(full.status, 4);
  EXPECT_THAT(full.err, HasSubstr("standard output"));
  // With no stdout at all, the first file that is opened must not become it.
  const Outcome none = run({"guidance", write_scene_file(), "--out", path("result"), "--json"}, [] {
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    close(STDERR_FILENO);
  });
  EXPECT_EQ(none.status, 0);
  EXPECT_EQ(read_image_info(path("result/guidance.exr")).width, 96);
}

TEST_F(Program, LocaleChangesNothing) {
  const std::string scene = write_scene_file();
  const auto german = [] {
    setenv("LC_ALL", "de_DE.UTF-8", 1);
    setenv("LC_NUMERIC", "de_DE.UTF-8", 1);
  };
  ASSERT_EQ(run({"guidance", scene, "--out", path("de"), "--set", "camera.pitch_deg=-20.5", "--quiet"}, german).status, 0);
  ASSERT_EQ(run({"guidance", scene, "--out", path("c"), "--set", "camera.pitch_deg=-20.5", "--quiet"}).status, 0);
  EXPECT_EQ(read_bytes(path("de/guidance.exr")), read_bytes(path("c/guidance.exr")));
}

TEST_F(Program, TooLittleMemoryIsALimit) {
  const Outcome wide = run({"render", write_scene_file(), "--out", path("result"), "--memory", "1"});
  EXPECT_EQ(wide.status, 5);
  EXPECT_THAT(wide.err, HasSubstr("MiB"));
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need more address space than the rest of this test allows";
#endif
  // An allocation that fails: a grey TIFF of 400 MB that takes no disk, 4.5 GiB once it is a picture.
  const std::string large = write_labels(
      "large.tif", 20000, 20000, [](int, int) { return 0; }, false);
  const Outcome starved = run({"diff", large, large}, [] {
    setenv("BELVEDERE_MEMORY_MIB", "100000", 1);
    const rlimit bytes{3UL << 30U, 3UL << 30U};
    setrlimit(RLIMIT_AS, &bytes);
  });
  EXPECT_EQ(starved.status, 5) << starved.err;
  EXPECT_THAT(starved.err, HasSubstr("not enough memory"));
}

// ---- pictures

TEST_F(Program, DiffHasThresholds) {
  const auto grey = [](int x, int y) { return glm::vec3(static_cast<float>(x + y) / 255.F); };
  const std::string a = write_picture("a.png", 40, 30, grey);
  const std::string same = write_picture("same.png", 40, 30, grey);
  // One pixel of 1200 is 51/255 lighter in red.
  const std::string b = write_picture(
      "b.png", 40, 30, [&](int x, int y) { return grey(x, y) + (x == 7 && y == 9 ? glm::vec3(51.F / 255.F, 0.F, 0.F) : glm::vec3(0.F)); });
  const std::string small = write_picture("small.png", 39, 30, grey);
  EXPECT_EQ(run({"diff", a, same}).status, 0);
  EXPECT_EQ(run({"diff", a, b}).status, 1);
  EXPECT_EQ(run({"diff", a, b, "--max-max", "0.21"}).status, 0);
  EXPECT_EQ(run({"diff", a, b, "--max-max", "0.19"}).status, 1);
  EXPECT_EQ(run({"diff", a, b, "--max-mean", "0.0002"}).status, 0);
  EXPECT_EQ(run({"diff", a, b, "--max-mean", "0.0001"}).status, 1);
  EXPECT_EQ(run({"diff", a, b, "--max-mean", "0.0002", "--max-max", "0.19"}).status, 1);
  const Outcome sizes = run({"diff", a, small, "--max-max", "1"});
  EXPECT_EQ(sizes.status, 1);
  EXPECT_THAT(sizes.out, HasSubstr("40 × 30 pixels against 39 × 30"));
  EXPECT_EQ(run({"diff", a, path("none.png")}).status, 3);
  EXPECT_EQ(run({"info", write("text.png", "no picture")}).status, 3);
}

// Two classes, a red and a green texture; the target swaps their sides. Whatever is synthesized, red stays on its label.
TEST_F(Program, SynthesizeFromImageFiles) {
  const auto texture = [](int x, int y) {
    const float v = static_cast<float>((x * 7 + y * 13) % 32) / 64.F;
    return x < 32 ? glm::vec3(0.5F + v, v, 0.F) : glm::vec3(0.F, 0.5F + v, v);
  };
  const std::string style = write_picture("style.png", 64, 48, texture);
  const std::string style_class = write_labels("style_class.tif", 64, 48, [](int x, int) { return x < 32 ? 1 : 2; });
  const std::string target_class = write_labels("target_class.tif", 48, 40, [](int x, int) { return x < 24 ? 2 : 1; });
  const std::string style_alt = write_labels("style_alt.tif", 64, 48, [](int, int y) { return 5 * y; });
  const std::string target_alt = write_labels("target_alt.tif", 48, 40, [](int, int y) { return 6 * y; });
  const auto arguments = [&](const std::string& out, const std::string& match, const std::string& threads) {
    return std::vector<std::string>{"synthesize", "--picture", style,      "--label",   style_class, target_class, "--guide",
                                    "altitude",   style_alt,   target_alt, "1.0",       "--out",     out,          "--match",
                                    match,        "--seed",    "3",        "--threads", threads,     "--json",     "--quiet"};
  };
  const Outcome outcome = run(arguments(path("out.png"), path("match.exr"), "1"));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\"pixels_without_texel\": 0"));
  const Grid<glm::vec3> source = read_picture(style);
  const Grid<glm::vec3> out = read_picture(path("out.png"));
  const Grid<std::uint32_t> xs = read_id_channel(path("match.exr"), "x");
  const Grid<std::uint32_t> ys = read_id_channel(path("match.exr"), "y");
  const Grid<std::uint32_t> from = read_id_channel(path("match.exr"), "exemplar");
  ASSERT_EQ(out.width(), 48);
  ASSERT_EQ(out.height(), 40);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const bool red = i % 48 >= 24;
    EXPECT_EQ(from[i], 0U);
    EXPECT_EQ(xs[i] < 32, red);
    EXPECT_EQ(out[i], source(static_cast<int>(xs[i]), static_cast<int>(ys[i])));
  }
  // Twice the same, and with two threads.
  ASSERT_EQ(run(arguments(path("out2.png"), path("match2.exr"), "2")).status, 0);
  EXPECT_EQ(read_bytes(path("out2.png")), read_bytes(path("out.png")));
  EXPECT_EQ(read_bytes(path("match2.exr")), read_bytes(path("match.exr")));
  // Two pictures: the second's labels and guides follow the first's.
  const Outcome two = run({"synthesize", "--picture", style,        "--picture", style,      "--label", style_class,    target_class,
                           "--label",    style_class, target_class, "--guide",   "altitude", style_alt, target_alt,     "1",
                           "--guide",    "altitude",  style_alt,    target_alt,  "1",        "--out",   path("two.tif")});
  EXPECT_EQ(two.status, 0) << two.err;
  EXPECT_EQ(read_image_info(path("two.tif")).format, "tiff");
}

TEST_F(Program, SynthesizeRefusesWhatDoesNotPair) {
  const std::string style = write_picture("style.png", 32, 32, [](int, int) { return glm::vec3(0.5F); });
  const std::string label = write_labels("label.tif", 32, 32, [](int, int) { return 1; });
  const std::string other = write_labels("other.tif", 31, 32, [](int, int) { return 1; });
  const std::string out = path("out.png");
  const auto status = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"synthesize", "--picture", style};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_FALSE(fs::exists(out));
    return outcome.status;
  };
  EXPECT_EQ(status({"--label", other, label, "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--label", label, label, "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--guide", "a", other, label, "1", "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--guide", "a", label, label, "much", "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--guide", "a", label, label, "--out", out}), 2);
  EXPECT_EQ(status({"--label", label, label, "--out", path("out.jpg")}), 2);
  EXPECT_EQ(status({"--label", label, path("none.tif"), "--out", out}), 3);
  EXPECT_EQ(status({"--label", label, label, "--out", path("label.tif/out.png")}), 4);
}

}  // namespace
}  // namespace belvedere
