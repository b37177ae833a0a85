#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include "base/run.h"
#include "base/text/json.h"
#include "renderer/scene/scene_file.h"

namespace belvedere::tools {

// The real job beside the live pictures, one at a time: `render` into a folder, and its zoomable
// page.
class RenderJob {
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
  };

  ~RenderJob();
  // Error(usage) while another one runs.
  void start(const LoadedScene& scene, const std::string& folder, const Run& run);
  void cancel() { cancelled_ = true; }
  Report report() const;
  // Of the page, once the job is done: FOLDER/web.
  static std::string page_folder(const std::string& folder);

 private:
  class JobProgress;
  void work(const LoadedScene& scene, const std::string& folder, const Run& run);

  mutable std::mutex mutex_;
  Report report_;
  std::chrono::steady_clock::time_point begun_;
  std::chrono::steady_clock::time_point stage_begun_;
  std::atomic<bool> cancelled_ = false;
  std::thread thread_;
};

// What the studio answers: docs/studio.md describes the members.
Json job_json(const RenderJob::Report& report);

}  // namespace belvedere::tools
