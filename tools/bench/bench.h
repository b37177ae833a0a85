#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere::bench {

struct Options {
  std::vector<int> sizes = {1024, 4096};  // cells per side of the synthetic terrain
  int repeats = 3;                        // of each measurement; the fastest counts
  std::string scene;                      // of the sections studio and picture
  std::vector<std::string> data_folders;  // with its data
  std::string gesture;  // of the section studio: that alone, in the first rung; empty: all
};

// One figure of the report.
struct Measurement {
  std::string name;
  double value = 0.0;
  std::string unit;
};

// A file bench_<what>.cpp holds one section, declared and listed in bench.cpp.
struct Section {
  std::string_view name;
  std::string_view meaning;
  std::vector<Measurement> (*run)(const Options&);
};

// Elapsed time, and processor time of all threads of this process together.
struct Cost {
  double wall_s = 0.0;
  double cpu_s = 0.0;
};
Cost measure(const std::function<void()>& work);
// The cost of this process so far; its elapsed time has no fixed beginning.
Cost spent();
// The minimum of several runs by processor time, because other load on the machine only adds time.
// Works that are compared alternate, so that a slow minute of the machine slows them all.
std::vector<Cost> measure_fastest(int repeats, const std::vector<std::function<void()>>& works);

// Peak resident memory of this process since the last reset. Where the system cannot reset it,
// since the start of the program.
double peak_memory_mb();
void reset_peak_memory();
// Present resident memory; 0 where the system does not report it.
double resident_memory_mb();

}  // namespace belvedere::bench
