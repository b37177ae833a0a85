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
  // Waits for the picture that is being made, and does not end it.
  LiveView::Ground ground(const LoadedScene& scene, const Run& run);
  void cancel() { ++newest_; }

 private:
  std::atomic<std::uint64_t> newest_ = 0;
  std::mutex engine_;
  LiveView view_;
};

}  // namespace belvedere::tools
