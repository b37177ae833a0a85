#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/cache/cache.h"
#include "base/run.h"

namespace belvedere::python {

// How a call runs. In Python a tuple: display, threads (0: all), memory_mib (0: three quarters of
// the machine's), cache.
struct RunRequest {
  pybind11::object display;  // belvedere._progress.Display
  int threads = 0;
  int memory_mib = 0;
  bool cache = true;
};
RunRequest run_request(const pybind11::tuple& given);

// Runs work in a thread of its own, without Python's lock. The calling thread shows its progress,
// answers signals, and stops the work where Ctrl-C or the display asks for it: what they raised is
// then thrown, else what the work throws.
void run_in_background(const RunRequest& request, const std::function<void(const Run& run)>& work);

// The same with a result.
template <class Work>
auto in_background(const pybind11::tuple& request, Work&& work) {
  std::optional<std::invoke_result_t<Work&, const Run&>> out;
  run_in_background(run_request(request), [&](const Run& run) { out.emplace(work(run)); });
  return std::move(*out);
}

}  // namespace belvedere::python
