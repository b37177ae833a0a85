#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/text/parse_number.h"
#include "base/text/text_encoding.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/scene_settings.h"
#include "renderer/world/scene_style.h"
#include "terrain/fetch/fetch_area.h"
#include "tools/report/report_pictures.h"
#include "tools/studio/http_server.h"
#include "tools/studio/job.h"
#include "tools/studio/studio_state.h"
#include "tools/web/web_page.h"

namespace belvedere::tools {
namespace {

// 4 bytes, high byte first.
std::string length_prefix(std::size_t length) {
  std::string out;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>((length >> shift) & 255U);
  return out;
}

int whole_number(const std::string& text, const std::string& name) {
  if (const std::optional<int> value = parse_number<int>(text)) return *value;
  throw Error(ErrorKind::usage, name, fmt::format("\"{}\"", text), "a whole number");
}

double share_of(const std::string& text, const std::string& name) {
  const std::optional<double> value = parse_number<double>(text);
  if (value && *value >= 0.0 && *value <= 1.0) return *value;
  throw Error(ErrorKind::usage, name, fmt::format("\"{}\"", text), "0 … 1");
}

// What the scene leaves open, as this picture has it.
std::vector<DerivedValue> values_in_effect(const LivePicture& picture, const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  const View& view = picture.view;
  std::vector<DerivedValue> out = view.derived;
  const auto add = [&](const char* key, double value, const char* why) {
    out.push_back({key, fmt::format("{}", std::round(100.0 * value) / 100.0), why});
  };
  if (!scene.sun.time.empty()) {
    add("sun.azimuth_deg", view.sun.azimuth_deg, "at the scene's date and time");
    add("sun.altitude_deg", view.sun.altitude_deg, "at the scene's date and time");
  }
  if (view.target_altitude_m && !scene.camera.look_at_altitude_m)
    add("camera.look_at_altitude_m", *view.target_altitude_m, "of the ground there");
  if (!scene.style.scale)
    if (const std::optional<Style> style = named_style(loaded))
      add("style.scale", style->units_per_px, "by the painting's size");
  return out;
}

}  // namespace

void StudioState::remember(std::shared_ptr<const LivePicture> made, const Moment& of,
                           std::vector<std::string> told) {
  std::vector<DerivedValue> found = values_in_effect(*made, of.scene);
  const std::lock_guard guard(mutex);
  last = std::move(made);
  last_revision = of.revision;
  derived = std::move(found);
  notes = std::move(told);
}

std::vector<Rung> StudioState::rungs_asked(const HttpRequest& request) {
  constexpr int min_px = 64;
  constexpr int max_px = 2400;
  std::vector<Rung> out = rungs();
  if (const std::string width = request.value("width"); !width.empty())
    out.back().max_width_px = std::clamp(whole_number(width, "width"), min_px, max_px);
  return out;
}

HttpAnswer StudioState::picture(const HttpRequest& request) {
  const int number = whole_number(request.value("rung"), "rung");
  const std::vector<Rung> ladder = rungs_asked(request);
  if (number < 0 || number >= static_cast<int>(ladder.size()))
    throw Error(ErrorKind::usage, "rung", request.value("rung"), "a number of api/rungs");
  const Rung& rung = ladder[static_cast<std::size_t>(number)];
  const Moment now = moment(request);
  std::vector<std::string> told;
  const auto begun = std::chrono::steady_clock::now();
  exact.cancel();
  const auto made = std::make_shared<const LivePicture>(
      (rung.is_last() ? exact : quick).paint(now.scene, rung, run, &told));
  remember(made, now, std::move(told));
  HttpAnswer out = rung.is_last() ? picture_answer(png_bytes(made->colour), "image/png")
                                  : picture_answer(jpeg_bytes(made->colour), "image/jpeg");
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
  out.headers["X-Belvedere-Revision"] = fmt::format("{}", now.revision);
  std::vector<std::string> without = lacks_of(now.scene, rung);
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
  out.stream = [this, now, rung = rungs_asked(request).back()](const SendPart& send) {
    const auto begun = std::chrono::steady_clock::now();
    bool gone = false;
    const auto record = [&](const Json& header, const std::string& bytes = "") {
      const std::string text = header.str();
      gone = gone || !send(length_prefix(text.size()) + text + bytes);
      if (gone) exact.cancel();
    };
    try {
      const SceneOutput size = scene_of_rung(now.scene, rung).scene.output;
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
          std::make_shared<const LivePicture>(exact.paint(now.scene, rung, run, &told, use, tell));
      remember(made, now, std::move(told));
      {
        const std::lock_guard guard(mutex);
        last_rung_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        last_rung_px = made_px;
      }
      record(Json::object().add("bytes", Json::number(0)).add("done", Json::number(1)));
    } catch (const Error& error) {
      record(error_json(error).add("bytes", Json::number(0)));
    }
  };
  return out;
}

std::shared_ptr<const LivePicture> StudioState::last_picture(const HttpRequest& request) {
  const Moment now = moment(request);
  const std::lock_guard guard(mutex);
  if (last == nullptr || last_revision != now.revision)
    throw Error(ErrorKind::interrupted, "picture", "is not drawn yet", "the last one, once it is");
  return last;
}

// Waits for the last rung, and is ended by the next one.
HttpAnswer StudioState::loupe(const HttpRequest& request) {
  const Moment now = moment(request);
  const SceneOutput& print = now.scene.scene.output;
  const auto side = [&](const char* name, int size) {
    constexpr int max_px = 800;
    const int wanted = whole_number(request.value(name), name);
    if (wanted < 16 || wanted > max_px)
      throw Error(ErrorKind::usage, name, fmt::format("{}", wanted),
                  fmt::format("16 … {} px", max_px));
    return std::min(wanted, size);
  };
  const glm::ivec2 size(side("width", print.width), side("height", print.height));
  const auto from = [&](const char* name, int all, int part) {
    return std::clamp(static_cast<int>(share_of(request.value(name), name) * all) - part / 2, 0,
                      all - part);
  };
  const glm::ivec2 low(from("x", print.width, size.x), from("y", print.height, size.y));
  const Rung whole{.name = "print",
                   .without = {},
                   .max_width_px = print.width,
                   .names = false,
                   .part = PixelRect{low.x, low.y, low.x + size.x, low.y + size.y}};
  const LivePicture made = exact.paint_beside(now.scene, whole, run);
  HttpAnswer out = picture_answer(png_bytes(made.colour), "image/png");
  out.headers["X-Belvedere-Left"] = fmt::format("{}", low.x);
  out.headers["X-Belvedere-Top"] = fmt::format("{}", low.y);
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

// Of the ground at a place of the map.
HttpAnswer StudioState::place(const HttpRequest& request) {
  const auto number = [&](const char* name) {
    const std::optional<double> value = parse_number<double>(request.value(name));
    if (!value || !std::isfinite(*value))
      throw Error(ErrorKind::usage, name, fmt::format("\"{}\"", request.value(name)), "metres");
    return *value;
  };
  const glm::dvec2 at(number("east"), number("north"));
  return json_answer(place_json(*quick.ground(moment({}).scene, run).dem, at));
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
  constexpr int thumbnail_px = 240;
  return small_picture(all[number].edits, thumbnail_px);
}

HttpAnswer StudioState::small_picture(std::span<const SceneEdit> edits, int width_px) {
  std::optional<LoadedScene> scene;
  {
    const std::lock_guard guard(mutex);
    scene = session.edited(edits);
  }
  Rung rung = rungs().front();
  rung.max_width_px = width_px;
  return picture_answer(jpeg_bytes(small.paint_beside(*scene, rung, run).colour), "image/jpeg");
}

HttpAnswer StudioState::thumbnail(const HttpRequest& request) {
  constexpr int usual_px = 240;
  const int width = read_number_member(request.body, "width", usual_px);
  if (width < 64 || width > 1000)
    throw Error(ErrorKind::usage, "width", fmt::format("{}", width), "64 … 1000 px");
  return small_picture(read_set_body(request.body).edits, width);
}

namespace {

namespace fs = std::filesystem;

// Content security policy of the page of a rendered picture: its scripts are in the page, and it
// requests nothing from the program.
constexpr const char* rendered_policy =
    "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// The folder of the page of a rendered picture.
std::string page_folder(const std::string& folder) { return (fs::path(folder) / "web").string(); }

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The use of a file, by its name.
std::string kind_of(const std::string& name) {
  const std::string extension = lower_extension(name);
  static constexpr std::pair<const char*, const char*> kinds[] = {
      {".gpx", "track"},    {".geojson", "features"}, {".gpkg", "features"}, {".shp", "features"},
      {".kml", "features"}, {".tif", "terrain"},      {".tiff", "terrain"},  {".asc", "terrain"},
      {".hgt", "terrain"},  {".jpg", "painting"},     {".jpeg", "painting"}, {".png", "painting"},
      {".toml", "scene"},   {".csv", "names"}};
  for (const auto& [known, kind] : kinds)
    if (extension == known) return kind;
  return "other";
}

}  // namespace

// The page of the last rendered picture; nothing outside its folder.
HttpAnswer StudioState::rendered(const std::string& name) {
  const Job::Report report = render->report();
  if (report.state != Job::State::done) return not_found("file");
  const fs::path folder = fs::weakly_canonical(page_folder(report.folder));
  const fs::path path = fs::weakly_canonical(folder / name);
  if (!path.string().starts_with(folder.string() + "/") || !fs::is_regular_file(path))
    return not_found("file");
  return {.type = media_type(path.string()),
          .body = read_bytes(path),
          .headers = {{"Content-Security-Policy", rendered_policy}}};
}

HttpAnswer StudioState::start_render(const HttpRequest& request) {
  LoadedScene scene = moment(request).scene;
  SceneOutput& output = scene.scene.output;
  const int width = read_number_member(request.body, "width", output.width);
  if (width < 16 || width > 65535)
    throw Error(ErrorKind::usage, "width", fmt::format("{}", width), "16 … 65535 px");
  output = with_width(output, width);
  const fs::path folder = fs::path(scene.folder) / (scene.name + "_rendered");
  // The last rung is the same work, of fewer pixels.
  double expected_s = 0.0;
  {
    const std::lock_guard guard(mutex);
    if (last_rung_px > 0.0)
      expected_s = last_rung_s * std::max(1.0, 1.0 * output.width * output.height / last_rung_px);
  }
  // The live pictures make room.
  quick.cancel();
  exact.cancel();
  const auto work = [scene, folder = folder.string()](const Run& given) {
    belvedere::render(scene, folder, given);
    write_web_page({{folder, scene.name}}, page_folder(folder), {}, given.progress);
    return std::string();
  };
  render->start(folder.string(), run, work, expected_s);
  return json_answer(render_json(), 202);
}

Json StudioState::render_json() const {
  const Job::Report report = render->report();
  Json out = job_json(report);
  if (report.state == Job::State::done) out.add("page", Json::text("render/index.html"));
  return out;
}

HttpAnswer StudioState::take_file(const HttpRequest& request) {
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

namespace {

namespace fs = std::filesystem;

// Numbers in a text, with this between them and spaces beside it; one or two.
std::vector<double> read_numbers(const std::string& text, char between, const char* member,
                                 const char* allowed) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto skip_spaces = [&] {
    while (at != end && *at == ' ') ++at;
  };
  for (bool more = true; more;) {
    skip_spaces();
    double number = 0.0;
    const std::from_chars_result read = std::from_chars(at, end, number);
    at = read.ptr;
    skip_spaces();
    more = at != end && *at == between;
    if (read.ec != std::errc() || numbers.size() == 2 || (at != end && !more))
      throw Error(ErrorKind::usage, member, fmt::format("\"{}\"", text.substr(0, 80)), allowed);
    numbers.push_back(number);
    if (more) ++at;
  }
  return numbers;
}

}  // namespace

// A position and a size as `fetch` takes them. The folder below the scene's is named by them alone.
HttpAnswer StudioState::start_fetch(const HttpRequest& request) {
  const std::string scene = moment(request).scene.folder;
  WantedPlace place;
  constexpr const char* position = "longitude and latitude in degrees: 11.4, 47.35";
  const std::string where = read_text_member(request.body, "place");
  const std::vector<double> at = read_numbers(where, ',', "place", position);
  if (at.size() != 2)
    throw Error(ErrorKind::usage, "place", fmt::format("\"{}\"", where), position);
  place.at_lonlat = {at[0], at[1]};
  const std::vector<double> size = read_numbers(read_text_member(request.body, "size", "60"), 'x',
                                                "size", "kilometres: 60, or 80x50");
  place.size_km = {size.front(), size.back()};
  place.land_cover = read_text_member(request.body, "land_cover", "yes") == "yes";
  // Refuses at once what is out of range.
  constexpr double any_cell_m = 30.0;
  FetchParameters area;
  area.at_lonlat = place.at_lonlat;
  area.size_km = place.size_km;
  fetch_frame(area, any_cell_m);
  if (!open_place)
    throw Error(ErrorKind::usage, "place", "this studio does not fetch maps",
                "files dropped on the page");
  const fs::path folder =
      fs::path(scene) / fmt::format("place_{:.4f}_{:.4f}_{:g}x{:g}", place.at_lonlat.x,
                                    place.at_lonlat.y, place.size_km.x, place.size_km.y);
  if (fs::is_symlink(fs::symlink_status(folder)))
    throw Error(ErrorKind::output, folder.string(), "is a link", "a folder, or nothing");
  place.folder = folder.string();
  fetch->start(place.folder, run, [place, open = open_place](const Run& given) {
    try {
      return open(place, given);
    } catch (...) {
      std::error_code ignored;
      fs::remove(place.folder, ignored);  // only where nothing is in it
      throw;
    }
  });
  return json_answer(fetch_json(), 202);
}

// `name`: "style" fits that of a painting, "pick" opens the room for its pairs. The painting is one
// that the scene names, or a file beside it.
HttpAnswer StudioState::start_painting_work(const HttpRequest& request, const std::string& name) {
  const LoadedScene scene = moment({}).scene;
  const std::string file = read_text_member(request.body, "painting");
  const std::string path = file.empty() ? file : find_scene_file(scene, file);
  if (path.empty()) throw missing_scene_file(scene, file);
  const std::string stem = fs::path(file).stem().string();
  const std::string result = stem + (name == "style" ? "_style.toml" : "_pairs.csv");
  const std::string target = (fs::path(scene.folder) / result).string();
  if (name == "style") {
    if (!fit_style) throw Error(ErrorKind::usage, "style", "this studio fits none", "style fit");
    if (fs::exists(fs::symlink_status(target)))
      throw Error(ErrorKind::output, result, "a file of that name is there already",
                  "that style, or another name of the painting; no file is replaced");
    painting->start(target, run, [=, this](const Run& given) {
      fit_style(path, target, given);
      return result;
    });
  } else {
    if (!open_picking)
      throw Error(ErrorKind::usage, "pick", "this studio picks no pairs", "exemplar pick");
    {
      const std::lock_guard guard(mutex);
      picking = {};  // only one page may have a table of pairs open
    }
    painting->start(target, run, [=, this](const Run& given) {
      Room room = open_picking(scene, path, target, given);
      const std::lock_guard guard(mutex);
      picking = std::move(room);
      return std::string("pick/");
    });
  }
  return json_answer(job_json(painting->report()), 202);
}

Json StudioState::fetch_json() const {
  const Job::Report report = fetch->report();
  Json out = job_json(report);
  if (report.state == Job::State::done) out.add("text", Json::text(report.result));
  return out;
}

}  // namespace belvedere::tools
