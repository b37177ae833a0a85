#include <fmt/format.h>

#include <chrono>

#include "tools/report/encoded_picture.h"
#include "tools/studio/job.h"
#include "tools/studio/studio_state.h"

namespace belvedere::tools {
namespace {

// 4 bytes, high byte first.
std::string length_prefix(std::size_t length) {
  std::string out;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>((length >> shift) & 255U);
  return out;
}

int whole_number(const std::string& text, const std::string& name) {
  try {
    std::size_t used = 0;
    const int value = std::stoi(text, &used);
    if (used == text.size()) return value;
  } catch (const std::exception&) {
  }
  throw Error(ErrorKind::usage, name, fmt::format("\"{}\"", text), "a whole number");
}

double share_of(const std::string& text, const std::string& name) {
  try {
    const double value = std::stod(text);
    if (value >= 0.0 && value <= 1.0) return value;
  } catch (const std::exception&) {
  }
  throw Error(ErrorKind::usage, name, fmt::format("\"{}\"", text), "0 … 1");
}

}  // namespace

void StudioState::remember(std::shared_ptr<const LivePicture> made, std::vector<std::string> told) {
  const std::lock_guard guard(mutex);
  last = std::move(made);
  derived = last->view.derived;
  notes = std::move(told);
}

HttpAnswer StudioState::picture(const HttpRequest& request) {
  const int number = whole_number(request.value("rung"), "rung");
  if (number < 0 || number >= static_cast<int>(rungs().size()))
    throw Error(ErrorKind::usage, "rung", request.value("rung"), "a number of api/rungs");
  const Rung& rung = rungs()[static_cast<std::size_t>(number)];
  const Moment now = moment(request);
  std::vector<std::string> told;
  const auto begun = std::chrono::steady_clock::now();
  exact.cancel();
  const auto made = std::make_shared<const LivePicture>(
      (rung.is_last() ? exact : quick).paint(now.scene, rung, run, &told));
  remember(made, std::move(told));
  HttpAnswer out = rung.is_last() ? picture_answer(png_bytes(made->colour), "image/png")
                                  : picture_answer(jpeg_bytes(made->colour), "image/jpeg");
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
  out.headers["X-Belvedere-Revision"] = fmt::format("{}", now.revision);
  std::vector<std::string> without = rung.without;
  if (made->halved > 0)
    without.insert(without.begin(), fmt::format("landforms below {:.0f} m", made->shortest_m));
  out.headers["X-Belvedere-Without"] = fmt::format("{}", fmt::join(without, ", "));
  out.headers["X-Belvedere-Halved"] = fmt::format("{}", made->halved);
  out.headers["X-Belvedere-Milliseconds"] = fmt::format("{:.0f}", took.count());
  return out;
}

// Records of the last rung: length of a JSON header, header, bytes of a PNG.
HttpAnswer StudioState::tiles(const HttpRequest& request) {
  // Both would paint the same at half the speed.
  if (render->report().state == Job::State::running)
    throw Error(ErrorKind::interrupted, "picture", "superseded by the rendering",
                "the last rung once it is done");
  const Moment now = moment(request);
  HttpAnswer out{.type = "application/octet-stream"};
  out.stream = [this, scene = now.scene](const SendPart& send) {
    bool gone = false;
    const auto record = [&](const Json& header, const std::string& bytes = "") {
      const std::string text = header.str();
      gone = gone || !send(length_prefix(text.size()) + text + bytes);
      if (gone) exact.cancel();
    };
    try {
      const Rung& rung = rungs().back();
      const SceneOutput size = scene_of_rung(scene, rung).scene.output;
      double made_px = 0.0;
      std::vector<std::string> told;
      const auto use = [&](PixelRect rect, const Grid<glm::vec3>& colour) {
        made_px += static_cast<double>(colour.size());
        const std::string bytes = png_bytes(colour);
        record(Json::object()
                   .add("x", Json::number(rect.x0))
                   .add("y", Json::number(rect.y0))
                   .add("width", Json::number(rect.width()))
                   .add("height", Json::number(rect.height()))
                   .add("bytes", Json::number(static_cast<double>(bytes.size())))
                   .add("done", Json::number(made_px / size.width / size.height)),
               bytes);
      };
      const auto tell = [&](std::string_view stage) {
        record(Json::object()
                   .add("stage", Json::text(stage))
                   .add("bytes", Json::number(0))
                   .add("done", Json::number(0.99 * made_px / size.width / size.height)));
      };
      const auto made =
          std::make_shared<const LivePicture>(exact.paint(scene, rung, run, &told, use, tell));
      remember(made, std::move(told));
      record(Json::object().add("bytes", Json::number(0)).add("done", Json::number(1)));
    } catch (const Error& error) {
      record(error_json(error).add("bytes", Json::number(0)));
    }
  };
  return out;
}

HttpAnswer StudioState::pointer(const HttpRequest& request) {
  moment(request);
  std::shared_ptr<const LivePicture> seen;
  {
    const std::lock_guard guard(mutex);
    seen = last;
  }
  if (seen == nullptr) throw Error(ErrorKind::usage, "pointer", "there is no picture yet");
  return json_answer(
      pointer_json(*seen, {share_of(request.value("x"), "x"), share_of(request.value("y"), "y")}));
}

// They are found once for a ground.
std::vector<Proposal> StudioState::proposals(const LoadedScene& scene) {
  const LiveView::Ground ground = quick.ground(scene, run);
  const std::lock_guard guard(proposals_mutex);
  if (proposals_of.lock() != ground.dem) {
    proposed = find_proposals(ground);
    proposals_of = ground.dem;
  }
  return proposed;
}

// Each proposal as the scene would look with its changes: 0.jpg, 1.jpg …
HttpAnswer StudioState::proposal_picture(const std::string& name) {
  const std::size_t number =
      static_cast<std::size_t>(whole_number(name.substr(0, name.find('.')), "proposal"));
  const Moment now = moment({});
  const std::vector<Proposal> all = proposals(now.scene);
  if (number >= all.size()) return not_found("proposal");
  LoadedScene scene = now.scene;
  {
    const std::lock_guard guard(mutex);
    scene = session.edited(all[number].edits);
  }
  constexpr int thumbnail_px = 240;
  Rung rung = rungs().front();
  rung.max_width_px = thumbnail_px;
  return picture_answer(jpeg_bytes(quick.paint_beside(scene, rung, run).colour), "image/jpeg");
}

}  // namespace belvedere::tools
