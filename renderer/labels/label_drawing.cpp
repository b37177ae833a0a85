#include "renderer/labels/label_drawing.h"

#include <iterator>
#include <utility>

namespace belvedere {
namespace {

void draw_mark(const LabelKindStyle& kind, glm::dvec2 at, double across,
               std::vector<DrawnShape>& shapes) {
  const double r = .5 * across;
  const auto polygon = [&](std::vector<glm::dvec2> points) {
    shapes.push_back(
        DrawnPath{.points = std::move(points), .closed = true, .fill = kind.colour, .stroke = {}});
  };
  switch (kind.mark) {
    case LabelMarkShape::none:
      break;
    case LabelMarkShape::dot:
      shapes.push_back(
          DrawnCircle{.centre = at, .radius_px = r, .fill = kind.colour, .stroke = {}});
      break;
    case LabelMarkShape::ring:
      shapes.push_back(DrawnCircle{.centre = at,
                                   .radius_px = .7 * r,
                                   .fill = kind.halo,
                                   .stroke = kind.colour,
                                   .width_px = .6 * r});
      break;
    case LabelMarkShape::square:
      polygon({at + glm::dvec2(-r, -r), at + glm::dvec2(r, -r), at + glm::dvec2(r, r),
               at + glm::dvec2(-r, r)});
      break;
    case LabelMarkShape::triangle:  // its tip on the summit
      polygon({at + glm::dvec2(0, -r), at + glm::dvec2(r, .8 * r), at + glm::dvec2(-r, .8 * r)});
      break;
  }
}

DrawnText draw_name(const LabelSheet& sheet, const Label& label) {
  const LabelKindStyle& kind = sheet.kind_of(label);
  const LabelBox& box = label.spot.text;
  return {.text = label.text,
          .type = sheet.type_of(label),
          .at = {.5 * (box.left + box.right), box.top + label.room.up_px},
          .anchor = .5,
          .colour = kind.colour,
          .halo = kind.halo,
          .halo_px = kind.halo_mm * sheet.px_per_mm,
          .along = label.spot.baseline};
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
      if (label.spot.baseline.empty())
        draw_mark(kind, label.mark.pixel, kind.mark_mm * sheet.px_per_mm, group.shapes);
      group.shapes.push_back(draw_name(sheet, label));
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
