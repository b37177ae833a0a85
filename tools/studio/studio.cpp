#include "tools/studio/studio.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/text/embedded.h"
#include "base/text/letters.h"
#include "renderer/image/output_file.h"
#include "renderer/pipeline/view_judgement.h"
#include "tools/studio/answers.h"
#include "tools/studio/encoded_picture.h"
#include "tools/studio/picture_queue.h"
#include "tools/studio/render_job.h"
#include "tools/studio/request_body.h"
#include "tools/studio/scene_session.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// Held while a studio has a scene open; the system drops it whatever ends the program.
class SceneLockFile {
 public:
  explicit SceneLockFile(const std::string& scene)
      : scene_(scene), descriptor_(open(scene.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0)
      throw Error(ErrorKind::input, scene, "cannot be read", "a scene file that you may read");
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      close(descriptor_);
      throw Error(ErrorKind::usage, scene, "is open in another studio",
                  "close that one, or compose a copy of the scene");
    }
  }
  ~SceneLockFile() { close(descriptor_); }
  // Saving puts another file in the place of the one that is locked.
  void renew() {
    struct stat locked {};
    struct stat there {};
    if (fstat(descriptor_, &locked) == 0 && stat(scene_.c_str(), &there) == 0 &&
        locked.st_dev == there.st_dev && locked.st_ino == there.st_ino)
      return;
    SceneLockFile next(scene_);
    std::swap(descriptor_, next.descriptor_);
  }
  SceneLockFile(const SceneLockFile&) = delete;
  SceneLockFile& operator=(const SceneLockFile&) = delete;

 private:
  std::string scene_;
  int descriptor_;
};

HttpAnswer json_answer(const Json& json, int status = 200) {
  return {.status = status, .body = json.str() + "\n"};
}

HttpAnswer picture_answer(std::string bytes, const std::string& type) {
  return {.type = type, .body = std::move(bytes)};
}

std::string type_of(const std::string& path) {
  static constexpr std::pair<const char*, const char*> types[] = {
      {".html", "text/html; charset=utf-8"},
      {".css", "text/css"},
      {".js", "text/javascript"},
      {".svg", "image/svg+xml"},
      {".jpg", "image/jpeg"},
      {".png", "image/png"}};
  for (const auto& [extension, type] : types)
    if (path.ends_with(extension)) return type;
  return "application/octet-stream";
}

// What a page may load and run. The studio runs only its own files; a rendered picture's page has
// its scripts in itself, and asks nothing of the program.
constexpr const char* studio_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; connect-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
constexpr const char* rendered_policy =
    "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// 4 bytes, high byte first.
std::string length_prefix(std::size_t length) {
  std::string out;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>((length >> shift) & 255U);
  return out;
}

// What a file is good for, by its name.
std::string kind_of(const std::string& name) {
  const std::string extension = lower_extension(name);
  static constexpr std::pair<const char*, const char*> kinds[] = {
      {".gpx", "track"},    {".geojson", "features"}, {".gpkg", "features"}, {".shp", "features"},
      {".kml", "features"}, {".tif", "terrain"},      {".tiff", "terrain"},  {".asc", "terrain"},
      {".hgt", "terrain"},  {".jpg", "painting"},     {".jpeg", "painting"}, {".png", "painting"},
      {".toml", "scene"}};
  for (const auto& [known, kind] : kinds)
    if (extension == known) return kind;
  return "other";
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

struct Studio::State {
  State(const StudioParameters& parameters, const Run& given)
      : session(parameters.scene, parameters.files), lock(parameters.scene), run(given) {}

  // What of the scene a request needs, at one moment.
  struct Moment {
    LoadedScene scene;
    std::uint64_t revision = 0;
  };
  Moment moment(const HttpRequest& request) {
    const std::lock_guard guard(mutex);
    const std::string asked = request.value("revision");
    if (!asked.empty() && asked != fmt::format("{}", session.revision()))
      throw Error(ErrorKind::interrupted, "picture", "superseded", "the present revision");
    return {session.scene(), session.revision()};
  }

  HttpAnswer scene_answer() { return json_answer(scene_json(session, derived, notes)); }
  template <class Change>
  HttpAnswer change_scene(const Change& change) {
    const std::lock_guard guard(mutex);
    const std::uint64_t before = session.revision();
    change();
    if (session.revision() != before) {
      quick.cancel();
      exact.cancel();
    }
    return scene_answer();
  }

  HttpAnswer file(const std::string& name);
  HttpAnswer rendered(const std::string& name);
  HttpAnswer picture(const HttpRequest& request);
  HttpAnswer tiles(const HttpRequest& request);
  HttpAnswer pointer(const HttpRequest& request);
  HttpAnswer start_render(const HttpRequest& request);
  HttpAnswer take_file(const HttpRequest& request);
  std::vector<Proposal> proposals(const LoadedScene& scene);
  HttpAnswer proposal_picture(const std::string& name);
  HttpAnswer route(const HttpRequest& request);

  std::mutex mutex;  // of the members below, up to `run`
  SceneSession session;
  std::vector<DerivedValue> derived;
  std::vector<std::string> notes;
  std::shared_ptr<const LivePicture> last;  // under the pointer
  SceneLockFile lock;
  const Run& run;
  std::mutex proposals_mutex;
  std::weak_ptr<const Dem> proposals_of;
  std::vector<Proposal> proposed;
  PictureQueue quick;  // all rungs but the last
  PictureQueue exact;  // the last
  RenderJob job;
  std::atomic<std::int64_t> closed_ms = 0;  // when the page said so; 0: it is open
  std::optional<HttpServer> server;
};

// A page's own files.
HttpAnswer Studio::State::file(const std::string& name) {
  const std::string path = name.empty() ? "index.html" : name;
  for (const std::string_view extension : {".html", ".css", ".js", ".svg"})
    if (path.ends_with(extension)) {
      const std::string stem = path.substr(0, path.size() - extension.size());
      const std::vector<std::string> all = embedded_names("studio");
      if (std::find(all.begin(), all.end(), stem) == all.end()) break;
      return {.type = type_of(path),
              .body = std::string(embedded_file("studio/" + path)),
              .headers = {{"Content-Security-Policy", studio_policy}}};
    }
  return {.status = 404, .type = "text/plain", .body = "no such page\n"};
}

// The page of the last rendered picture; nothing outside its folder.
HttpAnswer Studio::State::rendered(const std::string& name) {
  const RenderJob::Report report = job.report();
  const HttpAnswer none{.status = 404, .type = "text/plain", .body = "no such file\n"};
  if (report.state != RenderJob::State::done) return none;
  const fs::path folder = fs::weakly_canonical(RenderJob::page_folder(report.folder));
  const fs::path path = fs::weakly_canonical(folder / name);
  if (!path.string().starts_with(folder.string() + "/") || !fs::is_regular_file(path)) return none;
  return {.type = type_of(path.string()),
          .body = read_bytes(path),
          .headers = {{"Content-Security-Policy", rendered_policy}}};
}

HttpAnswer Studio::State::picture(const HttpRequest& request) {
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
  {
    const std::lock_guard guard(mutex);
    last = made;
    derived = made->view.derived;
    notes = told;
  }
  HttpAnswer out = rung.is_last() ? picture_answer(png_bytes(made->colour), "image/png")
                                  : picture_answer(jpeg_bytes(made->colour), "image/jpeg");
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
  out.headers["X-Belvedere-Revision"] = fmt::format("{}", now.revision);
  out.headers["X-Belvedere-Without"] = fmt::format("{}", fmt::join(rung.without, ", "));
  out.headers["X-Belvedere-Milliseconds"] = fmt::format("{:.0f}", took.count());
  return out;
}

// Records of the last rung: length of a JSON header, header, bytes of a PNG.
HttpAnswer Studio::State::tiles(const HttpRequest& request) {
  // Both would paint the same at half the speed.
  if (job.report().state == RenderJob::State::running)
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
      const SceneOutput size = scene_of_rung(scene, rung, {}).scene.output;
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
      const std::lock_guard guard(mutex);
      last = made;
      notes = told;
      record(Json::object().add("bytes", Json::number(0)).add("done", Json::number(1)));
    } catch (const Error& error) {
      record(error_json(error).add("bytes", Json::number(0)));
    }
  };
  return out;
}

HttpAnswer Studio::State::pointer(const HttpRequest& request) {
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

HttpAnswer Studio::State::start_render(const HttpRequest& request) {
  LoadedScene scene = moment(request).scene;
  SceneOutput& output = scene.scene.output;
  const int width = read_number_member(request.body, "width", output.width);
  if (width < 16 || width > 65535)
    throw Error(ErrorKind::usage, "width", fmt::format("{}", width), "16 … 65535 px");
  output.height = std::max(
      16, static_cast<int>(std::lround(static_cast<double>(output.height) * width / output.width)));
  output.width = width;
  const fs::path folder = fs::path(scene.folder) / (scene.name + "_rendered");
  // The live pictures make room.
  quick.cancel();
  exact.cancel();
  job.start(scene, folder.string(), run);
  return json_answer(job_json(job.report()), 202);
}

HttpAnswer Studio::State::take_file(const HttpRequest& request) {
  const std::string name = request.value("name");
  if (name.empty() || name.size() > 200 || name.front() == '.' ||
      name.find_first_of(std::string("/\\\0", 3)) != std::string::npos)
    throw Error(ErrorKind::usage, "name", fmt::format("\"{}\"", name),
                "the name of a file, without folders");
  fs::path path;
  {
    const std::lock_guard guard(mutex);
    path = fs::path(session.scene().folder) / name;
  }
  if (fs::exists(fs::symlink_status(path)))  // a link to nowhere is a file too
    throw Error(ErrorKind::output, name, "a file of that name is there already",
                "another name; no file is replaced");
  write_text_file(path.string(), request.body);
  return json_answer(
      Json::object().add("file", Json::text(name)).add("kind", Json::text(kind_of(name))));
}

// They are found once for a ground.
std::vector<Proposal> Studio::State::proposals(const LoadedScene& scene) {
  const LiveView::Ground ground = quick.ground(scene, run);
  const std::lock_guard guard(proposals_mutex);
  if (proposals_of.lock() != ground.dem) {
    proposed = find_proposals(ground);
    proposals_of = ground.dem;
  }
  return proposed;
}

// Each proposal as the scene would look with its changes: 0.jpg, 1.jpg …
HttpAnswer Studio::State::proposal_picture(const std::string& name) {
  const std::size_t number =
      static_cast<std::size_t>(whole_number(name.substr(0, name.find('.')), "proposal"));
  const Moment now = moment({});
  const std::vector<Proposal> all = proposals(now.scene);
  if (number >= all.size())
    return {.status = 404, .type = "text/plain", .body = "no such proposal\n"};
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

HttpAnswer Studio::State::route(const HttpRequest& request) {
  const std::string& path = request.path;
  const bool post = request.method == "POST";
  if (!path.starts_with("api/")) {
    if (path.starts_with("render/")) return rendered(path.substr(7));
    return file(path);
  }
  const std::string name = path.substr(4);
  if (post) {
    if (name == "set")
      return change_scene([&] {
        const SetBody body = read_set_body(request.body);
        session.edit(body.edits, body.step);
      });
    if (name == "text")
      return change_scene([&] { session.replace(read_text_member(request.body, "text")); });
    if (name == "undo") return change_scene([&] { session.undo(); });
    if (name == "redo") return change_scene([&] { session.redo(); });
    if (name == "reload")
      return change_scene([&] {
        session.reload();
        lock.renew();
      });
    if (name == "save")
      return change_scene([&] {
        session.save(read_text_member(request.body, "over") == "yes");
        lock.renew();
      });
    if (name == "render") return start_render(request);
    if (name == "render/cancel") {
      job.cancel();
      return json_answer(job_json(job.report()));
    }
    if (name == "files") return take_file(request);
    if (name == "close") return json_answer(Json::object());
  } else {
    if (name == "scene") return change_scene([] {});
    if (name == "rungs") return json_answer(rungs_json(moment(request).scene));
    if (name == "choices") return json_answer(choices_json());
    if (name == "schema") return {.body = scene_json_schema()};
    if (name == "picture") return picture(request);
    if (name == "tiles") return tiles(request);
    if (name == "pointer") return pointer(request);
    if (name == "stage") {
      const PictureQueue::Stage stage = quick.stage();
      return json_answer(Json::object()
                             .add("stage", Json::text(stage.name))
                             .add("done", Json::number(stage.done)));
    }
    if (name == "render") return json_answer(job_json(job.report()));
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
      return json_answer(check_json(evaluate_view(coarse_altitudes_of(*ground.dem), ground.view))
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
    : state_(std::make_unique<State>(parameters, run)) {
  state_->server.emplace(HttpParameters{.port = parameters.port, .token = random_token()},
                         [this](const HttpRequest& request) { return answer(request); });
}

Studio::~Studio() { stop(); }

std::string Studio::address() const { return state_->server->address(); }

void Studio::run() { state_->server->run(); }

void Studio::stop() {
  state_->quick.cancel();
  state_->exact.cancel();
  state_->job.cancel();
  state_->server->stop();
}

namespace {

std::int64_t now_ms() {
  return std::chrono::duration_cast<std::chrono::milliseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

// A page that is loaded again closes first.
bool Studio::is_left(double wait_s) const {
  const std::int64_t closed_ms = state_->closed_ms;
  return closed_ms != 0 && static_cast<double>(now_ms() - closed_ms) >= 1e3 * wait_s;
}

HttpAnswer Studio::answer(const HttpRequest& request) {
  state_->closed_ms = request.path == "api/close" ? now_ms() : 0;
  try {
    return state_->route(request);
  } catch (const Error& error) {
    const int status = error.kind() == ErrorKind::interrupted ? 409
                       : error.kind() == ErrorKind::bug       ? 500
                                                              : 422;
    return json_answer(error_json(error), status);
  }
}

}  // namespace belvedere::tools
