#include "renderer/labels/label_drawing.h"

#include <iterator>
#include <utility>

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

void draw_tracks(const LabelSheet& sheet, std::vector<DrawnGroup>& groups) {
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
}

}  // namespace

std::vector<DrawnGroup> draw_labels(const LabelSheet& sheet) {
  std::vector<DrawnGroup> groups;
  draw_tracks(sheet, groups);
  DrawnGroup leaders{"leaders", {}};
  for (const Label& label : sheet.labels)
    if (label.spot.placed && label.spot.has_leader) {
      const double foot = label.mark.pixel.y - .5 * sheet.kind_of(label).mark_mm * sheet.px_per_mm;
      leaders.shapes.push_back(DrawnPath{
          .points = {{label.mark.pixel.x, label.spot.leader_top_px}, {label.mark.pixel.x, foot}},
          .fill = {},
          .stroke = sheet.style.leader,
          .width_px = sheet.style.leader_mm * sheet.px_per_mm});
    }
  if (!leaders.shapes.empty()) groups.push_back(std::move(leaders));
  for (std::size_t k = 0; k < sheet.style.kinds.size(); ++k) {
    const LabelKindStyle& kind = sheet.style.kinds[k];
    DrawnGroup group{kind.name, {}};
    for (const Label& label : sheet.labels) {
      if (!label.spot.placed || label.point.kind != static_cast<int>(k)) continue;
      if (kind.position == LabelPlace::on) {
        draw_plate(sheet, label, group.shapes);
        continue;
      }
      if (label.spot.baseline.empty())
        draw_mark(kind, label.mark.pixel, sheet.px_per_mm, group.shapes);
      draw_name(sheet, label, group.shapes);
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

}  // namespace belvedere
