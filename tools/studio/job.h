#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "base/run.h"
#include "base/text/json.h"

namespace belvedere::tools {

// Long work beside the live pictures, which writes into a folder; one at a time.
class Job {
 public:
  enum class State { idle, running, done, failed, cancelled };
  struct Report {
    State state = State::idle;
    std::string stage;
    double done = 0.0;  // of the stage, 0…1
    double elapsed_s = 0.0;
    double left_s = -1.0;  // of the stage; negative: not known
    std::string folder;
    std::string error;
    std::string result;  // of the work, once it is done
  };
  // Called in a thread of its own, with a progress that throws Error(interrupted) after cancel().
  using Work = std::function<std::string(const Run& run)>;

  // name: of the work, in messages: "render".
  explicit Job(std::string name) : name_(std::move(name)) {}
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  // Error(usage) while another one runs.
  void start(const std::string& folder, const Run& run, Work work);
  void cancel() { cancelled_ = true; }
  Report report() const;

 private:
  class JobProgress;
  void do_work(const Run& run, const Work& work);

  std::string name_;
  std::mutex start_mutex_;    // of the thread: requests to start may come at the same time
  mutable std::mutex mutex_;  // of the report and its times
  Report report_;
  std::chrono::steady_clock::time_point begun_;
  std::chrono::steady_clock::time_point stage_begun_;
  std::atomic<bool> cancelled_ = false;
  std::thread thread_;
};

// What the studio answers, without the result: docs/studio.md describes the members.
Json job_json(const Job::Report& report);

}  // namespace belvedere::tools
