#include "tools/web/web_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <sstream>

#include "base/error.h"
#include "base/files/file_guard.h"
#include "base/files/output_file.h"
#include "base/land_cover_class.h"
#include "base/parallel.h"
#include "base/text/embedded.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/image/exr/exr_reader.h"
#include "renderer/image/image_io.h"
#include "renderer/image/oiio_file.h"
#include "renderer/image/rows/picture_rows.h"
#include "renderer/paint/composite.h"
#include "renderer/scene/scene_file.h"
#include "terrain/io/crs.h"

namespace belvedere::tools {
namespace {

// One level of the picture: collects rows until they make a row of tiles, cuts these, and passes
// the rows on to the next level.
class Level {
 public:
  Level(int number, int width, int height, int tile_px, const TakeTile& take_tile)
      : number_(number),
        tile_px_(tile_px),
        take_tile_(take_tile),
        band_(width, std::min(height, tile_px)),
        height_(height) {
    if (std::max(width, height) <= tile_px_) return;
    reducer_ = std::make_unique<RowReducer>(width, height, 2);
  }

  bool last() const { return reducer_ == nullptr; }
  int next_width() const { return reducer_->width(); }
  int next_height() const { return reducer_->height(); }

  void take(const Grid<glm::vec3>& encoded) {
    for (int y = 0; y < encoded.height(); ++y) {
      std::copy_n(encoded.row(y), encoded.width(), band_.row(filled_));
      if (++filled_ == band_.height() || taken_ + filled_ == height_) cut();
    }
  }
  // Rows of the next level; often none.
  Grid<glm::vec3> smaller(const Grid<glm::vec3>& encoded) {
    return encode_srgb(reducer_->reduce(decode_srgb(encoded)));
  }

 private:
  void cut() {
    const int row = taken_ / tile_px_;
    const int across = (band_.width() + tile_px_ - 1) / tile_px_;
    parallel_rows(across, [&](int column) {
      const int x0 = column * tile_px_;
      const PixelRect tile{x0, 0, std::min(x0 + tile_px_, band_.width()), filled_};
      take_tile_(number_, column, row, part_of(band_, tile));
    });
    taken_ += filled_;
    filled_ = 0;
  }

  int number_;
  int tile_px_;
  const TakeTile& take_tile_;
  Grid<glm::vec3> band_;
  int height_;
  int filled_ = 0;  // rows of the band
  int taken_ = 0;   // rows of the picture
  std::unique_ptr<RowReducer> reducer_;
};

}  // namespace

TilePyramid cut_into_tiles(int width, int height, int tile_px, const ReadRows& read,
                           const TakeTile& take) {
  std::vector<std::unique_ptr<Level>> levels;
  for (int w = width, h = height;;) {
    levels.push_back(std::make_unique<Level>(static_cast<int>(levels.size()), w, h, tile_px, take));
    if (levels.back()->last()) break;
    w = levels.back()->next_width();
    h = levels.back()->next_height();
  }
  read([&](const Grid<glm::vec3>& rows) {
    Grid<glm::vec3> encoded = rows;
    for (std::size_t k = 0; k < levels.size() && encoded.height() > 0; ++k) {
      levels[k]->take(encoded);
      if (!levels[k]->last()) encoded = levels[k]->smaller(encoded);
    }
  });
  return {width, height, tile_px, static_cast<int>(levels.size())};
}

TilePyramid write_tile_pyramid(const std::string& picture, const std::string& folder,
                               const TileParameters& parameters, Progress& progress) {
  const ImageInfo info = read_image_info(picture);
  progress.begin("cutting the picture into tiles", info.height);
  return cut_into_tiles(
      info.width, info.height, parameters.tile_px,
      [&](const TakeRows& take) {
        read_picture_rows(picture, [&](int, const Grid<glm::vec3>& rows) {
          take(rows);
          progress.advance(rows.height());
        });
      },
      [&](int level, int column, int row, const Grid<glm::vec3>& tile) {
        const std::string place = fmt::format("{}/{}", folder, level);
        std::filesystem::create_directories(place);
        write_jpeg(fmt::format("{}/{}_{}.jpg", place, column, row), tile, parameters.quality);
      });
}

namespace {

constexpr double altitude_from_m = -1000.0;
constexpr double distance_step_m = 10.0;
constexpr double max_steps = 65535.0;

glm::dvec2 origin_of(const FileNotes& notes) {
  glm::dvec2 origin(0.0);
  if (const auto note = notes.find("origin"); note != notes.end())
    std::istringstream(note->second) >> origin.x >> origin.y;
  return origin;
}

// Map coordinates to longitude and latitude, if the file states its CRS.
void find_positions(const ImageInfo& info, const Grid<float>& east, const Grid<float>& north,
                    ReadOut& out) {
  const auto crs = info.notes.find("belvedere:crs");
  // A CRS without a code is given by its name alone.
  if (crs == info.notes.end() || !crs->second.starts_with("EPSG:") || east.empty() || north.empty())
    return;
  const glm::dvec2 origin = origin_of(info.notes);
  std::vector<glm::dvec2> positions(east.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i] = std::isinf(out.distance_m[i]) ? origin : origin + glm::dvec2(east[i], north[i]);
  PointTransform(crs->second, "EPSG:4326").apply(positions);
  out.longitude_deg = Grid<double>(east.width(), east.height());
  out.latitude_deg = Grid<double>(east.width(), east.height());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    out.longitude_deg[i] = positions[i].x;
    out.latitude_deg[i] = positions[i].y;
  }
  out.has_places = true;
}

void put(std::string& bytes, double value) {
  const auto whole = static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0, max_steps));
  bytes += static_cast<char>(whole & 255U);
  bytes += static_cast<char>(whole >> 8U);
}

// The extent of all pixels but sky.
glm::dvec2 extent_of(const Grid<double>& values, const Grid<float>& distance_m) {
  glm::dvec2 extent(std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isinf(distance_m[i]) && std::isfinite(values[i]))
      extent = {std::min(extent.x, values[i]), std::max(extent.y, values[i])};
  return extent.x <= extent.y ? extent : glm::dvec2(0.0);
}

Json degrees(const Grid<double>& values, const Grid<float>& distance_m) {
  const glm::dvec2 extent = extent_of(values, distance_m);
  std::string bytes;
  bytes.reserve(2 * values.size());
  for (const double value : values)
    put(bytes, extent.y > extent.x ? (value - extent.x) / (extent.y - extent.x) * max_steps : 0.0);
  return Json::object()
      .add("from", Json::number(extent.x))
      .add("to", Json::number(extent.y))
      .add("values", Json::text(base64(bytes)));
}

}  // namespace

ReadOut sample_read_out(const std::string& guidance_file, int max_cells) {
  const ImageInfo info = read_exr_info(guidance_file);
  const double pixels = static_cast<double>(info.width) * info.height;
  ReadOut out;
  out.step_px =
      std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / std::max(1, max_cells)))));
  std::vector<Grid<float>> channels = read_sampled_channels(
      guidance_file, {"Z", "landcover.id", "altitude.V", "P.X", "P.Y"}, out.step_px);
  if (channels[0].empty() || channels[1].empty())
    throw Error(ErrorKind::input, guidance_file, "has no distances or no classes",
                "guidance.exr with the channels Z and landcover.id");
  out.distance_m = std::move(channels[0]);
  out.class_id = std::move(channels[1]);
  out.altitude_m = channels[2].empty()
                       ? Grid<float>(out.distance_m.width(), out.distance_m.height())
                       : std::move(channels[2]);
  find_positions(info, channels[3], channels[4], out);
  return out;
}

std::string read_out_script(const ReadOut& read_out) {
  std::string classes, altitudes, distances;
  for (std::size_t i = 0; i < read_out.distance_m.size(); ++i) {
    const bool sky = std::isinf(read_out.distance_m[i]);
    classes += static_cast<char>(sky ? 255 : static_cast<int>(read_out.class_id[i]));
    put(altitudes, sky ? 0.0 : read_out.altitude_m[i] - altitude_from_m);
    put(distances, sky ? max_steps : read_out.distance_m[i] / distance_step_m);
  }
  Json names = Json::array();
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    std::string name(info.name);
    std::replace(name.begin(), name.end(), '_', ' ');
    names.add(Json::text(name));
  }
  Json out = Json::object();
  out.add("step", Json::number(read_out.step_px))
      .add("width", Json::number(read_out.distance_m.width()))
      .add("height", Json::number(read_out.distance_m.height()))
      .add("altitudeFrom", Json::number(altitude_from_m))
      .add("distanceStep", Json::number(distance_step_m))
      .add("classNames", std::move(names))
      .add("classes", Json::text(base64(classes)))
      .add("altitudes", Json::text(base64(altitudes)))
      .add("distances", Json::text(base64(distances)));
  if (read_out.has_places)
    out.add("longitude", degrees(read_out.longitude_deg, read_out.distance_m))
        .add("latitude", degrees(read_out.latitude_deg, read_out.distance_m));
  return out.str();
}

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
