#include "renderer/labels/labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/labels/drawing.h"

namespace belvedere {
namespace {

// Space at both ends of a text, of its type's size, so that names that follow each other in a row
// stay separate.
constexpr double end_room = 0.25;

constexpr double altitude_foot = 0.12;  // below its figures, which have no descenders

// "Run 12b" and "12" are the number 12; without one the name itself.
std::string number_in(const std::string& name) {
  const std::size_t from = name.find_first_of("0123456789");
  if (from == std::string::npos) return name;
  return name.substr(from, name.find_first_not_of("0123456789", from) - from);
}

std::string set_text(const LabelPoint& point, const LabelMark& mark, const LabelKindStyle& kind) {
  if (point.name.empty()) return altitude_text(point, mark);
  if (kind.position == LabelPlace::on) return number_in(point.name);
  return kind.capitals ? capitals(point.name) : point.name;
}

// Width and height of a name with its altitude.
glm::dvec2 room_of(const LabelSheet& sheet, const Label& label) {
  const glm::dvec2 name(label.room.width_px, label.room.up_px + label.room.down_px);
  if (label.altitude.empty()) return name;
  const double size_px = sheet.altitude_type_of(label).size_px;
  if (sheet.is_stacked(label))
    return {std::max(name.x, label.altitude_room.width_px),
            label.room.up_px + (altitude_lead + altitude_foot) * size_px};
  return {name.x + altitude_gap * size_px + label.altitude_room.width_px, name.y};
}

// Width and height of the disc or tile of a number, px: a disc for two figures.
glm::dvec2 plate_px(const TextRoom& room, const TextStyle& type) {
  const double figures = 1.25 * type.size_px;
  const double side =
      std::max(1.55 * type.size_px, std::min(room.width_px, figures) + .6 * type.size_px);
  return {side + std::max(0.0, room.width_px - figures), side};
}

// The line of a cable between the ends of its line on the ground: straight, or over the ground
// where that rises higher in the picture.
std::vector<glm::dvec2> cable_over(const std::vector<glm::dvec2>& line) {
  constexpr int steps = 32;
  const double length = length_of(line);
  std::vector<glm::dvec2> cable;
  for (int k = 0; k <= steps; ++k) {
    const double share = static_cast<double>(k) / steps;
    const glm::dvec2 ground = point_at(line, share * length);
    const glm::dvec2 straight = glm::mix(line.front(), line.back(), share);
    cable.push_back(ground.y < straight.y ? ground : straight);
  }
  return cable;
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

void shift(BentRoom& room, glm::dvec2 by) {
  for (glm::dvec2& point : room.baseline) point += by;
  for (LabelBox& letter : room.letters)
    letter = {letter.left + by.x, letter.top + by.y, letter.right + by.x, letter.bottom + by.y};
}

constexpr double dm2_radius_mm = 56.419;  // of a circle of 1 dm²

LabelLayoutParameters layout_parameters(const LabelSheet& sheet) {
  const double scale = sheet.px_per_mm;
  return {.width_px = sheet.size_px.x,
          .height_px = sheet.size_px.y,
          .margin_px = sheet.style.margin_mm * scale,
          .clearance_px = sheet.style.clearance_mm * scale,
          .gap_px = sheet.style.gap_mm * scale,
          .row_px = sheet.style.row_mm * scale,
          .longest_leader_px = sheet.style.longest_leader_mm * scale,
          .ground_leader_px = sheet.style.ground_leader_mm * scale,
          .crowd = sheet.style.names_per_dm2,
          .crowd_radius_px = dm2_radius_mm * scale};
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

TextStyle text_style(const LabelKindStyle& kind, double px_per_mm, double rank) {
  return {.family = kind.family,
          .size_px = kind.size_mm * (1.0 + kind.rank_step * (5.0 - rank)) * px_per_mm,
          .weight = kind.weight,
          .italic = kind.italic,
          .spacing = kind.spacing};
}

TextStyle LabelSheet::type_of(const Label& label) const {
  TextStyle type = text_style(kind_of(label), px_per_mm, label.point.rank);
  type.spacing = label.spacing;
  return type;
}

TextStyle LabelSheet::altitude_type_of(const Label& label) const {
  return {.family = style.altitude.family,
          .size_px =
              style.altitude.size * text_style(kind_of(label), px_per_mm, label.point.rank).size_px,
          .weight = style.altitude.weight};
}

void require_fonts(const LabelStyle& style) {
  std::set<std::string> missing;
  const auto require = [&](const std::string& families) {
    if (!TextMeasure::has_family(families)) missing.insert(families);
  };
  for (const LabelKindStyle& kind : style.kinds) require(kind.family);
  require(style.altitude.family);
  require(style.margin.family);
  require(style.margin.heading);
  if (!missing.empty())
    throw Error(ErrorKind::input, fmt::format("the fonts of the style {}", style.name),
                fmt::format("not installed: {}", fmt::join(missing, "; ")),
                "Debian's packages fonts-ebgaramond and fonts-lato for the style classic, or a "
                "style that names installed fonts");
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

void choose_inks(LabelSheet& sheet, const Grid<float>& luminance) {
  const glm::dvec2 scale =
      glm::dvec2(luminance.width(), luminance.height()) / glm::dvec2(sheet.size_px);
  for (Label& label : sheet.labels) {
    if (!label.spot.placed) continue;
    const LabelBox& box = label.spot.text;
    const glm::ivec2 low(scale * glm::dvec2(box.left, box.top));
    const glm::ivec2 high = glm::ivec2(scale * glm::dvec2(box.right, box.bottom)) + 1;
    double sum = 0.0;
    int count = 0;
    for (int y = std::max(0, low.y); y < std::min(luminance.height(), high.y); ++y)
      for (int x = std::max(0, low.x); x < std::min(luminance.width(), high.x); ++x, ++count)
        sum += static_cast<double>(luminance(x, y));
    label.on_dark = count > 0 && sum < sheet.kind_of(label).light_below * count;
  }
}

LabelSheet make_labels(const std::vector<LabelPoint>& points, const std::vector<LabelMark>& marks,
                       const std::vector<double>& skyline_px, LabelStyle style, glm::ivec2 size_px,
                       double sheet_width_mm, const std::vector<std::vector<glm::dvec2>>& lines) {
  if (marks.size() != points.size())
    throw Error(ErrorKind::bug, "labels",
                fmt::format("{} marks of {} points", marks.size(), points.size()));
  require_fonts(style);
  LabelSheet sheet = empty_label_sheet(std::move(style), size_px, sheet_width_mm);
  const TextMeasure measure;
  std::vector<LabelRequest> requests;
  std::vector<std::size_t> asks;
  std::vector<std::vector<glm::dvec2>> barriers;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LabelKindStyle& kind = sheet.style.kinds[static_cast<std::size_t>(points[i].kind)];
    const bool follows = i < lines.size() && lines[i].size() > 1;
    Label label;
    label.point = points[i];
    label.mark = marks[i];
    label.text = set_text(points[i], marks[i], kind);
    if (kind.altitude && !points[i].name.empty() && !follows)
      label.altitude = altitude_text(points[i], marks[i]);
    TextStyle type = text_style(kind, sheet.px_per_mm, points[i].rank);
    label.spacing = type.spacing = spacing_of(kind, label.text);
    label.room = measure.measure(label.text, type);
    label.altitude_room = measure.measure(label.altitude, sheet.altitude_type_of(label));
    label.hidden_by = hiding_name(points, marks, i);
    if (kind.barrier && follows) barriers.push_back(lines[i]);
    if (label.mark.state == MarkState::seen && !label.text.empty()) {
      asks.push_back(i);
      LabelRequest request{.mark = label.mark.pixel,
                           .mark_px = follows || kind.mark == LabelMarkShape::none
                                          ? 0.0
                                          : kind.mark_mm * sheet.px_per_mm,
                           .position = kind.position,
                           .on_skyline = label.mark.on_skyline,
                           .rank = label.point.rank};
      if (label.point.by_hand_mm) request.by_hand_px = *label.point.by_hand_mm * sheet.px_per_mm;
      if (kind.position == LabelPlace::on) {
        request.mark_px = 0.0;
        const glm::dvec2 plate = plate_px(label.room, type);
        request.width_px = plate.x;
        request.height_px = plate.y;
        if (follows) request.along = lines[i];
        if (follows && kind.straight) request.along = cable_over(lines[i]);
      } else {
        if (follows) request.bent = bent_rooms(label, kind, type, lines[i], measure);
        if (request.by_hand_px && !request.bent.empty()) {
          request.bent.resize(1);
          shift(request.bent.front(), *request.by_hand_px);
        }
        // A name wider than its water stands beside it.
        if (kind.barrier && kind.position == LabelPlace::over && request.bent.empty() &&
            label.mark.width_px > 0.0 && label.room.width_px > label.mark.width_px) {
          request.position = LabelPlace::beside;
          request.area_px = label.mark.width_px;
        }
        const glm::dvec2 room = room_of(sheet, label);
        request.width_px = room.x + 2.0 * end_room * type.size_px;
        request.height_px = room.y;
      }
      requests.push_back(std::move(request));
    }
    sheet.labels.push_back(std::move(label));
  }
  const std::vector<LabelSpot> spots =
      place_labels(requests, skyline_px, layout_parameters(sheet), barriers);
  for (std::size_t k = 0; k < asks.size(); ++k) sheet.labels[asks[k]].spot = spots[k];
  return sheet;
}

}  // namespace belvedere
