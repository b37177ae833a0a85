#include "tools/web/read_out.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <limits>
#include <sstream>
#include <vector>

#include "base/error.h"
#include "base/land_cover_class.h"
#include "base/text/base64.h"
#include "base/text/json.h"
#include "renderer/image/exr/exr_reader.h"
#include "terrain/io/crs.h"

namespace belvedere::tools {
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

}  // namespace belvedere::tools
