#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "renderer/live/live_view.h"

namespace belvedere::tools {

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

  // What is being done, and how much of that, 0…1; an empty name: nothing.
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
