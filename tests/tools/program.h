#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/scenes.h"
#include "tests/shared_cache.h"
#include "tests/tools/program_server.h"

// Runs the built program as users do.
namespace belvedere {

using test::read_bytes;

struct Outcome {
  int status = -1;  // exit status; 1000 + signal where one ended it
  std::string out;
  std::string err;
};
inline void PrintTo(const Outcome& outcome, std::ostream* out) {
  *out << "status " << outcome.status << ": " << outcome.err;
}
// What EXPECT_THAT expects of an outcome: its status and, where given, its messages.
inline auto Ends(int status) { return ::testing::Field("status", &Outcome::status, status); }
template <class M>
auto Ends(int status, M messages) {
  return ::testing::AllOf(Ends(status), ::testing::Field("err", &Outcome::err, messages));
}
// That it ends well, and its output.
template <class M>
auto Prints(M output) {
  return ::testing::AllOf(Ends(0), ::testing::Field("out", &Outcome::out, output));
}

inline Raster<float> read_raster_file(const std::string& file) {
  RasterSource source;
  source.path = file;
  return read_raster(source);
}

// The built program, and a folder of the test's own.
class Program : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }

  // Starts the program with stdout and stderr in files, `environment` ("NAME=value") added, and the
  // cache that tests share.
  pid_t start(const std::vector<std::string>& arguments,
              const std::vector<std::string>& environment = {}) const {
    if (!test::has_program_server()) return execute(arguments, environment);
    return test::start_in_server(arguments, with_cache(environment), path("stdout"),
                                 path("stderr"));
  }
  // As a process of its own, as users do; `prepare` runs in the child before it.
  pid_t execute(const std::vector<std::string>& arguments,
                const std::vector<std::string>& environment = {},
                const std::function<void()>& prepare = {}) const {
    const std::string program = test::build_folder() + "/belvedere";
    const std::string out = path("stdout");
    const std::string err = path("stderr");
    std::vector<std::string> words = arguments;
    std::vector<std::string> variables = with_cache(environment);
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      test::prepare_environment(variables, out, err);
      if (prepare) prepare();
      execv(argv[0], argv.data());
      _exit(127);
    }
    return child;
  }
  Outcome finish(pid_t child) const {
    int status = 0;
    if (waitpid(child, &status, 0) < 0) status = test::wait_in_server(child);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status),
            read_bytes(path("stdout")), read_bytes(path("stderr"))};
  }
  Outcome run(const std::vector<std::string>& arguments,
              const std::vector<std::string>& environment = {}) const {
    return finish(start(arguments, environment));
  }
  Outcome run_prepared(const std::vector<std::string>& arguments,
                       const std::function<void()>& prepare) const {
    return finish(execute(arguments, {}, prepare));
  }
  std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::string write_picture(const std::string& name, int width, int height,
                            const std::function<glm::vec3(int, int)>& colour) const {
    Grid<glm::vec3> picture(width, height);
    for (const auto [x, y] : test::cells(width, height)) picture(x, y) = colour(x, y);
    write_png8(path(name), picture, {});
    return path(name);
  }
  // A grey image, which the program itself never writes: a TIFF by hand, 8 bit, one strip. Without
  // `fill` all of it is a hole of the file.
  std::string write_labels(const std::string& name, int width, int height,
                           const std::function<int(int, int)>& label, bool fill = true) const {
    std::string bytes("II*\0\x08\0\0\0", 8);
    const auto u16 = [&](unsigned v) {
      bytes += {static_cast<char>(v & 0xff), static_cast<char>(v >> 8)};
    };
    const auto entry = [&](unsigned tag, unsigned type, unsigned long value) {
      u16(tag);
      u16(type);
      u16(1);
      u16(0);
      u16(static_cast<unsigned>(value & 0xffff));
      u16(static_cast<unsigned>(value >> 16));
    };
    constexpr unsigned entries = 8;
    u16(entries);
    entry(256, 4, static_cast<unsigned long>(width));
    entry(257, 4, static_cast<unsigned long>(height));
    entry(258, 3, 8);
    entry(259, 3, 1);
    entry(262, 3, 1);
    entry(273, 4, 8 + 2 + entries * 12 + 4);
    entry(278, 4, static_cast<unsigned long>(height));
    entry(279, 4, static_cast<unsigned long>(width) * static_cast<unsigned long>(height));
    bytes.append(4, '\0');
    for (int y = 0; fill && y < height; ++y)
      for (int x = 0; x < width; ++x) bytes += static_cast<char>(label(x, y));
    const std::string file = write(name, bytes);
    std::filesystem::resize_file(
        file, 8 + 2 + entries * 12 + 4 +
                  static_cast<std::uintmax_t>(width) * static_cast<std::uintmax_t>(height));
    return file;
  }
  // A scene of small synthetic mountains.
  std::string write_scene_file(const std::string& more = "") const {
    return write("scene.toml", "version = 1\n" + more + "\n" + test::small_mountains +
                                   "[synthesis]\nenabled = false\n[output]\nwidth = 96\nheight = "
                                   "64\nsheet_width_mm = 96\n");
  }
  // Small terrain, a picture that takes minutes with one thread.
  std::string write_large_scene() const {
    return write("large.toml", "version = 1\n" + test::small_mountains +
                                   "[output]\nwidth = 16000\nheight = 8000\n");
  }
  // For tests of what the cache might hide: nothing is kept.
  static std::vector<std::string> without_cache() { return {"BELVEDERE_CACHE="}; }
  test::Folder folder_;

 private:
  static std::vector<std::string> with_cache(const std::vector<std::string>& environment) {
    std::vector<std::string> variables = {"BELVEDERE_CACHE=" + test::shared_cache_folder()};
    variables.insert(variables.end(), environment.begin(), environment.end());
    return variables;
  }
};

}  // namespace belvedere
