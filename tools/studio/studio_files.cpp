#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/error.h"
#include "base/files/output_file.h"
#include "base/text/letters.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/draft.h"
#include "tools/studio/job.h"
#include "tools/studio/request_body.h"
#include "tools/studio/studio_state.h"
#include "tools/web/web_page.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// What the page of a rendered picture may load and run: it has its scripts in itself, and asks
// nothing of the program.
constexpr const char* rendered_policy =
    "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

// Of the page of a rendered picture.
std::string page_folder(const std::string& folder) { return (fs::path(folder) / "web").string(); }

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
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
  // The live pictures make room.
  quick.cancel();
  exact.cancel();
  render->start(folder.string(), run, [scene, folder = folder.string()](const Run& given) {
    belvedere::render(scene, folder, given);
    write_web_page({{folder, scene.name}}, page_folder(folder), {}, given.progress);
    return std::string();
  });
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

}  // namespace belvedere::tools
