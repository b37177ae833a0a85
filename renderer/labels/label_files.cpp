#include "renderer/labels/label_files.h"

#include <fmt/format.h>

#include <cmath>

#include "base/error.h"
#include "base/json.h"
#include "base/text/markup.h"
#include "terrain/io/crs.h"

namespace belvedere {
namespace {

// A hundredth of a pixel is finer than any printer, and the same text on every machine.
std::string px(double value) { return fmt::format("{:.2f}", value == 0.0 ? 0.0 : value); }

std::string mark_svg(const LabelKindStyle& kind, glm::dvec2 at, double across) {
  const double r = .5 * across;
  switch (kind.mark) {
    case LabelMarkShape::none:
      return {};
    case LabelMarkShape::dot:
      return fmt::format(R"(<circle cx="{}" cy="{}" r="{}"/>)", px(at.x), px(at.y), px(r));
    case LabelMarkShape::ring:
      return fmt::format(R"(<circle cx="{}" cy="{}" r="{}" fill="{}" stroke="{}" stroke-width="{}"/>)", px(at.x), px(at.y), px(.7 * r),
                         kind.halo, kind.colour, px(.6 * r));
    case LabelMarkShape::square:
      return fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}"/>)", px(at.x - r), px(at.y - r), px(across), px(across));
    case LabelMarkShape::triangle:  // its tip on the summit
      return fmt::format(R"(<path d="M{} {}L{} {}L{} {}Z"/>)", px(at.x), px(at.y - r), px(at.x + r), px(at.y + .8 * r), px(at.x - r),
                         px(at.y + .8 * r));
  }
  return {};
}

std::string label_svg(const LabelSheet& sheet, const Label& label) {
  const LabelKindStyle& kind = sheet.kind_of(label);
  const LabelBox& box = label.spot.text;
  std::string out;
  if (label.spot.has_leader)
    out += fmt::format(R"(    <line x1="{0}" y1="{1}" x2="{0}" y2="{2}" stroke="{3}" stroke-width="{4}"/>)"
                       "\n",
                       px(label.mark.pixel.x), px(label.spot.leader_top_px), px(label.mark.pixel.y - .5 * kind.mark_mm * sheet.px_per_mm),
                       sheet.style.leader, px(sheet.style.leader_mm * sheet.px_per_mm));
  if (const std::string mark = mark_svg(kind, label.mark.pixel, kind.mark_mm * sheet.px_per_mm); !mark.empty()) out += "    " + mark + '\n';
  out += fmt::format("    <text x=\"{}\" y=\"{}\">{}</text>\n", px(.5 * (box.left + box.right)), px(box.top + label.room.up_px),
                     markup_text(label.text));
  return out;
}

// Seen pieces with a light edge, hidden ones dashed and thinner.
std::string tracks_svg(const LabelSheet& sheet) {
  const TrackStyle& style = sheet.style.track;
  const double width = style.width_mm * sheet.px_per_mm;
  std::string edges;
  std::string hidden;
  std::string seen;
  for (const Track& track : sheet.tracks)
    for (const TrackRun& run : track.runs) {
      std::string path = "M";
      for (const glm::dvec2 p : run.pixels) path += (path.size() > 1 ? "L" : "") + px(p.x) + ' ' + px(p.y);
      (run.seen ? seen : hidden) += "    <path d=\"" + path + "\"/>\n";
      if (run.seen) edges += "    <path d=\"" + path + "\"/>\n";
    }
  const auto group = [&](const char* id, const std::string& colour, double width_px, const std::string& more, const std::string& paths) {
    if (paths.empty()) return std::string();
    return fmt::format(
        "  <g id=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"{}>\n{}  </g>\n",
        id, colour, px(width_px), more, paths);
  };
  return group("tracks-hidden", style.colour, .6 * width, fmt::format(" stroke-dasharray=\"{} {}\"", px(1.5 * width), px(2.0 * width)),
               hidden) +
         group("tracks-edge", style.halo, width + 2.0 * style.halo_mm * sheet.px_per_mm, "", edges) +
         group("tracks", style.colour, width, "", seen);
}

std::string quoted_csv(const std::string& text) {
  if (text.find_first_of(",\"\n\r;") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

std::string number_or_nothing(double value, int digits) {
  return std::isnan(value) ? std::string() : fmt::format("{:.{}f}", value, digits);
}

// Whether and where it came into the picture: "placed", "no room", or why it is not seen.
std::string outcome(const Label& label) {
  if (label.mark.state != MarkState::seen) return std::string(name_of(label.mark.state));
  return label.spot.placed ? "placed" : "no room";
}

bool has_pixel(const Label& label) { return label.mark.state != MarkState::outside_terrain && label.mark.state != MarkState::behind_eye; }

}  // namespace

std::string labels_svg(const LabelSheet& sheet, const std::string& under) {
  const double height_mm = sheet.sheet_width_mm * sheet.size_px.y / sheet.size_px.x;
  std::string out = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="{:.3f}mm" height="{:.3f}mm" viewBox="0 0 {} {}">
)",
      sheet.sheet_width_mm, height_mm, sheet.size_px.x, sheet.size_px.y);
  if (!under.empty())
    out += fmt::format("  <image xlink:href=\"{}\" x=\"0\" y=\"0\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\"/>\n",
                       markup_text(under), sheet.size_px.x, sheet.size_px.y);
  out += tracks_svg(sheet);
  for (std::size_t k = 0; k < sheet.style.kinds.size(); ++k) {
    const LabelKindStyle& kind = sheet.style.kinds[k];
    std::string group;
    for (const Label& label : sheet.labels)
      if (label.spot.placed && label.point.kind == static_cast<int>(k)) group += label_svg(sheet, label);
    if (group.empty()) continue;
    const TextStyle type = text_style(kind, sheet.px_per_mm);
    // The halo is the letters' own outline, painted before them: SVG 2, which browsers, Inkscape and librsvg know.
    out += fmt::format(
        "  <g id=\"{}\" fill=\"{}\" font-family=\"{}\" font-size=\"{}px\"{}{}{} text-anchor=\"middle\">\n"
        "  <style>#{} text {{ paint-order: stroke; stroke: {}; stroke-width: {}px; stroke-linejoin: round; }}</style>\n",
        markup_text(kind.name), kind.colour, markup_text(kind.family), px(type.size_px), kind.bold ? " font-weight=\"bold\"" : "",
        kind.italic ? " font-style=\"italic\"" : "",
        kind.spacing > 0.0 ? fmt::format(" letter-spacing=\"{}px\"", px(kind.spacing * type.size_px)) : "", markup_text(kind.name),
        kind.halo, px(2.0 * kind.halo_mm * sheet.px_per_mm));
    out += group + "  </g>\n";
  }
  return out + "</svg>\n";
}

std::string labels_csv(const LabelSheet& sheet) {
  std::string out =
      "name,kind,rank,outcome,x_px,y_px,distance_m,altitude_file_m,altitude_dem_m,east,north,drawn_east,drawn_north,hidden_by,where\n";
  for (const Label& label : sheet.labels) {
    const LabelMark& mark = label.mark;
    out += fmt::format("{},{},{:g},{},{},{},{},{},{},{:.2f},{:.2f},{:.2f},{:.2f},{},{}\n", quoted_csv(label.point.name),
                       quoted_csv(sheet.kind_of(label).name), label.point.rank, outcome(label), has_pixel(label) ? px(mark.pixel.x) : "",
                       has_pixel(label) ? px(mark.pixel.y) : "", has_pixel(label) ? fmt::format("{:.0f}", mark.distance_m) : "",
                       number_or_nothing(label.point.altitude_m.value_or(NAN), 1), number_or_nothing(mark.dem_altitude_m, 1),
                       label.point.place.x, label.point.place.y, mark.drawn_place.x, mark.drawn_place.y, quoted_csv(label.hidden_by),
                       quoted_csv(label.point.where));
  }
  return out;
}

std::string labels_geojson(const LabelSheet& sheet, const std::string& crs) {
  if (crs.empty()) throw Error(ErrorKind::usage, "labels.geojson", "the terrain has no CRS", "terrain that says its CRS");
  std::vector<glm::dvec2> places;
  for (const Label& label : sheet.labels) places.push_back(label.mark.drawn_place);
  PointTransform(crs, "EPSG:4326").apply(places);
  Json features = Json::array();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Label& label = sheet.labels[i];
    Json properties = Json::object()
                          .add("name", Json::text(label.point.name))
                          .add("kind", Json::text(sheet.kind_of(label).name))
                          .add("rank", Json::number(label.point.rank))
                          .add("outcome", Json::text(outcome(label)));
    if (label.point.altitude_m) properties.add("altitude_file_m", Json::number(*label.point.altitude_m));
    if (!std::isnan(label.mark.dem_altitude_m))
      properties.add("altitude_dem_m", Json::number(std::round(10.0 * label.mark.dem_altitude_m) / 10.0));
    if (has_pixel(label))
      properties.add("pixel", Json::array({Json::raw(px(label.mark.pixel.x)), Json::raw(px(label.mark.pixel.y))}))
          .add("distance_m", Json::number(std::round(label.mark.distance_m)));
    if (!label.hidden_by.empty()) properties.add("hidden_by", Json::text(label.hidden_by));
    const bool on_earth = std::isfinite(places[i].x) && std::isfinite(places[i].y);
    Json geometry = Json::raw("null");
    if (on_earth)
      geometry = Json::object()
                     .add("type", Json::text("Point"))
                     .add("coordinates",
                          Json::array({Json::raw(fmt::format("{:.7f}", places[i].x)), Json::raw(fmt::format("{:.7f}", places[i].y))}));
    features.add(
        Json::object().add("type", Json::text("Feature")).add("geometry", std::move(geometry)).add("properties", std::move(properties)));
  }
  return Json::object().add("type", Json::text("FeatureCollection")).add("features", std::move(features)).str() + "\n";
}

}  // namespace belvedere
