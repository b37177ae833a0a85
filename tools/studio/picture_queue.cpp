#include "tools/studio/picture_queue.h"

#include <algorithm>
#include <future>

#include "base/error.h"
#include "base/memory/zeroed_memory.h"

namespace belvedere::tools {

// Ends a picture that is no longer wanted.
class PictureQueue::WhileWanted : public Progress {
 public:
  WhileWanted(PictureQueue& queue, std::uint64_t own, std::vector<std::string>* notes,
              const TellStage& tell)
      : queue_(queue), own_(own), notes_(notes), tell_(tell) {}
  ~WhileWanted() override {
    const std::lock_guard lock(queue_.stage_mutex_);
    queue_.stage_ = {};
  }
  WhileWanted(const WhileWanted&) = delete;
  WhileWanted& operator=(const WhileWanted&) = delete;
  void begin(std::string_view stage, double total) override {
    check();
    {
      const std::lock_guard lock(queue_.stage_mutex_);
      queue_.stage_ = {std::string(stage), 0.0};
      total_ = total;
    }
    if (tell_) tell_(stage);
  }
  void advance(double amount) override {
    check();
    const std::lock_guard lock(queue_.stage_mutex_);
    if (total_ > 0.0) queue_.stage_.done = std::min(1.0, queue_.stage_.done + amount / total_);
  }
  void note(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    if (notes_ != nullptr) notes_->emplace_back(text);
  }
  void check() const {
    if (queue_.newest_ != own_)
      throw Error(ErrorKind::interrupted, "picture", "superseded", "a request for the newest one");
  }

 private:
  PictureQueue& queue_;
  std::uint64_t own_;
  double total_ = 0.0;  // of the stage, with the queue's stage_mutex_
  std::mutex mutex_;
  std::vector<std::string>* notes_;
  const TellStage& tell_;
};

LivePicture PictureQueue::paint(const LoadedScene& scene, const Rung& rung, const Run& run,
                                std::vector<std::string>* notes, const LiveView::UseTile& use_tile,
                                const TellStage& tell) {
  return paint_as(++newest_, scene, rung, run, notes, use_tile, tell);
}

LivePicture PictureQueue::paint_beside(const LoadedScene& scene, const Rung& rung, const Run& run) {
  return paint_as(newest_, scene, rung, run, nullptr, {}, {});
}

LivePicture PictureQueue::paint_as(std::uint64_t own, const LoadedScene& scene, const Rung& rung,
                                   const Run& run, std::vector<std::string>* notes,
                                   const LiveView::UseTile& use_tile, const TellStage& tell) {
  const std::lock_guard lock(engine_);
  WhileWanted progress(*this, own, notes, tell);
  progress.check();
  // The world of the scene goes with the last rung, also where that is superseded.
  struct ReturnMemory {
    bool wanted;
    ~ReturnMemory() {
      if (wanted) return_freed_memory();
    }
  } at_end{rung.is_last()};
  // On a thread of its own: the C library would keep the memory of a picture for each thread of the
  // server that made one.
  return std::async(std::launch::async,
                    [&] {
                      return view_.paint(
                          scene, rung,
                          {run.threads, run.memory_bytes, run.tile_px, progress, run.cache},
                          use_tile);
                    })
      .get();
}

PictureQueue::Stage PictureQueue::stage() const {
  const std::lock_guard lock(stage_mutex_);
  return stage_;
}

LiveView::Ground PictureQueue::ground(const LoadedScene& scene, const Run& run) {
  const std::lock_guard lock(engine_);
  return view_.ground(scene, run);
}

}  // namespace belvedere::tools
