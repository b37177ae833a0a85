#include "tools/web/web_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <map>
#include <sstream>
#include <string_view>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/text/embedded.h"
#include "base/text/json.h"
#include "base/text/markup.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/scene_file.h"
#include "tools/web/read_out.h"
#include "tools/web/tile_pyramid.h"

namespace belvedere::tools {
namespace {

namespace fs = std::filesystem;

// The largest of the pictures in RGB that the folder's newest run made: a printer's TIFF may be
// CMYK.
std::string picture_of(const std::string& folder) {
  std::string best;
  int widest = 0;
  for (const std::string& name :
       newest_results(folder, {"panorama.png", "panorama.tif", "panorama.jxl"})) {
    const std::string path = (fs::path(folder) / name).string();
    const ImageInfo info = read_image_info(path);
    if (info.parts[0].channels.size() != 3 || info.width <= widest) continue;
    best = path;
    widest = info.width;
  }
  if (best.empty())
    throw Error(ErrorKind::input, folder, "has no panorama.png or panorama.tif of three colours",
                "a folder written by belvedere render");
  return best;
}

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Values of the picture's own notes.
struct About {
  std::string title;
  std::string sources;     // HTML
  glm::ivec2 sheet_px{0};  // of the whole; 0: unknown
};
About about(const ImageInfo& info, const std::string& folder) {
  About out{fs::weakly_canonical(folder).filename().string(), {}, {}};
  const auto note = info.notes.find("belvedere:scene");
  if (note != info.notes.end()) {
    const LoadedScene loaded = parse_scene(note->second, "scene of the picture", folder, {});
    if (!loaded.scene.title.empty()) out.title = loaded.scene.title;
    out.sheet_px = {loaded.scene.output.width, loaded.scene.output.height};
    for (const std::string& credit : source_credits(loaded))
      out.sources += markup_text(credit) + "<br>";
  }
  const auto software = info.notes.find("Software");
  out.sources += markup_text(software == info.notes.end() ? "Belvedere" : software->second);
  return out;
}

Json picture_entry(const std::string& name, const std::string& tiles, const TilePyramid& pyramid) {
  return Json::object()
      .add("name", Json::text(name))
      .add("folder", Json::text(tiles))
      .add("width", Json::number(pyramid.width))
      .add("height", Json::number(pyramid.height))
      .add("tilePx", Json::number(pyramid.tile_px))
      .add("levels", Json::number(pyramid.levels));
}

// Pixels of the picture per pixel of another file of the same view, which may be larger.
double scale_between(int other_width, int width) {
  return static_cast<double>(width) / static_cast<double>(other_width);
}

// The names of the folder's labels. Their pixels refer to the whole sheet, so they are not used for
// a part of it.
void add_labels(Json& page, const std::string& folder, const ImageInfo& info, const About& said,
                Progress& progress) {
  const std::string labels = (fs::path(folder) / "labels.geojson").string();
  if (!fs::exists(labels)) return;
  const int sheet = said.sheet_px.x > 0 ? said.sheet_px.x : info.width;
  const double scale = scale_between(sheet, info.width);
  if (said.sheet_px.y > 0 && std::abs(info.height - scale * said.sheet_px.y) > 1.0) {
    progress.note("the picture is a part of its sheet: names are left out");
    return;
  }
  page.add("labels", Json::raw(text_of(labels))).add("labelScale", Json::number(scale));
}

}  // namespace

void write_web_page(const std::vector<WebPicture>& pictures, const std::string& folder,
                    const WebParameters& parameters, Progress& progress) {
  if (pictures.empty()) throw Error(ErrorKind::bug, "write_web_page", "no pictures");
  std::vector<std::string> files;
  for (const WebPicture& picture : pictures) files.push_back(picture_of(picture.folder));
  const ImageInfo first = read_image_info(files[0]);
  for (std::size_t k = 1; k < files.size(); ++k)
    if (const ImageInfo other = read_image_info(files[k]);
        other.width != first.width || other.height != first.height)
      throw Error(
          ErrorKind::usage, files[k], fmt::format("{} × {} pixels", other.width, other.height),
          fmt::format("{} × {} as {}: pictures of one view", first.width, first.height, files[0]));
  file_guard().writes_into(folder, "--out", parameters.replace);

  Json entries = Json::array();
  for (std::size_t k = 0; k < files.size(); ++k) {
    const std::string tiles = fmt::format("tiles/{}", k);
    // An earlier page may have left more of them.
    file_guard().remove_own((fs::path(folder) / tiles).string());
    fs::create_directories(fs::path(folder) / tiles);
    const TilePyramid pyramid =
        write_tile_pyramid(files[k], (fs::path(folder) / tiles).string(),
                           {parameters.tile_px, parameters.quality}, progress);
    entries.add(picture_entry(pictures[k].name, tiles, pyramid));
  }

  Json page = Json::object();
  page.add("pictures", std::move(entries));
  const std::string guidance = (fs::path(pictures[0].folder) / "guidance.exr").string();
  if (fs::exists(guidance)) {
    progress.begin("reading positions", 0.0);
    const int width = read_image_info(guidance).width;
    page.add("ground",
             Json::raw(read_out_script(sample_read_out(guidance, parameters.ground_cells))))
        .add("groundScale", Json::number(scale_between(width, first.width)));
  } else {
    progress.note(
        fmt::format("{} has no guidance.exr: the page will not show positions under the pointer",
                    pictures[0].folder));
  }
  const About said = about(first, pictures[0].folder);
  add_labels(page, pictures[0].folder, first, said, progress);
  write_text_file((fs::path(folder) / "panorama.js").string(),
                  "window.panoramaPage = " + script_json(page.str()) + ";\n");

  write_text_file((fs::path(folder) / "index.html").string(),
                  filled_page(embedded_file("web/index.html"),
                              {{"title", markup_text(said.title)},
                               {"alt", markup_text("Panorama: " + said.title)},
                               {"first", markup_text(pictures[0].name)},
                               {"sources", said.sources},
                               {"css", std::string(embedded_file("web/page.css"))},
                               {"ground", std::string(embedded_file("web/ground.js"))},
                               {"viewer", std::string(embedded_file("web/viewer.js"))},
                               {"page", std::string(embedded_file("web/page.js"))}}));
}

}  // namespace belvedere::tools
