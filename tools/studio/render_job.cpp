#include "tools/studio/render_job.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "renderer/pipeline/pipeline.h"
#include "tools/web/web_page.h"

namespace belvedere::tools {
namespace {

std::string describe(RenderJob::State state) {
  switch (state) {
    case RenderJob::State::idle:
      return "idle";
    case RenderJob::State::running:
      return "running";
    case RenderJob::State::done:
      return "done";
    case RenderJob::State::failed:
      return "failed";
    case RenderJob::State::cancelled:
      break;
  }
  return "cancelled";
}

}  // namespace

class RenderJob::JobProgress : public Progress {
 public:
  explicit JobProgress(RenderJob& job) : job_(job) {}
  void begin(std::string_view stage, double total) override {
    const std::lock_guard lock(job_.mutex_);
    job_.report_.stage = stage;
    job_.report_.done = 0.0;
    job_.stage_begun_ = std::chrono::steady_clock::now();
    total_ = total;
    check();
  }
  void advance(double amount) override {
    check();
    const std::lock_guard lock(job_.mutex_);
    if (total_ > 0.0) job_.report_.done = std::min(1.0, job_.report_.done + amount / total_);
  }

 private:
  void check() const {
    if (job_.cancelled_)
      throw Error(ErrorKind::interrupted, "render", "cancelled", "render again to go on");
  }
  RenderJob& job_;
  double total_ = 0.0;
};

RenderJob::~RenderJob() {
  cancel();
  if (thread_.joinable()) thread_.join();
}

std::string RenderJob::page_folder(const std::string& folder) {
  return (std::filesystem::path(folder) / "web").string();
}

void RenderJob::start(const LoadedScene& scene, const std::string& folder, const Run& run) {
  {
    const std::lock_guard lock(mutex_);
    if (report_.state == State::running)
      throw Error(ErrorKind::usage, "render", "another one is running", "cancel it first");
    report_ = {.state = State::running, .stage = "reading", .folder = folder, .error = {}};
    begun_ = stage_begun_ = std::chrono::steady_clock::now();
    cancelled_ = false;
  }
  if (thread_.joinable()) thread_.join();
  thread_ = std::thread([this, scene, folder, threads = run.threads, memory = run.memory_bytes,
                         tile_px = run.tile_px, &cache = run.cache] {
    work(scene, folder, {threads, memory, tile_px, silent_progress(), cache});
  });
}

// The end of a thread, which may not throw: errors become the report.
void RenderJob::work(const LoadedScene& scene, const std::string& folder, const Run& run) {
  JobProgress progress(*this);
  State end = State::done;
  std::string error;
  try {
    belvedere::render(scene, folder,
                      {run.threads, run.memory_bytes, run.tile_px, progress, run.cache});
    write_web_page({{folder, scene.name}}, page_folder(folder), {}, progress);
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
  report_.done = end == State::done ? 1.0 : report_.done;
  report_.elapsed_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

RenderJob::Report RenderJob::report() const {
  const std::lock_guard lock(mutex_);
  Report out = report_;
  if (out.state != State::running) return out;
  const auto now = std::chrono::steady_clock::now();
  out.elapsed_s = std::chrono::duration<double>(now - begun_).count();
  const double in_stage_s = std::chrono::duration<double>(now - stage_begun_).count();
  // A shorter time says little.
  constexpr double min_done = 0.02;
  constexpr double min_s = 2.0;
  if (out.done > min_done && in_stage_s > min_s)
    out.left_s = in_stage_s * (1.0 - out.done) / out.done;
  return out;
}

Json job_json(const RenderJob::Report& report) {
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
  if (report.state == RenderJob::State::done) out.add("page", Json::text("render/index.html"));
  return out;
}

}  // namespace belvedere::tools
