#include "tools/python/background.h"

#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "tools/cli/scene_options.h"

namespace py = pybind11;

namespace belvedere::python {
namespace {

// What the work reports, until the calling thread asks for it.
class Told final : public Progress {
 public:
  void begin(std::string_view stage, double total) override {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    done_ = 0.0;
    total_ = total;
    go_on();
  }
  void advance(double amount) override {
    const std::lock_guard lock(mutex_);
    done_ += amount;
    go_on();
  }
  void note(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    notes_.emplace_back(text);
  }
  // stage, amount done, total, notes since the last call
  std::tuple<std::string, double, double, std::vector<std::string>> take() {
    const std::lock_guard lock(mutex_);
    return {stage_, done_, total_, std::exchange(notes_, {})};
  }
  void stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }

 private:
  void go_on() const {
    if (stopped_) throw Error(ErrorKind::interrupted, "belvedere", "stopped by the user");
  }

  std::mutex mutex_;
  std::string stage_;
  double done_ = 0.0;
  double total_ = 0.0;
  std::vector<std::string> notes_;
  bool stopped_ = false;
};

void show(const py::object& display, Told& told) {
  const auto [stage, done, total, notes] = told.take();
  for (const std::string& note : notes) display.attr("note")(note);
  display.attr("update")(stage, done, total);
}

// A run's files are protected while it lasts; the next may replace its results. Counted with
// Python's lock.
struct Protection {
  Protection() { ++runs; }
  ~Protection() {
    if (--runs == 0) file_guard().clear();
  }
  inline static int runs = 0;
};

}  // namespace

void run_in_background(const py::tuple& request, const std::function<void(const Run&)>& work) {
  const py::object display = request[0];
  const Protection protection;
  Told told;
  std::exception_ptr raised;
  const auto guarded = [&](auto&& call) {
    try {
      call();
    } catch (...) {
      if (!raised) raised = std::current_exception();
      told.stop();
    }
  };
  tools::SceneOptions options;
  options.threads = request[1].cast<int>();
  options.memory_mib = request[2].cast<int>();
  options.no_cache = !request[3].cast<bool>();
  std::future<void> done = std::async(std::launch::async, [&] {
    const Cache cache = tools::make_cache(options);
    const Run run = tools::make_run(options, Run{}.tile_px, told, cache);
    const RunLimits limits(run);
    work(run);
  });
  const auto has_ended = [&] {
    const py::gil_scoped_release free;
    return done.wait_for(std::chrono::milliseconds(100)) == std::future_status::ready;
  };
  while (!has_ended())
    guarded([&] {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (!raised) show(display, told);
    });
  guarded([&] { done.get(); });
  guarded([&] {
    if (!raised) show(display, told);
    display.attr("close")();
  });
  if (raised) std::rethrow_exception(raised);
}

}  // namespace belvedere::python
