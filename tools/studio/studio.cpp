#include "tools/studio/studio.h"

#include <fmt/format.h>

#include "base/error.h"
#include "renderer/pipeline/scene_check.h"
#include "tools/report/report_pictures.h"
#include "tools/studio/job.h"

namespace belvedere::tools {

StudioState::StudioState(const StudioParameters& parameters, const Run& given)
    : session(parameters.scene, parameters.files),
      owner(parameters.scene, "studio"),
      run(given),
      open_place(parameters.open_place),
      open_picking(parameters.open_picking),
      fit_style(parameters.fit_style),
      render(std::make_unique<Job>("render")),
      fetch(std::make_unique<Job>("fetch")),
      painting(std::make_unique<Job>("work on a painting")) {
  if (!session.drawn().empty() && !is_json(session.drawn()))
    throw Error(ErrorKind::input, session.drawn_file(), "is no GeoJSON",
                "the lines drawn in the studio, or no file of that name");
}
StudioState::~StudioState() = default;

StudioState::Moment StudioState::moment(const HttpRequest& request) {
  const std::lock_guard guard(mutex);
  const std::string asked = request.value("revision");
  if (!asked.empty() && asked != fmt::format("{}", session.revision()))
    throw Error(ErrorKind::interrupted, "picture", "superseded", "the present revision");
  return {session.scene(), session.revision()};
}

HttpAnswer StudioState::change_scene(const std::function<void()>& change) {
  const std::lock_guard guard(mutex);
  const std::uint64_t before = session.revision();
  change();
  if (session.revision() != before) {
    quick.cancel();
    exact.cancel();
    small.cancel();
  }
  return json_answer(scene_json(session, derived, notes));
}

HttpAnswer StudioState::in_picking(const HttpRequest& request) {
  Room room;
  {
    const std::lock_guard guard(mutex);
    room = picking;
  }
  if (!room) return not_found("room; open it at a painting");
  HttpRequest inside = request;
  inside.path = request.path.substr(5);
  return room(inside);
}

HttpAnswer StudioState::route(const HttpRequest& request) {
  const std::string& path = request.path;
  const bool post = request.method == "POST";
  if (!path.starts_with("api/")) {
    if (path.starts_with("render/")) return rendered(path.substr(7));
    if (path.starts_with("pick/")) return in_picking(request);
    return page_file({"studio"}, path);
  }
  const std::string name = path.substr(4);
  if (post) {
    if (name == "set")
      return change_scene([&] {
        const SetBody body = read_set_body(request.body);
        session.edit(body.edits, body.step);
      });
    if (name == "draw")
      return change_scene([&] {
        const SetBody body = read_set_body(request.body);
        session.draw(read_geojson_member(request.body, "features"), body.edits, body.step);
      });
    if (name == "revert") return change_scene([&] { session.revert(); });
    if (name == "thumbnail") return thumbnail(request);
    if (name == "text")
      return change_scene([&] { session.replace(read_text_member(request.body, "text")); });
    if (name == "undo") return change_scene([&] { session.undo(); });
    if (name == "redo") return change_scene([&] { session.redo(); });
    if (name == "reload")
      return change_scene([&] {
        session.reload();
        owner.renew();
      });
    if (name == "save")
      return change_scene([&] {
        session.save(read_text_member(request.body, "over") == "yes");
        owner.renew();
      });
    if (name == "render") return start_render(request);
    if (name == "render/cancel") {
      render->cancel();
      return json_answer(render_json());
    }
    if (name == "style" || name == "pick") return start_painting_work(request, name);
    if (name == "painting/cancel") {
      painting->cancel();
      return json_answer(Json::object());
    }
    if (name == "fetch") return start_fetch(request);
    if (name == "fetch/cancel") {
      fetch->cancel();
      return json_answer(fetch_json());
    }
    if (name == "files") return take_file(request);
    if (name == "close") return json_answer(Json::object());
  } else {
    if (name == "scene") return change_scene([] {});
    if (name == "rungs")
      return json_answer(rungs_json(moment(request).scene, rungs_asked(request)));
    if (name == "choices") return json_answer(choices_json());
    if (name == "schema") return {.body = scene_json_schema()};
    if (name == "picture") return picture(request);
    if (name == "tiles") return tiles(request);
    if (name == "pointer") return pointer(request);
    if (name == "place") return place(request);
    if (name == "painting") {
      const Job::Report report = painting->report();
      return json_answer(job_json(report).add("result", Json::text(report.result)));
    }
    if (name == "names") return json_answer(sheet_json(*last_picture(request)));
    if (name == "seen")
      return {.type = "application/octet-stream", .body = seen_bytes(*last_picture(request))};
    if (name == "loupe") return loupe(request);
    if (name == "stage") {
      const PictureQueue::Stage stage = quick.stage();
      return json_answer(Json::object()
                             .add("stage", Json::text(stage.name))
                             .add("done", Json::number(stage.done)));
    }
    if (name == "render") return json_answer(render_json());
    if (name == "fetch") return json_answer(fetch_json());
    if (name.starts_with("proposals/")) return proposal_picture(name.substr(10));
    const Moment now = moment(request);
    const auto revision = Json::number(static_cast<double>(now.revision));
    if (name == "map")
      return json_answer(
          map_json(quick.ground(now.scene, run), now.scene).add("revision", revision));
    if (name == "map.png")
      return picture_answer(png_bytes(map_picture(quick.ground(now.scene, run))), "image/png");
    if (name == "check") {
      const LiveView::Ground ground = quick.ground(now.scene, run);
      return json_answer(
          check_json(evaluate_view(coarse_altitudes_of(*ground.dem), ground.view,
                                   static_cast<double>(now.scene.scene.generalize.valleys.width_m)))
              .add("revision", revision));
    }
    if (name == "proposals") {
      quick.cancel();  // somebody waits for them
      return json_answer(proposals_json(proposals(now.scene)));
    }
  }
  return json_answer(
      error_json(Error(ErrorKind::usage, path, "no such request", "those of docs/studio.md")), 404);
}

Studio::Studio(const StudioParameters& parameters, const Run& run)
    : state_(std::make_unique<StudioState>(parameters, run)) {
  state_->server.emplace(HttpParameters{.port = parameters.port, .token = random_token()},
                         [this](const HttpRequest& request) { return answer(request); });
}

Studio::~Studio() { stop(); }

std::string Studio::address() const { return state_->server->address(); }

void Studio::run() { state_->server->run(); }

void Studio::stop() {
  state_->quick.cancel();
  state_->exact.cancel();
  state_->small.cancel();
  state_->render->cancel();
  state_->fetch->cancel();
  state_->painting->cancel();
  state_->server->stop();
}

// A rendering goes on without its page, which finds it when it is opened again.
bool Studio::is_left(double wait_s) const {
  return state_->visits.is_left(wait_s) && state_->render->report().state != Job::State::running;
}

HttpAnswer Studio::answer(const HttpRequest& request) {
  state_->visits.asked(request);
  try {
    return state_->route(request);
  } catch (const Error& error) {
    return error_answer(error);
  }
}

}  // namespace belvedere::tools
