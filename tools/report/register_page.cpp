#include "tools/report/register_page.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/land_cover_class.h"
#include "base/math.h"
#include "base/statistics.h"
#include "tools/report/report.h"
#include "tools/report/report_pictures.h"
#include "tools/report/style_pictures.h"

namespace belvedere::tools {
namespace {

constexpr double far_off_sigmas = 4.0;

std::string near_by(std::size_t count) {
  return count == 1 ? "one pair near by" : fmt::format("{} pairs near by", count);
}

double focal_px(const Registration& found) {
  return found.scale * std::exp(found.view[view_unknown::log_focal]);
}

glm::dvec2 eye_of(const Registration& found) {
  return found.frame.origin + found.frame.extent_m * glm::dvec2(found.view[view_unknown::east],
                                                                found.view[view_unknown::north]);
}

std::vector<double> kept_distances_px(const Registration& found) {
  std::vector<double> out;
  for (const PairFinding& finding : found.findings)
    if (!finding.wrong) out.push_back(finding.others_px);
  return out;
}

// A ring about a pixel.
void draw_ring(Grid<glm::vec3>& picture, glm::dvec2 at, glm::vec3 colour) {
  constexpr int reach = 7;
  const int x0 = static_cast<int>(std::floor(at.x)), y0 = static_cast<int>(std::floor(at.y));
  for (int y = y0 - reach; y <= y0 + reach; ++y)
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      if (x < 0 || y < 0 || x >= picture.width() || y >= picture.height()) continue;
      const double off = std::abs(std::hypot(x + 0.5 - at.x, y + 0.5 - at.y) - 4.5);
      const double cover = std::clamp(2.0 - off, 0.0, 1.0);
      picture(x, y) = glm::mix(picture(x, y), colour, static_cast<float>(cover));
    }
}

Grid<glm::vec3> with_pairs(Grid<glm::vec3> picture, const RegisterReportInput& input) {
  const double scale =
      picture.width() / (input.registration.frame.size_px.x * input.registration.scale);
  for (std::size_t i = 0; i < input.pairs.size(); ++i) {
    const PairFinding& finding = input.registration.findings[i];
    draw_ring(picture, scale * input.pairs[i].pixel,
              finding.wrong     ? glm::vec3(0.9F, 0.05F, 0.1F)
              : finding.doubted ? glm::vec3(1.F, 0.55F, 0.F)
                                : glm::vec3(0.1F, 0.75F, 0.25F));
  }
  return picture;
}

// A line from one position to another, `reach` px to both sides.
void draw_line(Grid<glm::vec3>& picture, glm::dvec2 from, glm::dvec2 to, glm::vec3 colour,
               double reach) {
  const auto clamped = [](double value, int size) {
    return std::clamp(static_cast<int>(std::lround(value)), 0, size - 1);
  };
  const double margin = reach + 1.0;
  const glm::dvec2 along = to - from;
  const double square = std::max(glm::dot(along, along), 1e-9);
  for (int y = clamped(std::min(from.y, to.y) - margin, picture.height());
       y <= clamped(std::max(from.y, to.y) + margin, picture.height()); ++y)
    for (int x = clamped(std::min(from.x, to.x) - margin, picture.width());
         x <= clamped(std::max(from.x, to.x) + margin, picture.width()); ++x) {
      const glm::dvec2 at(x + 0.5, y + 0.5);
      const double share = std::clamp(glm::dot(at - from, along) / square, 0.0, 1.0);
      const double off = glm::length(at - from - share * along);
      const double cover = std::clamp(reach + 0.5 - off, 0.0, 1.0);
      picture(x, y) = glm::mix(picture(x, y), colour, static_cast<float>(cover));
    }
}

// The way of the light over the ground, in the picture: to the right, and up where it goes away
// from the viewer.
void draw_light(Grid<glm::vec3>& picture, glm::dvec2 centre, double length, const SunEstimate& sun,
                double bearing_deg) {
  const double angle = to_radians(sun.azimuth_deg - bearing_deg);
  const glm::dvec2 way(-std::sin(angle), std::cos(angle)), side(-way.y, way.x);
  const glm::dvec2 tip = centre + 0.5 * length * way, end = centre - 0.5 * length * way;
  const bool sure = sun.trusted();
  const double reach = std::max(1.0, 0.035 * length);
  for (const bool outline : {true, false}) {
    const glm::vec3 colour = outline ? glm::vec3(0.05F)
                             : sure  ? glm::vec3(1.F, 0.85F, 0.1F)
                                     : glm::vec3(0.6F);
    const double wide = (sure ? reach : 0.5 * reach) + (outline ? 1.0 : 0.0);
    draw_line(picture, end, tip, colour, wide);
    for (const double turned : {1.0, -1.0})
      draw_line(picture, tip, tip - 0.25 * length * (way + 0.6 * turned * side), colour, wide);
  }
}

Grid<glm::vec3> with_light(Grid<glm::vec3> picture, const RegisteredLight& light) {
  const int columns = light.regions.width(), rows = light.regions.height();
  const double length = 0.5 * std::min(picture.width() / columns, picture.height() / rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const RegisteredRegion& region = light.regions(column, row);
      if (region.sun.pixels == 0) continue;
      draw_light(
          picture,
          {(column + 0.5) * picture.width() / columns, (row + 0.5) * picture.height() / rows},
          length, region.sun, region.bearing_deg);
    }
  return picture;
}

Json sun_json(const SunEstimate& sun) {
  return Json::object()
      .add("azimuth_deg", known(sun.azimuth_deg))
      .add("altitude_deg", known(sun.altitude_deg))
      .add("explained", known(sun.explained))
      .add("trust", known(sun.trust()))
      .add("trusted", Json::boolean(sun.trusted()));
}

Json light_json(const RegisteredLight& light) {
  Json regions = Json::array();
  for (const RegisteredRegion& region : light.regions) regions.add(sun_json(region.sun));
  return Json::object().add("whole", sun_json(light.sun)).add("regions", std::move(regions));
}

Json cover_json(const RegisteredCover& cover) {
  const auto line = [](double altitude_m) {
    return known(altitude_m > 0.0 ? altitude_m : std::numeric_limits<double>::quiet_NaN());
  };
  return Json::object()
      .add("treeline_m", line(cover.lines.treeline_m))
      .add("snowline_m", line(cover.lines.snowline_m))
      .add("ice_line_m", line(cover.lines.ice_line_m))
      .add("winter", Json::boolean(cover.lines.winter))
      .add("treeline_by_climate_m", line(cover.climate.treeline_m))
      .add("snowline_by_climate_m", line(cover.climate.snowline_m))
      .add("ice_line_by_climate_m", line(cover.climate.ice_line_m));
}

// Their shares of the ground.
ReportTable table_of_classes(const Grid<std::uint8_t>& classes) {
  ReportTable table({{"colour", ""}, {"class", "class"}, {"share", "share of the ground", ".1%"}});
  std::array<std::size_t, land_cover_table.size()> count{};
  std::size_t ground = 0;
  for (const std::uint8_t id : classes) {
    if (id >= count.size() || static_cast<LandCoverClass>(id) == LandCoverClass::sky) continue;
    ++count[id];
    ++ground;
  }
  const std::vector<std::array<std::uint8_t, 3>> colours = class_map_colours();
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const auto id = static_cast<std::size_t>(info.id);
    if (count[id] == 0) continue;
    const auto& [red, green, blue] = colours[id];
    table.row(swatch(glm::vec3(red, green, blue) / 255.F), std::string(info.name),
              static_cast<double>(count[id]) / static_cast<double>(ground));
  }
  return table;
}

std::string summary_of(const RegisterReportInput& input) {
  const Registration& found = input.registration;
  const auto wrong = std::count_if(found.findings.begin(), found.findings.end(),
                                   [](const PairFinding& f) { return f.wrong; });
  return fmt::format(
      "{} pairs, {} thrown out; each of the others lies {:.1f} px from where the rest say it is, "
      "at the median. {} The painting is as if seen in a {} view.",
      found.findings.size(), wrong, median(kept_distances_px(found)),
      input.painted_places == 0
          ? "They alone are fitted, not the paint."
          : fmt::format("{} patches of ground that were found in the paint are fitted with them.",
                        input.painted_places),
      view_kind_name(found.frame.kind));
}

// Describes how the painter changed the ground besides moving it.
std::string ground_words(const Registration& found) {
  std::string out;
  if (found.valleys_m > 0.0)
    out = fmt::format(" Large valleys are some {:.0f} m wider than on the map.", found.valleys_m);
  if (found.held_back == 0) return out;
  return out + fmt::format(" {} count{} for less, because the ground would fold over itself.",
                           found.held_back == 1
                               ? "One pair or patch"
                               : fmt::format("{} pairs or patches", found.held_back),
                           found.held_back == 1 ? "s" : "");
}

Json mountains_json(const Registration& found) {
  Json out = Json::array();
  for (const DeformHandle& handle : handles_of(found.mountains))
    out.add(Json::object()
                .add("position", Json::array({known(handle.centre.x), known(handle.centre.y)}))
                .add("radius_m", known(handle.radius_m))
                .add("move_m", Json::array({known(handle.move_m.x), known(handle.move_m.y)}))
                .add("rotate_deg", known(handle.rotate_deg))
                .add("raise_m", known(handle.raise_m)));
  return out;
}

ReportTable table_of_mountains(const Registration& found) {
  ReportTable table({{"east_m", "east", ".0f", "Of its centre"},
                     {"north_m", "north", ".0f"},
                     {"radius_m", "radius, m", ".0f", "Ground beyond it stays"},
                     {"move_east_m", "moved east, m", ".0f"},
                     {"move_north_m", "moved north, m", ".0f"},
                     {"rotate_deg", "turned, °", ".0f", "Clockwise, seen from above"},
                     {"raise_m", "raised, m", ".0f", "Before exaggeration"}});
  for (const DeformHandle& handle : handles_of(found.mountains))
    table.row(handle.centre.x, handle.centre.y, handle.radius_m, handle.move_m.x, handle.move_m.y,
              handle.rotate_deg, handle.raise_m);
  return table;
}

ReportTable table_of_pairs(const RegisterReportInput& input) {
  ReportTable table({{"line", "line", "", "Line of the table of pairs"},
                     {"name", "name"},
                     {"x_px", "x", ".0f"},
                     {"y_px", "y", ".0f"},
                     {"others_px", "off, px", ".1f", "From where all other pairs say that it is"},
                     {"deviations", "deviations", ".1f",
                      "The same in standard deviations, as if this pair alone said that its ground "
                      "was moved; more than 5 is wrong"},
                     {"view_px", "view, px", ".1f", "From the view alone: what the painter moved"},
                     {"verdict", "verdict"},
                     {"words", "in words"}});
  for (const std::size_t i : pairs_worst_first(input.registration)) {
    const PairFinding& finding = input.registration.findings[i];
    const PairWords words = pair_words(finding, input.registration.sigma_px);
    table.row(input.pairs[i].line, input.pairs[i].name, input.pairs[i].pixel.x,
              input.pairs[i].pixel.y, finding.others_px, finding.deviations, finding.view_px,
              words.verdict, words.sentence);
  }
  return table;
}

}  // namespace

PairWords pair_words(const PairFinding& finding, double sigma_px) {
  const bool moved = finding.view_px > far_off_sigmas * sigma_px;
  const std::string others = near_by(finding.near_by);
  if (finding.wrong && finding.near_by == 0)
    return {
        "thrown out",
        "this pair says that its ground was moved, none near by confirms it: wrong, or give two "
        "more pairs there"};
  if (finding.wrong)
    return {"thrown out", fmt::format("{} {} otherwise: wrong, most likely", others,
                                      finding.near_by == 1 ? "says" : "say")};
  if (finding.doubted)
    return {"doubtful", finding.would_fold
                            ? "as far off as a wrong pair, but sure: kept, as far as "
                              "the ground does not fold"
                            : "as far off as a wrong pair, but sure: kept"};
  if (finding.would_fold)
    return {"held back",
            "counts for less, because the ground would fold between it and the pairs near by"};
  if (moved && finding.others_px > far_off_sigmas * sigma_px)
    return {"moved",
            finding.near_by == 0
                ? "its ground seems moved, and no pair near by confirms it: two more pairs "
                  "there would tell how"
                : fmt::format("its ground was moved, and {} {} not tell exactly how: one "
                              "more pair there would",
                              others, finding.near_by == 1 ? "does" : "do")};
  if (moved) return {"moved", "its ground was moved, as other pairs say too"};
  return {"fits", "lies where the others say"};
}

std::string cover_words(const RegisteredCover& cover) {
  const auto line = [](const char* what, const char* is, double painted_m, double usual_m) {
    if (painted_m <= 0.0)
      return fmt::format(
          " The paint does not tell where {} {}: by the climate of the place at "
          "{:.0f} m.",
          what, is, usual_m);
    return fmt::format(" Here {} {} at {:.0f} m, by the climate of the place at {:.0f} m.", what,
                       is, painted_m, usual_m);
  };
  const PainterLines& lines = cover.lines;
  return fmt::format(
      "The class of each pixel, by class rules with the painter's own lines and by "
      "the colour of the paint (classes.png).{}{}{}",
      line("forest", "ends", lines.treeline_m, cover.climate.treeline_m),
      lines.winter ? " It is winter: snow lies on everything but forest and steep "
                     "rock."
                   : line("snow", "begins", lines.snowline_m, cover.climate.snowline_m),
      lines.ice_line_m > 0.0 ? line("glaciers", "form", lines.ice_line_m, cover.climate.ice_line_m)
                             : std::string());
}

std::string light_words(const RegisteredLight& light) {
  constexpr std::array<const char*, 8> sides = {"behind the mountains",
                                                "behind the mountains, right",
                                                "the right",
                                                "the viewer's right",
                                                "behind the viewer",
                                                "the viewer's left",
                                                "the left",
                                                "behind the mountains, left"};
  if (!light.sun.trusted())
    return "The paint does not tell where the sun stands: the scene keeps the usual one.";
  const double turned = light.sun.azimuth_deg - light.bearing_deg;
  const auto side = static_cast<std::size_t>(std::lround(turned / 45.0) + 16) % sides.size();
  const std::size_t other = regions_of_other_light(light).size();
  return fmt::format(
      "The light comes from {}: azimuth {:.0f}°, {:.0f}° high. It explains {:.0f} % of the "
      "lightness within classes, {:.0f} % more than light from elsewhere would. {}",
      sides[side], light.sun.azimuth_deg, light.sun.altitude_deg, 100.0 * light.sun.explained,
      100.0 * light.sun.trust(),
      other == 0   ? "All parts of the picture agree, or do not tell."
      : other == 1 ? "One part of the picture has light from elsewhere, which the scene takes over."
                   : fmt::format("{} parts of the picture have light from elsewhere, which the "
                                 "scene takes over.",
                                 other));
}

std::vector<std::size_t> pairs_worst_first(const Registration& registration) {
  const std::vector<PairFinding>& findings = registration.findings;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < findings.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (findings[a].wrong != findings[b].wrong) return findings[a].wrong;
    return findings[a].deviations > findings[b].deviations;
  });
  return order;
}

Json registration_json(const RegisterReportInput& input) {
  const Registration& found = input.registration;
  const glm::dvec2 eye = eye_of(found);
  Json kinds = Json::array();
  for (const FittedView& kind : found.kinds)
    kinds.add(Json::object()
                  .add("projection", Json::text(view_kind_name(kind.frame.kind)))
                  .add("cost", known(kind.cost))
                  .add("median_px", known(found.scale * kind.median_px)));
  Json pairs = Json::array();
  for (std::size_t i = 0; i < input.pairs.size(); ++i) {
    const PairFinding& finding = found.findings[i];
    pairs.add(Json::object()
                  .add("line", Json::number(input.pairs[i].line))
                  .add("name", Json::text(input.pairs[i].name))
                  .add("wrong", Json::boolean(finding.wrong))
                  .add("others_px", known(finding.others_px))
                  .add("deviations", known(finding.deviations))
                  .add("view_px", known(finding.view_px))
                  .add("words", Json::text(pair_words(finding, found.sigma_px).sentence)));
  }
  return Json::object()
      .add("projection", Json::text(view_kind_name(found.frame.kind)))
      .add("eye", Json::array({known(eye.x), known(eye.y)}))
      .add("azimuth_deg", known(to_degrees(found.view[view_unknown::azimuth])))
      .add("focal_px", known(focal_px(found)))
      .add("sigma_px", known(found.sigma_px))
      .add("others_px", known(median(kept_distances_px(found))))
      .add("painted_places", Json::number(static_cast<double>(input.painted_places)))
      .add("mountains", mountains_json(found))
      .add("valleys_m", known(found.valleys_m))
      .add("held_back", Json::number(static_cast<double>(found.held_back)))
      .add("folded", Json::number(static_cast<double>(input.ground.folded)))
      .add("light", light_json(input.light))
      .add("land_cover", cover_json(input.cover))
      .add("kinds", std::move(kinds))
      .add("pairs", std::move(pairs));
}

void write_register_report(const std::string& folder, const RegisterReportInput& input) {
  Report page(folder);
  const double step_m = contour_step_m(input.ground.altitude_m);
  page.section(
      "contours", "The terrain over the painting",
      fmt::format("Contours every {0:.0f} m in black, every {1:.0f} m in white; the "
                  "terrain's skyline in red, other silhouettes in yellow. Pairs that were "
                  "kept in green, thrown out in red, kept because they are sure in orange.",
                  step_m, 5.0 * step_m));
  page.compare("painting", input.picture, "registered",
               with_pairs(contours_over(input.picture, input.ground, step_m), input));
  if (input.ground.folded > 0)
    page.text(
        fmt::format("{} facets of the ground in the picture are turned over: pairs that are "
                    "near each other move it unlike.",
                    input.ground.folded));
  page.section("pairs", "Pairs, worst first", summary_of(input) + ground_words(input.registration));
  page.table(table_of_pairs(input));
  if (!input.registration.mountains.empty()) {
    page.section(
        "mountains", "Mountains that were moved as a whole",
        "Ground moved away from the viewer and ground that is raised look nearly alike, so "
        "these two are less sure than their sum.");
    page.table(table_of_mountains(input.registration));
  }
  if (!input.classes.empty()) {
    page.section("land_cover", "Land cover", cover_words(input.cover));
    page.table(table_of_classes(input.classes));
    page.compare("painting", input.picture, "land_cover", class_picture(input.classes));
  }
  page.section("light", "Light",
               light_words(input.light) +
                   " Arrows go the way of the light over the ground, up away from the viewer; grey "
                   "ones are not trusted.");
  page.picture("light", with_light(input.picture, input.light), "light of each part");
  page.section(
      "trust", "Trust",
      fmt::format("How far the place of a pixel may be off: pale 0, dark red {:.0f} px and "
                  "more. The less a place is known, the less altitude, distance and slope guide "
                  "what is copied from it (trust.png).",
                  trusted_px * input.registration.scale));
  page.picture("trust_map",
               trust_picture(input.ground.sigma_px, trusted_px * input.registration.scale),
               "standard deviation of places");
  page.write({.title = "Registration of " + input.painting,
              .lead = summary_of(input),
              .command = input.command,
              .data = registration_json(input)});
}

}  // namespace belvedere::tools
