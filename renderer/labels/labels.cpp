#include "renderer/labels/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// Room at both ends of a text, of its type's size: names that follow each other in a row stay two names.
constexpr double end_room = 0.25;

std::string set_text(const LabelPoint& point, const LabelMark& mark, const LabelKindStyle& kind) {
  if (point.name.empty()) return altitude_text(point, mark);
  const std::string altitude = kind.altitude ? altitude_text(point, mark) : std::string();
  return altitude.empty() ? point.name : point.name + "\u2002" + altitude;
}

// The named point nearest to the ground that hides a mark.
std::string hider(const LabelMark& mark, const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks) {
  std::string name;
  double nearest_m = hiding_name_m;
  if (!mark.in_front) return name;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away_m = glm::length(marks[i].drawn_place - mark.in_front->place);
    if (points[i].name.empty() || away_m >= nearest_m || &marks[i] == &mark) continue;
    nearest_m = away_m;
    name = points[i].name;
  }
  return name;
}

LabelLayoutParameters layout_parameters(const LabelSheet& sheet) {
  const double scale = sheet.px_per_mm;
  return {.width_px = sheet.size_px.x,
          .height_px = sheet.size_px.y,
          .margin_px = sheet.style.margin_mm * scale,
          .clearance_px = sheet.style.clearance_mm * scale,
          .gap_px = sheet.style.gap_mm * scale,
          .row_px = sheet.style.row_mm * scale,
          .longest_leader_px = sheet.style.longest_leader_mm * scale};
}

}  // namespace

std::string altitude_text(const LabelPoint& point, const LabelMark& mark) {
  const double altitude_m = point.altitude_m.value_or(mark.dem_altitude_m);
  return std::isnan(altitude_m) ? std::string() : fmt::format("{:.0f}\u00A0m", altitude_m);
}

TextStyle text_style(const LabelKindStyle& kind, double px_per_mm) {
  return {.family = kind.family, .size_px = kind.size_mm * px_per_mm, .bold = kind.bold, .italic = kind.italic, .spacing = kind.spacing};
}

std::vector<double> find_skyline(const GeoMap& map, glm::ivec2 size_px) {
  std::vector<double> skyline(static_cast<std::size_t>(size_px.x));
  parallel_ranges<int>(size_px.x, 16, [&](int begin, int end) {
    for (int x = begin; x < end; ++x) {
      double sky = 0.0;
      double land = size_px.y;
      if (map.to_geo({x + .5, 0.0})) land = 0.0;
      while (land - sky > .25) {
        const double middle = .5 * (sky + land);
        (map.to_geo({x + .5, middle}) ? land : sky) = middle;
      }
      skyline[static_cast<std::size_t>(x)] = land;
    }
  });
  return skyline;
}

LabelSheet make_labels(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks, const std::vector<double>& skyline_px,
                       LabelStyle style, glm::ivec2 size_px, double sheet_width_mm) {
  if (marks.size() != points.size())
    throw Error(ErrorKind::bug, "labels", fmt::format("{} marks of {} points", marks.size(), points.size()));
  double smallest_mm = std::numeric_limits<double>::infinity();
  for (const LabelKindStyle& kind : style.kinds) smallest_mm = std::min(smallest_mm, kind.size_mm);
  LabelSheet sheet{.size_px = size_px,
                   .sheet_width_mm = sheet_width_mm,
                   .px_per_mm = std::max(size_px.x / sheet_width_mm, style.least_px / smallest_mm),
                   .style = std::move(style),
                   .labels = {}};
  const TextMeasure measure;
  std::vector<LabelRequest> requests;
  std::vector<std::size_t> asks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LabelKindStyle& kind = sheet.style.kinds[static_cast<std::size_t>(points[i].kind)];
    Label label;
    label.point = points[i];
    label.mark = marks[i];
    label.text = set_text(points[i], marks[i], kind);
    const TextStyle type = text_style(kind, sheet.px_per_mm);
    label.room = measure.measure(label.text, type);
    if (label.mark.state == MarkState::hidden) label.hidden_by = hider(marks[i], points, marks);
    if (label.mark.state == MarkState::seen && !label.text.empty()) {
      asks.push_back(i);
      requests.push_back({.mark = label.mark.pixel,
                          .mark_px = kind.mark == LabelMarkShape::none ? 0.0 : kind.mark_mm * sheet.px_per_mm,
                          .width_px = label.room.width_px + 2.0 * end_room * type.size_px,
                          .height_px = label.room.up_px + label.room.down_px,
                          .place = kind.place,
                          .on_skyline = label.mark.on_skyline,
                          .rank = label.point.rank});
    }
    sheet.labels.push_back(std::move(label));
  }
  const std::vector<LabelSpot> spots = place_labels(requests, skyline_px, layout_parameters(sheet));
  for (std::size_t k = 0; k < asks.size(); ++k) sheet.labels[asks[k]].spot = spots[k];
  return sheet;
}

}  // namespace belvedere
