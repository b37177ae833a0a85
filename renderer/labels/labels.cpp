#include "renderer/labels/labels.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/labels/drawing.h"

namespace belvedere {
namespace {

// Space at both ends of a text, of its type's size, so that names that follow each other in a row
// stay separate.
constexpr double end_room = 0.25;

std::string set_text(const LabelPoint& point, const LabelMark& mark, const LabelKindStyle& kind) {
  if (point.name.empty()) return altitude_text(point, mark);
  const std::string altitude = kind.altitude ? altitude_text(point, mark) : std::string();
  return altitude.empty() ? point.name : point.name + "\u2002" + altitude;
}

// Limits of letter spacing along a shape: the share of the line, and the space between letters.
constexpr double spread_share = 0.55;
constexpr double max_spacing = 0.9;  // of the type's size, above the kind's

// Whether letters of the text join, as in Arabic and Syriac (U+0600 … U+077F), so that they cannot
// be drawn apart. The first bytes of UTF-8 are sufficient.
bool joins(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0xD8 && static_cast<unsigned char>(c) <= 0xDD;
  });
}

double spacing_of(const LabelKindStyle& kind, const std::string& text) {
  return joins(text) ? 0.0 : kind.spacing;
}

// The box of a rotated letter on a baseline.
LabelBox letter_box(const LetterPosition& position, double width, const TextRoom& room) {
  const glm::dvec2 down(-position.tangent.y, position.tangent.x);
  LabelBox box{position.at.x, position.at.y, position.at.x, position.at.y};
  for (const double x : {-.5 * width, .5 * width})
    for (const double y : {-room.up_px, room.down_px}) {
      const glm::dvec2 p = position.at + x * position.tangent + y * down;
      box = {std::min(box.left, p.x), std::min(box.top, p.y), std::max(box.right, p.x),
             std::max(box.bottom, p.y)};
    }
  return box;
}

// Baselines for a name along its shape; the label's spacing is set to its letter spacing.
std::vector<BentRoom> bent_rooms(Label& label, const LabelKindStyle& kind, TextStyle type,
                                 const std::vector<glm::dvec2>& line, const TextMeasure& measure) {
  const double count = static_cast<double>(std::max<std::size_t>(2, letters_of(label.text)));
  const double free_px = spread_share * length_of(line) - label.room.width_px;
  const double usual = spacing_of(kind, label.text);
  label.spacing =
      usual +
      (joins(label.text) ? 0.0 : std::clamp(free_px / (count * type.size_px), 0.0, max_spacing));
  type.spacing = label.spacing;
  label.room = measure.measure(label.text, type);
  std::vector<double> widths;
  for (const TextLetter& letter : measure.letters(label.text, type))
    widths.push_back(letter.width_px);
  std::vector<BentRoom> rooms;
  for (std::vector<glm::dvec2>& baseline : fitted_baselines(
           line, label.room.width_px, kind.lift * type.size_px, kind.aside * type.size_px)) {
    const std::vector<LetterPosition> positions = set_along(widths, baseline);
    if (positions.empty()) continue;
    BentRoom room{.baseline = std::move(baseline), .letters = {}};
    for (std::size_t i = 0; i < positions.size(); ++i)
      room.letters.push_back(letter_box(positions[i], widths[i], label.room));
    rooms.push_back(std::move(room));
  }
  if (!rooms.empty()) return rooms;
  // No arc is smooth or long enough: set like a point's name, in its usual spacing.
  label.spacing = type.spacing = usual;
  label.room = measure.measure(label.text, type);
  return rooms;
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

std::string hiding_name(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks,
                        std::size_t i) {
  std::string name;
  double nearest_m = hiding_name_m;
  if (marks[i].state != MarkState::hidden || !marks[i].in_front) return name;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double away_m = glm::length(marks[k].drawn_position - marks[i].in_front->position);
    if (points[k].name.empty() || away_m >= nearest_m || k == i) continue;
    nearest_m = away_m;
    name = points[k].name;
  }
  return name;
}

std::string altitude_text(const LabelPoint& point, const LabelMark& mark) {
  const double altitude_m = point.altitude_m.value_or(mark.dem_altitude_m);
  return std::isnan(altitude_m) ? std::string() : fmt::format("{:.0f}\u00A0m", altitude_m);
}

TextStyle text_style(const LabelKindStyle& kind, double px_per_mm) {
  return {.family = kind.family,
          .size_px = kind.size_mm * px_per_mm,
          .bold = kind.bold,
          .italic = kind.italic,
          .spacing = kind.spacing};
}

TextStyle LabelSheet::type_of(const Label& label) const {
  TextStyle type = text_style(kind_of(label), px_per_mm);
  type.spacing = label.spacing;
  return type;
}

LabelSheet empty_label_sheet(LabelStyle style, glm::ivec2 size_px, double sheet_width_mm) {
  double smallest_mm = std::numeric_limits<double>::infinity();
  for (const LabelKindStyle& kind : style.kinds) smallest_mm = std::min(smallest_mm, kind.size_mm);
  return {.size_px = size_px,
          .sheet_width_mm = sheet_width_mm,
          .px_per_mm = std::max(size_px.x / sheet_width_mm, style.min_px / smallest_mm),
          .style = std::move(style),
          .labels = {}};
}

std::vector<double> find_skyline(const GeoMap& map, glm::ivec2 size_px) {
  std::vector<double> skyline(static_cast<std::size_t>(size_px.x));
  parallel_ranges<int>(size_px.x, 16, [&](int begin, int end) {
    for (int x = begin; x < end; ++x) {
      double sky = 0.0;
      double land = size_px.y;
      if (map.to_geo({x + .5, 0.0})) land = 0.0;
      while (land - sky > .25) {
        const double centre = .5 * (sky + land);
        (map.to_geo({x + .5, centre}) ? land : sky) = centre;
      }
      skyline[static_cast<std::size_t>(x)] = land;
    }
  });
  return skyline;
}

LabelSheet make_labels(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks,
                       const std::vector<double>& skyline_px, LabelStyle style, glm::ivec2 size_px,
                       double sheet_width_mm, const std::vector<std::vector<glm::dvec2>>& lines) {
  if (marks.size() != points.size())
    throw Error(ErrorKind::bug, "labels",
                fmt::format("{} marks of {} points", marks.size(), points.size()));
  LabelSheet sheet = empty_label_sheet(std::move(style), size_px, sheet_width_mm);
  const TextMeasure measure;
  std::vector<LabelRequest> requests;
  std::vector<std::size_t> asks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LabelKindStyle& kind = sheet.style.kinds[static_cast<std::size_t>(points[i].kind)];
    Label label;
    label.point = points[i];
    label.mark = marks[i];
    label.text = set_text(points[i], marks[i], kind);
    TextStyle type = text_style(kind, sheet.px_per_mm);
    label.spacing = type.spacing = spacing_of(kind, label.text);
    label.room = measure.measure(label.text, type);
    label.hidden_by = hiding_name(points, marks, i);
    if (label.mark.state == MarkState::seen && !label.text.empty()) {
      asks.push_back(i);
      std::vector<BentRoom> bent;
      const bool follows = i < lines.size() && lines[i].size() > 1;
      if (follows) bent = bent_rooms(label, kind, type, lines[i], measure);
      requests.push_back({.mark = label.mark.pixel,
                          .mark_px = follows || kind.mark == LabelMarkShape::none
                                         ? 0.0
                                         : kind.mark_mm * sheet.px_per_mm,
                          .width_px = label.room.width_px + 2.0 * end_room * type.size_px,
                          .height_px = label.room.up_px + label.room.down_px,
                          .position = kind.position,
                          .on_skyline = label.mark.on_skyline,
                          .rank = label.point.rank,
                          .bent = std::move(bent)});
    }
    sheet.labels.push_back(std::move(label));
  }
  const std::vector<LabelSpot> spots = place_labels(requests, skyline_px, layout_parameters(sheet));
  for (std::size_t k = 0; k < asks.size(); ++k) sheet.labels[asks[k]].spot = spots[k];
  return sheet;
}

}  // namespace belvedere
