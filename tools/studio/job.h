#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/progress.h"
#include "base/run.h"
#include "base/text/json.h"
#include "renderer/live/live_view.h"

namespace belvedere::tools {

// Long work beside the live pictures, which writes into a folder; one at a time.
class Job {
 public:
  enum class State { idle, running, done, failed, cancelled };
  struct Report {
    State state = State::idle;
    std::string stage;
    double done = 0.0;  // of all, 0…1; never falls
    double elapsed_s = 0.0;
    double left_s = -1.0;  // of all, estimated; negative: not known
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
  // expected_s: how long it may take all in all, to begin with; 0: not known.
  void start(const std::string& folder, const Run& run, Work work, double expected_s = 0.0);
  void cancel() { cancelled_ = true; }
  Report report() const;

 private:
  class JobProgress;
  void do_work(const Run& run, const Work& work);

  std::string name_;
  std::mutex start_mutex_;    // of the thread: requests to start may come at the same time
  mutable std::mutex mutex_;  // of the members up to `cancelled_`
  mutable Report report_;
  double stage_done_ = 0.0;  // 0…1
  double expected_s_ = 0.0;
  std::chrono::steady_clock::time_point begun_;
  std::chrono::steady_clock::time_point stage_begun_;
  std::atomic<bool> cancelled_ = false;
  std::thread thread_;
};

// The report of a job as the studio answers it, without the result: docs/studio.md describes the
// members.
Json job_json(const Job::Report& report);

// The engine of live pictures, used by several threads: one picture at a time, and the newest
// request ends those before it between two tiles.
class PictureQueue {
 public:
  // A stage of the picture began, and how much of all is done is not known.
  using TellStage = std::function<void(std::string_view stage)>;

  // Error(interrupted) for a picture that is no longer wanted: a newer one was asked for, or
  // cancel() was called.
  LivePicture paint(const LoadedScene& scene, const Rung& rung, const Run& run,
                    std::vector<std::string>* notes = nullptr,
                    const LiveView::UseTile& use_tile = {}, const TellStage& tell = {});
  // The same beside the newest request: ends no picture before it, and is ended by the next.
  LivePicture paint_beside(const LoadedScene& scene, const Rung& rung, const Run& run);
  // Waits for the picture that is being made, and does not end it.
  LiveView::Ground ground(const LoadedScene& scene, const Run& run);
  void cancel() { ++newest_; }

  // The present stage, and how much of it is done, 0…1; an empty name: none.
  struct Stage {
    std::string name;
    double done = 0.0;
  };
  Stage stage() const;

 private:
  class WhileWanted;
  LivePicture paint_as(std::uint64_t own, const LoadedScene& scene, const Rung& rung,
                       const Run& run, std::vector<std::string>* notes,
                       const LiveView::UseTile& use_tile, const TellStage& tell);

  std::atomic<std::uint64_t> newest_ = 0;
  mutable std::mutex stage_mutex_;
  Stage stage_;
  std::mutex engine_;
  LiveView view_;
};

}  // namespace belvedere::tools
