#include "tools/studio/job.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <utility>

#include "base/error.h"
#include "base/memory/zeroed_memory.h"

namespace belvedere::tools {
namespace {

std::string describe(Job::State state) {
  switch (state) {
    case Job::State::idle:
      return "idle";
    case Job::State::running:
      return "running";
    case Job::State::done:
      return "done";
    case Job::State::failed:
      return "failed";
    case Job::State::cancelled:
      break;
  }
  return "cancelled";
}

}  // namespace

class Job::JobProgress : public Progress {
 public:
  explicit JobProgress(Job& job) : job_(job) {}
  void begin(std::string_view stage, double total) override {
    const std::lock_guard lock(job_.mutex_);
    job_.report_.stage = stage;
    job_.stage_done_ = 0.0;
    job_.stage_begun_ = std::chrono::steady_clock::now();
    total_ = total;
    check();
  }
  void advance(double amount) override {
    check();
    const std::lock_guard lock(job_.mutex_);
    if (total_ > 0.0) job_.stage_done_ = std::min(1.0, job_.stage_done_ + amount / total_);
  }

 private:
  void check() const {
    if (job_.cancelled_)
      throw Error(ErrorKind::interrupted, job_.name_, "cancelled", "start it again to go on");
  }
  Job& job_;
  double total_ = 0.0;
};

Job::~Job() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

void Job::start(const std::string& folder, const Run& run, Work work, double expected_s) {
  // A job may end before its thread is kept below.
  const std::lock_guard starting(start_mutex_);
  {
    const std::lock_guard lock(mutex_);
    if (report_.state == State::running)
      throw Error(ErrorKind::usage, name_, "another one is running", "cancel it first");
    report_ = {
        .state = State::running, .stage = "reading", .folder = folder, .error = {}, .result = {}};
    begun_ = stage_begun_ = std::chrono::steady_clock::now();
    stage_done_ = 0.0;
    expected_s_ = expected_s;
    cancelled_ = false;
  }
  if (thread_.joinable()) thread_.join();
  thread_ = std::thread([this, work = std::move(work), threads = run.threads,
                         memory = run.memory_bytes, tile_px = run.tile_px, &cache = run.cache] {
    JobProgress progress(*this);
    do_work({threads, memory, tile_px, progress, cache}, work);
  });
}

// The end of a thread, which may not throw: errors become the report.
void Job::do_work(const Run& run, const Work& work) {
  State end = State::done;
  std::string error;
  std::string result;
  try {
    result = work(run);
  } catch (const Error& caught) {
    end = caught.kind() == ErrorKind::interrupted ? State::cancelled : State::failed;
    error = caught.what();
  } catch (const std::exception& caught) {
    end = State::failed;
    error = caught.what();
  }
  const std::lock_guard lock(mutex_);
  report_.state = end;
  report_.error = error;
  report_.result = result;
  report_.done = end == State::done ? 1.0 : report_.done;
  report_.elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

Job::Report Job::report() const {
  const std::lock_guard lock(mutex_);
  if (report_.state != State::running) return report_;
  const auto now = std::chrono::steady_clock::now();
  report_.elapsed_s = std::chrono::duration<double>(now - begun_).count();
  const double in_stage_s = std::chrono::duration<double>(now - stage_begun_).count();
  // A shorter time says little.
  constexpr double min_done = 0.02;
  constexpr double min_s = 2.0;
  const bool known = stage_done_ > min_done && in_stage_s > min_s;
  const double stage_left_s = known ? in_stage_s * (1.0 - stage_done_) / stage_done_ : 0.0;
  report_.left_s = -1.0;
  if (!known && expected_s_ <= 0.0) return report_;
  report_.left_s = std::max(expected_s_ - report_.elapsed_s, stage_left_s);
  report_.done =
      std::max(report_.done, report_.elapsed_s / (report_.elapsed_s + report_.left_s + 1.0));
  return report_;
}

Json job_json(const Job::Report& report) {
  Json out = Json::object()
                 .add("state", Json::text(describe(report.state)))
                 .add("stage", Json::text(report.stage))
                 .add("done", Json::number(report.done))
                 .add("elapsed_s", Json::number(std::round(report.elapsed_s)))
                 .add("folder", Json::text(report.folder))
                 .add("error", report.error.empty()
                                   ? Json::raw("null")
                                   : Json::object().add("message", Json::text(report.error)));
  if (report.left_s >= 0.0) out.add("left_s", Json::number(std::round(report.left_s)));
  return out;
}

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
