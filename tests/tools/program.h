#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/image_io.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/paths.h"

// Runs the built program as users do.
namespace belvedere {

using test::read_bytes;

struct Outcome {
  int status = -1;  // exit status; 1000 + signal where one ended it
  std::string out;
  std::string err;
};

inline Raster<float> read_raster_file(const std::string& file) {
  RasterSource source;
  source.path = file;
  return read_raster(source);
}

// The built program, and a folder of the test's own.
class Program : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }

  // Starts the program with stdout and stderr in files; `prepare` runs in the child before it.
  pid_t start(const std::vector<std::string>& arguments, const std::function<void()>& prepare = {}) const {
    const std::string program = test::build_folder() + "/belvedere";
    const std::string out = path("stdout");
    const std::string err = path("stderr");
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      signal(SIGINT, SIG_DFL);           // shells let what runs in the background ignore it, and tests interrupt the program
      setenv("BELVEDERE_CACHE", "", 1);  // of whoever runs the tests, nothing counts; `prepare` may name a folder
      dup2(open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO);
      dup2(open(err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
      if (prepare) prepare();
      execv(argv[0], argv.data());
      _exit(127);
    }
    return child;
  }
  Outcome finish(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), read_bytes(path("stdout")), read_bytes(path("stderr"))};
  }
  Outcome run(const std::vector<std::string>& arguments, const std::function<void()>& prepare = {}) const {
    return finish(start(arguments, prepare));
  }
  std::string write(const std::string& name, const std::string& text) const { return folder_.write(name, text); }
  std::string write_picture(const std::string& name, int width, int height, const std::function<glm::vec3(int, int)>& colour) const {
    Grid<glm::vec3> picture(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) picture(x, y) = colour(x, y);
    write_png8(path(name), picture, {});
    return path(name);
  }
  // A grey image, which the program itself never writes: a TIFF by hand, 8 bit, one strip. Without `fill` all of it is a hole of the file.
  std::string write_labels(const std::string& name, int width, int height, const std::function<int(int, int)>& label,
                           bool fill = true) const {
    std::string bytes("II*\0\x08\0\0\0", 8);
    const auto u16 = [&](unsigned v) { bytes += {static_cast<char>(v & 0xff), static_cast<char>(v >> 8)}; };
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
    std::filesystem::resize_file(file, 8 + 2 + entries * 12 + 4 + static_cast<std::uintmax_t>(width) * static_cast<std::uintmax_t>(height));
    return file;
  }
  // A scene of small made-up mountains.
  std::string write_scene_file(const std::string& more = "") const {
    return write("scene.toml",
                 "version = 1\n" + more +
                     "\n[terrain.synthetic]\nwidth = 96\nheight = 96\ncell_m = 200\n[camera]\nposition = [9000, -9000]\nheight_m = 9000\n"
                     "pitch_deg = -25\n[synthesis]\nenabled = false\n[output]\nwidth = 96\nheight = 64\n");
  }
  test::Folder folder_;
};

}  // namespace belvedere
