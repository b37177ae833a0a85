#include "tools/studio/picture_queue.h"

#include "base/error.h"

namespace belvedere::tools {
namespace {

// Ends a picture that is no longer wanted.
class WhileWanted : public Progress {
 public:
  WhileWanted(const std::atomic<std::uint64_t>& newest, std::uint64_t own,
              std::vector<std::string>* notes, const PictureQueue::TellStage& tell)
      : newest_(newest), own_(own), notes_(notes), tell_(tell) {}
  void begin(std::string_view stage, double) override {
    check();
    if (tell_) tell_(stage);
  }
  void advance(double) override { check(); }
  void note(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    if (notes_ != nullptr) notes_->emplace_back(text);
  }
  void check() const {
    if (newest_ != own_)
      throw Error(ErrorKind::interrupted, "picture", "superseded", "a request for the newest one");
  }

 private:
  const std::atomic<std::uint64_t>& newest_;
  std::uint64_t own_;
  std::mutex mutex_;
  std::vector<std::string>* notes_;
  const PictureQueue::TellStage& tell_;
};

}  // namespace

LivePicture PictureQueue::paint(const LoadedScene& scene, const Rung& rung, const Run& run,
                                std::vector<std::string>* notes, const LiveView::UseTile& use_tile,
                                const TellStage& tell) {
  const std::uint64_t own = ++newest_;
  WhileWanted progress(newest_, own, notes, tell);
  const std::lock_guard lock(engine_);
  progress.check();
  return view_.paint(scene, rung, {run.threads, run.memory_bytes, run.tile_px, progress, run.cache},
                     use_tile);
}

LiveView::Ground PictureQueue::ground(const LoadedScene& scene, const Run& run) {
  const std::lock_guard lock(engine_);
  return view_.ground(scene, run);
}

}  // namespace belvedere::tools
