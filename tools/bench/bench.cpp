#include "tools/bench/bench.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>

#include "base/error.h"
#include "base/memory/zeroed_memory.h"
#include "base/parallel.h"
#include "tools/options/options.h"

namespace belvedere::bench {

std::vector<Measurement> bench_picture(const Options&);
std::vector<Measurement> bench_preview(const Options&);
std::vector<Measurement> bench_studio(const Options&);
std::vector<Measurement> bench_synthesis(const Options&);
std::vector<Measurement> bench_trace(const Options&);

namespace {

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {"trace",
       "building the structure and tracing rays, compared with a bare Embree loop over the same "
       "rays",
       &bench_trace},
      {"synthesis", "painting by example, with one guide and with seven", &bench_synthesis},
      {"studio", "from a change of --scene to its live picture", &bench_studio},
      {"picture", "the picture of --scene by stage, and what a second thread brings to each",
       &bench_picture},
      {"preview", "how far the ground of previews of --scene is from the print's", &bench_preview},
  };
  return all;
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

rusage used() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace

Cost spent() {
  const rusage usage = used();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now().time_since_epoch();
  return {wall.count(), seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

Cost measure(const std::function<void()>& work) {
  const Cost before = spent();
  work();
  const Cost after = spent();
  return {after.wall_s - before.wall_s, after.cpu_s - before.cpu_s};
}

std::vector<Cost> measure_fastest(int repeats, const std::vector<std::function<void()>>& works) {
  std::vector<Cost> best(works.size(), {0.0, std::numeric_limits<double>::infinity()});
  for (int r = 0; r < repeats; ++r) {
    for (std::size_t i = 0; i < works.size(); ++i) {
      const Cost cost = measure(works[i]);
      if (cost.cpu_s < best[i].cpu_s) best[i] = cost;
    }
  }
  return best;
}

double peak_memory_mb() { return static_cast<double>(used().ru_maxrss) / 1024.0; }

double resident_memory_mb() {
  double pages = 0.0;  // Linux: proc(5)
  std::ifstream("/proc/self/statm") >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }  // Linux: proc(5)

namespace {

int run(int argc, char** argv) {
  tools::CommandLine line(
      argc > 0 ? argv[0] : "bench",
      "Measures the speed of Belvedere's stages on synthetic terrain and prints JSON.");
  tools::CommandOptions& command = line.options();
  Options options;
  int threads = 0;
  std::string only;
  std::string sections_text;
  for (const Section& section : sections())
    sections_text += fmt::format("{}  {}\n", section.name, section.meaning);
  command.footer("Sections:\n" + sections_text);
  command.add_option("--size", options.sizes, "Cells per side of the terrain")
      .range(64, 16384)
      .show_default();
  command.add_option("--repeats", options.repeats, "Runs of each measurement; the fastest counts")
      .range(1, 100)
      .show_default();
  command.add_option("--threads", threads, "Threads; 0: all").range(0, 1024);
  command.add_option("--scene", options.scene, "A scene, for the sections studio and picture");
  command.add_option("--data", options.data_folders, "Folder of its data");
  command.add_option(
      "--gesture", options.gesture,
      "One change of the section studio, alone and in the first rung: camera, sun …");
  command.add_option("section", only, "The section to run. Default: all");
  if (const std::string help = line.read({argv + (argc > 0 ? 1 : 0), argv + argc}); !help.empty()) {
    fmt::print("{}", help);
    return 0;
  }
  const auto requested = [&](const Section& section) {
    return only.empty() || section.name == only;
  };
  if (std::none_of(sections().begin(), sections().end(), requested))
    throw Error(ErrorKind::usage, "section", only, sections_text);
  const ThreadLimit limit(threads);

  std::string body;
  double peak = 0.0;
  for (const Section& section : sections()) {
    if (!requested(section)) continue;
    std::string lines;
    const std::vector<Measurement> measured = section.run(options);
    peak = std::max(peak, peak_memory_mb());
    for (const Measurement& m : measured) {
      lines += fmt::format("{}\n    {{\"name\": {}, \"value\": {:.6g}, \"unit\": {}}}",
                           lines.empty() ? "" : ",", json_text(m.name), m.value, json_text(m.unit));
    }
    body +=
        fmt::format("{}\n  {}: [{}\n  ]", body.empty() ? "" : ",", json_text(section.name), lines);
  }
  body += fmt::format("{}\n  \"peak_memory_mb\": {:.1f}", body.empty() ? "" : ",", peak);
  fmt::print("{{{}\n}}\n", body);
  return 0;
}

}  // namespace
}  // namespace belvedere::bench

int main(int argc, char** argv) {
  // Not fmt::print, which may itself throw.
  const auto fail = [](const char* message, int status) {
    std::fprintf(stderr, "bench: %s\n", message);
    return status;
  };
  belvedere::reuse_freed_memory();
  try {
    return belvedere::bench::run(argc, argv);
  } catch (const belvedere::Error& error) {
    return fail(error.what(), error.exit_status());
  } catch (const std::exception& error) {
    return fail(error.what(), static_cast<int>(belvedere::ErrorKind::bug));
  }
}
