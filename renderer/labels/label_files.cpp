#include "renderer/labels/label_files.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text/json.h"
#include "base/text/markup.h"
#include "renderer/labels/drawing_svg.h"
#include "renderer/labels/label_drawing.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

// A hundredth of a pixel is finer than any printer, and gives the same text on every machine.
std::string csv_px(double value) { return fmt::format("{:.2f}", value == 0.0 ? 0.0 : value); }

std::string quoted_csv(const std::string& text) {
  if (text.find_first_of(",\"\n\r;") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string number_or_nothing(double value, int digits) {
  return std::isnan(value) ? std::string() : fmt::format("{:.{}f}", value, digits);
}

// Whether it was placed in the picture: "placed", "no room", "enough names around", or why it is
// not visible.
std::string outcome(const Label& label) {
  if (label.mark.state != MarkState::seen) return std::string(name_of(label.mark.state));
  return label.spot.placed ? "placed" : label.spot.crowded ? "enough names around" : "no room";
}

bool has_pixel(const Label& label) {
  return label.mark.state != MarkState::outside_terrain &&
         label.mark.state != MarkState::behind_eye;
}

constexpr const char* columns =
    "name,kind,rank,outcome,x_px,y_px,distance_m,altitude_file_m,altitude_dem_m,east,north,drawn_"
    "east,drawn_north,hidden_by,where";

std::string csv_row(const LabelSheet& sheet, const Label& label, const std::string& outcome) {
  const LabelMark& mark = label.mark;
  return fmt::format("{},{},{:g},{},{},{},{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{},{}",
                     quoted_csv(label.point.name), quoted_csv(sheet.kind_of(label).name),
                     label.point.rank, outcome, has_pixel(label) ? csv_px(mark.pixel.x) : "",
                     has_pixel(label) ? csv_px(mark.pixel.y) : "",
                     has_pixel(label) ? fmt::format("{:.0f}", mark.distance_m) : "",
                     number_or_nothing(label.point.altitude_m.value_or(NAN), 1),
                     number_or_nothing(mark.dem_altitude_m, 1), label.point.position.x,
                     label.point.position.y, mark.drawn_position.x, mark.drawn_position.y,
                     quoted_csv(label.hidden_by), quoted_csv(label.point.where));
}

}  // namespace

std::string labels_svg(const LabelSheet& sheet, const std::string& under) {
  const double height_mm = sheet.sheet_width_mm * sheet.size_px.y / sheet.size_px.x;
  std::string out = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{:.3f}mm" height="{:.3f}mm" viewBox="0 0 {} {}">
)",
      sheet.sheet_width_mm, height_mm, sheet.size_px.x, sheet.size_px.y);
  if (!under.empty())
    out += fmt::format(
        "  <image xlink:href=\"{}\" x=\"0\" y=\"0\" width=\"{}\" height=\"{}\" "
        "preserveAspectRatio=\"none\"/>\n",
        markup_text(under), sheet.size_px.x, sheet.size_px.y);
  for (const DrawnGroup& group : draw_labels(sheet))
    out += fmt::format("  <g id=\"{}\">\n{}  </g>\n", markup_text(group.name),
                       shapes_svg(group.shapes));
  return out + "</svg>\n";
}

std::string labels_csv(const LabelSheet& sheet) {
  std::string out = std::string(columns) + '\n';
  for (const Label& label : sheet.labels) out += csv_row(sheet, label, outcome(label)) + '\n';
  return out;
}

std::string places_csv(const LabelSheet& sheet) {
  std::string out = std::string(columns) + ",hiding_east,hiding_north\n";
  for (const Label& label : sheet.labels) {
    const std::optional<GeoPosition>& front = label.mark.in_front;
    out += csv_row(sheet, label, std::string(name_of(label.mark.state)));
    out += front ? fmt::format(",{:.2f},{:.2f}\n", front->position.x, front->position.y) : ",,\n";
  }
  return out;
}

std::string labels_geojson(const LabelSheet& sheet, const std::string& crs) {
  if (crs.empty())
    throw Error(ErrorKind::usage, "labels.geojson", "the terrain has no CRS", "terrain with a CRS");
  std::vector<glm::dvec2> positions;
  for (const Label& label : sheet.labels) positions.push_back(label.mark.drawn_position);
  PointTransform(crs, "EPSG:4326").apply(positions);
  Json features = Json::array();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Label& label = sheet.labels[i];
    Json properties = Json::object()
                          .add("name", Json::text(label.point.name))
                          .add("kind", Json::text(sheet.kind_of(label).name))
                          .add("rank", Json::number(label.point.rank))
                          .add("outcome", Json::text(outcome(label)));
    if (label.point.altitude_m)
      properties.add("altitude_file_m", Json::number(*label.point.altitude_m));
    if (!std::isnan(label.mark.dem_altitude_m))
      properties.add("altitude_dem_m",
                     Json::number(std::round(10.0 * label.mark.dem_altitude_m) / 10.0));
    if (has_pixel(label))
      properties
          .add("pixel", Json::array({Json::raw(csv_px(label.mark.pixel.x)),
                                     Json::raw(csv_px(label.mark.pixel.y))}))
          .add("distance_m", Json::number(std::round(label.mark.distance_m)));
    if (!label.hidden_by.empty()) properties.add("hidden_by", Json::text(label.hidden_by));
    const bool on_earth = std::isfinite(positions[i].x) && std::isfinite(positions[i].y);
    Json geometry = Json::raw("null");
    if (on_earth)
      geometry =
          Json::object()
              .add("type", Json::text("Point"))
              .add("coordinates", Json::array({Json::raw(fmt::format("{:.7f}", positions[i].x)),
                                               Json::raw(fmt::format("{:.7f}", positions[i].y))}));
    features.add(Json::object()
                     .add("type", Json::text("Feature"))
                     .add("geometry", std::move(geometry))
                     .add("properties", std::move(properties)));
  }
  return Json::object()
             .add("type", Json::text("FeatureCollection"))
             .add("features", std::move(features))
             .str() +
         "\n";
}

}  // namespace belvedere
