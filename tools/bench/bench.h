#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere::bench {

struct Options {
  std::vector<int> sizes = {1024, 4096};  // cells on a side of the made-up terrain
  int repeats = 3;                        // of each measurement; the fastest counts
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

// Time that work took: on the clock, and of all processors of this process together.
struct Cost {
  double wall_s = 0.0;
  double cpu_s = 0.0;
};
Cost measure(const std::function<void()>& work);
// The same where the work is done by a program that is started and waited for.
Cost measure_child(const std::function<int()>& work);
// The least of several runs by processor time: what else the machine does only ever adds. Where several works are compared they
// take turns, so that a slow minute of the machine slows them all.
std::vector<Cost> measure_fastest(int repeats, const std::vector<std::function<void()>>& works);

// Most memory this process had resident since the last reset. Where the system cannot reset it, since the start of the program.
double peak_memory_mb();
void reset_peak_memory();
// What it has resident now; 0 where the system does not say.
double resident_memory_mb();

}  // namespace belvedere::bench
