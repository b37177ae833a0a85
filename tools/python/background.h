#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/cache/cache.h"
#include "base/run.h"

namespace belvedere::python {

// Runs work in a thread of its own, without Python's lock. The calling thread shows its progress,
// answers signals, and stops the work where Ctrl-C or the display asks for it: what they raised is
// then thrown, else what the work throws. `request` (belvedere._progress.run): display, threads (0:
// all), memory in MiB (0: three quarters of the machine's), whether the cache is used.
void run_in_background(const pybind11::tuple& request, const std::function<void(const Run&)>& work);

// The same with a result.
template <class Work>
auto in_background(const pybind11::tuple& request, Work&& work) {
  std::optional<std::invoke_result_t<Work&, const Run&>> out;
  run_in_background(request, [&](const Run& run) { out.emplace(work(run)); });
  return std::move(*out);
}

}  // namespace belvedere::python
