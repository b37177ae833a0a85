#include <fmt/core.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <system_error>

#include "base/random.h"
#include "renderer/image/guidance_io.h"
#include "renderer/image/image_io.h"
#include "tools/bench/bench.h"

namespace belvedere::bench {

std::vector<Measurement> bench_files(const Options&);

namespace {

// Smooth shapes with some grain, like a painting: neither noise nor one colour, so that compression
// has its usual work.
float shade(int x, int y, std::uint64_t channel) {
  const double smooth = 0.5 + 0.3 * std::sin(x * 0.01) * std::cos(y * 0.013);
  return static_cast<float>(smooth + 0.1 * random_uniform(1, x / 3, y / 3, channel) +
                            0.01 * random_uniform(2, x, y, channel));
}

Grid<glm::vec3> make_picture(int width, int height) {
  Grid<glm::vec3> out(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      out(x, y) = glm::vec3(shade(x, y, 0), shade(x, y, 1), shade(x, y, 2));
  }
  return out;
}

// The channels that are largest in a file: distances, positions, directions, ids, tone.
GuidanceBuffers make_guidance(int width, int height) {
  GuidanceBuffers g;
  g.depth_m = Grid<float>(width, height);
  g.altitude_m = Grid<float>(width, height);
  g.tone = Grid<float>(width, height);
  g.position_m = Grid<glm::vec3>(width, height);
  g.normal = Grid<glm::vec3>(width, height);
  g.land_cover = Grid<LandCoverClass>(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      g.depth_m(x, y) = 1e4f * shade(x, y, 3);
      g.altitude_m(x, y) = 2e3f * shade(x, y, 4);
      g.tone(x, y) = shade(x, y, 5);
      g.position_m(x, y) =
          glm::vec3(20.0f * static_cast<float>(x), 1e4f * shade(x, y, 3), 2e3f * shade(x, y, 4));
      g.normal(x, y) = glm::vec3(shade(x, y, 6) - 0.5f, shade(x, y, 7) - 0.5f, 0.8f);
      g.land_cover(x, y) = static_cast<LandCoverClass>((x / 50 + y / 30) % land_cover_class_count);
    }
  }
  return g;
}

}  // namespace

// Megabytes are those of the values before compression, in the types of the file. The time includes
// the check of what was written.
std::vector<Measurement> bench_files(const Options& options) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("belvedere-bench-{}", ::getpid());
  std::filesystem::create_directories(folder);
  const std::string position = folder.string() + "/";
  std::vector<Measurement> out;
  for (const int size : options.sizes) {
    const Grid<glm::vec3> picture = make_picture(size, size / 2);
    const GuidanceBuffers guidance = make_guidance(size, size / 2);
    const double pixels = static_cast<double>(picture.size());
    struct File {
      const char* name;
      double bytes;  // a pixel
      std::function<void()> work;
    };
    const std::vector<File> files = {
        {"tiff_write", 6.0, [&] { write_tiff16(position + "a.tif", picture, {}); }},
        {"png_write", 3.0, [&] { write_png8(position + "a.png", picture, {}); }},
        {"exr_write", 6.0, [&] { write_exr(position + "a.exr", picture, {}); }},
        {"guidance_write", 32.0, [&] { write_guidance(position + "g.exr", guidance, {}); }},
        {"tiff_read", 6.0, [&] { read_picture(position + "a.tif"); }},
        {"guidance_read", 32.0, [&] { read_guidance(position + "g.exr"); }},
    };
    for (const File& file : files) {
      const Cost cost = measure_fastest(options.repeats, {file.work})[0];
      out.push_back({fmt::format("{}/{}", size, file.name), pixels * file.bytes / cost.cpu_s * 1e-6,
                     "MB/CPU s"});
      out.push_back({fmt::format("{}/{}_wall", size, file.name),
                     pixels * file.bytes / cost.wall_s * 1e-6, "MB/s"});
    }
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return out;
}

}  // namespace belvedere::bench
