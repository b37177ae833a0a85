#include "renderer/labels/label_files.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text/json.h"
#include "base/text/text_encoding.h"
#include "renderer/labels/drawing_svg.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

constexpr double rim_mm = 0.16;  // light line around marks, so that they are crisp on any ground
// Height of the centre of capitals and figures of a sans-serif above the baseline, of its size.
constexpr double figures_centre = 0.36;

std::vector<glm::dvec2> square(glm::dvec2 centre, glm::dvec2 half) {
  return {centre - half, centre + glm::dvec2(half.x, -half.y), centre + half,
          centre + glm::dvec2(-half.x, half.y)};
}

void draw_mark(const LabelKindStyle& kind, glm::dvec2 at, double px_per_mm,
               std::vector<DrawnShape>& shapes) {
  const double r = .5 * kind.mark_mm * px_per_mm;
  const double rim = rim_mm * px_per_mm;
  const auto polygon = [&](std::vector<glm::dvec2> points) {
    shapes.push_back(DrawnPath{
        .points = points, .closed = true, .fill = {}, .stroke = kind.halo, .width_px = 2.0 * rim});
    shapes.push_back(
        DrawnPath{.points = std::move(points), .closed = true, .fill = kind.colour, .stroke = {}});
  };
  const auto disc = [&](double radius_px, const std::string& fill) {
    shapes.push_back(DrawnCircle{.centre = at, .radius_px = radius_px, .fill = fill, .stroke = {}});
  };
  switch (kind.mark) {
    case LabelMarkShape::none:
      break;
    case LabelMarkShape::dot:
      disc(r + rim, kind.halo);
      disc(r, kind.colour);
      break;
    case LabelMarkShape::ring:
      disc(r + rim, kind.halo);
      disc(r, kind.colour);
      disc(.5 * r, kind.halo);
      break;
    case LabelMarkShape::square:
      polygon(square(at, {r, r}));
      break;
    case LabelMarkShape::triangle:  // its tip on the summit
      polygon({at + glm::dvec2(0, -r), at + glm::dvec2(r, .8 * r), at + glm::dvec2(-r, .8 * r)});
      break;
  }
}

DrawnText in_ink(const LabelSheet& sheet, const Label& label, std::string text, TextStyle type) {
  const LabelKindStyle& kind = sheet.kind_of(label);
  return {.text = std::move(text),
          .type = std::move(type),
          .colour = label.on_dark ? kind.light : kind.colour,
          .halo = label.on_dark ? kind.colour : kind.halo,
          .halo_px = kind.halo_mm * sheet.px_per_mm,
          .halo_contrast = sheet.style.min_contrast};
}

// The name, and its altitude under or after it.
void draw_name(const LabelSheet& sheet, const Label& label, std::vector<DrawnShape>& shapes) {
  const LabelBox& box = label.spot.text;
  const double centre = .5 * (box.left + box.right);
  DrawnText name = in_ink(sheet, label, label.text, sheet.type_of(label));
  name.at = {centre, box.top + label.room.up_px};
  name.anchor = .5;
  name.along = label.spot.baseline;
  if (label.altitude.empty()) {
    shapes.push_back(std::move(name));
    return;
  }
  DrawnText altitude = in_ink(sheet, label, label.altitude, sheet.altitude_type_of(label));
  if (!label.on_dark) altitude.colour = sheet.style.altitude.colour;
  altitude.at = name.at;
  altitude.anchor = .5;
  const double size_px = altitude.type.size_px;
  if (sheet.is_stacked(label)) {
    altitude.at.y += altitude_lead * size_px;
  } else {
    const double gap = altitude_gap * size_px;
    name.at.x -= .5 * (gap + label.altitude_room.width_px);
    altitude.at.x += .5 * (gap + label.room.width_px);
  }
  shapes.push_back(std::move(name));
  shapes.push_back(std::move(altitude));
}

// A number in a disc, or in a tile where the kind's mark is a square or the text is long.
void draw_plate(const LabelSheet& sheet, const Label& label, std::vector<DrawnShape>& shapes) {
  const LabelKindStyle& kind = sheet.kind_of(label);
  const LabelBox& box = label.spot.text;
  const glm::dvec2 half(.5 * (box.right - box.left), .5 * (box.bottom - box.top));
  const glm::dvec2 centre(box.left + half.x, box.top + half.y);
  const double rim = 1.3 * rim_mm * sheet.px_per_mm;
  if (kind.mark == LabelMarkShape::square || half.x > half.y + .01)
    shapes.push_back(DrawnPath{.points = square(centre, half - .5 * rim),
                               .closed = true,
                               .fill = kind.colour,
                               .stroke = kind.light,
                               .width_px = rim});
  else
    shapes.push_back(DrawnCircle{.centre = centre,
                                 .radius_px = half.x - .5 * rim,
                                 .fill = kind.colour,
                                 .stroke = kind.light,
                                 .width_px = rim});
  const TextStyle type = sheet.type_of(label);
  shapes.push_back(DrawnText{.text = label.text,
                             .type = type,
                             .at = centre + glm::dvec2(0.0, figures_centre * type.size_px),
                             .anchor = .5,
                             .colour = kind.light});
}

// From the end at the text to the border of the mark.
DrawnPath draw_leader(const LabelSheet& sheet, const Label& label) {
  const double radius = .5 * sheet.kind_of(label).mark_mm * sheet.px_per_mm;
  const glm::dvec2 mark = label.mark.pixel;
  const glm::dvec2 end = label.spot.leader_end;
  const glm::dvec2 foot = end.x == mark.x && end.y < mark.y
                              ? glm::dvec2(mark.x, mark.y - radius)
                              : mark + radius * glm::normalize(end - mark);
  return {.points = {end, foot},
          .fill = {},
          .stroke = sheet.style.leader,
          .width_px = sheet.style.leader_mm * sheet.px_per_mm};
}

// Mark and name.
void draw_marked(const LabelSheet& sheet, const Label& label, std::vector<DrawnShape>& shapes) {
  const LabelKindStyle& kind = sheet.kind_of(label);
  if (kind.position == LabelPlace::on) {
    draw_plate(sheet, label, shapes);
    return;
  }
  if (label.spot.baseline.empty()) draw_mark(kind, label.mark.pixel, sheet.px_per_mm, shapes);
  draw_name(sheet, label, shapes);
}

}  // namespace

std::vector<DrawnGroup> draw_tracks(const LabelSheet& sheet) {
  std::vector<DrawnGroup> groups;
  const TrackStyle& style = sheet.style.track;
  const double width = style.width_mm * sheet.px_per_mm;
  DrawnGroup hidden{"tracks-hidden", {}}, edges{"tracks-edge", {}}, seen{"tracks", {}};
  for (const Track& track : sheet.tracks)
    for (const TrackRun& run : track.runs) {
      const auto line = [&](const std::string& colour, double width_px) {
        return DrawnPath{.points = run.pixels, .fill = {}, .stroke = colour, .width_px = width_px};
      };
      if (run.seen) {
        edges.shapes.push_back(line(style.halo, width + 2.0 * style.halo_mm * sheet.px_per_mm));
        seen.shapes.push_back(line(style.colour, width));
      } else {
        DrawnPath dashed = line(style.colour, .6 * width);
        dashed.dashes_px = {1.5 * width, 2.0 * width};
        hidden.shapes.push_back(std::move(dashed));
      }
    }
  for (DrawnGroup* group : {&hidden, &edges, &seen})
    if (!group->shapes.empty()) groups.push_back(std::move(*group));
  return groups;
}

std::vector<DrawnShape> draw_label(const LabelSheet& sheet, const Label& label) {
  std::vector<DrawnShape> shapes;
  if (!label.spot.placed) return shapes;
  if (label.spot.has_leader) shapes.push_back(draw_leader(sheet, label));
  draw_marked(sheet, label, shapes);
  return shapes;
}

std::vector<DrawnGroup> draw_labels(const LabelSheet& sheet) {
  std::vector<DrawnGroup> groups = draw_tracks(sheet);
  DrawnGroup leaders{"leaders", {}};
  for (const Label& label : sheet.labels)
    if (label.spot.placed && label.spot.has_leader) {
      leaders.shapes.push_back(draw_leader(sheet, label));
    }
  if (!leaders.shapes.empty()) groups.push_back(std::move(leaders));
  for (std::size_t k = 0; k < sheet.style.kinds.size(); ++k) {
    const LabelKindStyle& kind = sheet.style.kinds[k];
    DrawnGroup group{kind.name, {}};
    for (const Label& label : sheet.labels) {
      if (!label.spot.placed || label.point.kind != static_cast<int>(k)) continue;
      draw_marked(sheet, label, group.shapes);
    }
    if (!group.shapes.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

Drawing label_drawing(const LabelSheet& sheet) {
  Drawing drawing{.size_px = sheet.size_px, .shapes = {}};
  for (DrawnGroup& group : draw_labels(sheet))
    std::move(group.shapes.begin(), group.shapes.end(), std::back_inserter(drawing.shapes));
  return drawing;
}

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

std::string outcome_of(const Label& label) {
  if (label.mark.state != MarkState::seen) return std::string(name_of(label.mark.state));
  return label.spot.placed ? "placed" : label.spot.crowded ? "enough names around" : "no room";
}

std::string labels_csv(const LabelSheet& sheet) {
  std::string out = std::string(columns) + '\n';
  for (const Label& label : sheet.labels) out += csv_row(sheet, label, outcome_of(label)) + '\n';
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
                          .add("outcome", Json::text(outcome_of(label)));
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
