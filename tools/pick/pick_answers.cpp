#include "tools/pick/pick_answers.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/statistics.h"
#include "tools/report/register_page.h"

namespace belvedere::tools {
namespace {

Json rounded(double value, double digits = 10.0) {
  return Json::number(std::round(value * digits) / digits);
}

Json point(glm::dvec2 at, double digits = 10.0) {
  return Json::numbers(
      std::vector{std::round(at.x * digits) / digits, std::round(at.y * digits) / digits});
}

Json index_json(const std::optional<std::size_t>& index) {
  return index ? Json::number(static_cast<double>(*index)) : Json::raw("null");
}

Json tiles_json(const TilePyramid& tiles) {
  return Json::object()
      .add("width", Json::number(tiles.width))
      .add("height", Json::number(tiles.height))
      .add("tilePx", Json::number(tiles.tile_px))
      .add("levels", Json::number(tiles.levels));
}

// [east, north, altitude, prominence]
Json place_numbers(const KnownPlace& place) {
  return Json::numbers(std::vector{std::round(place.position.x), std::round(place.position.y),
                                   std::round(place.altitude_m), std::round(place.prominence_m)});
}

// What is known of each pair once there are enough to judge them.
Json findings_json(const FittedPairs& fit) {
  const Registration& found = fit.registration;
  Json out = Json::array();
  for (std::size_t i = 0; i < fit.pairs.size(); ++i) {
    const ControlPair& pair = fit.pairs[i];
    const PairFinding& finding = found.findings[i];
    const glm::dvec2 shown = registered_pixel(found, fit.field, pair.position, pair.altitude_m);
    const PairWords words = pair_words(finding, found.sigma_px);
    out.add(
        Json::object()
            .add("shown", point(shown))
            .add("residual_px", rounded(std::hypot(shown.x - pair.pixel.x, shown.y - pair.pixel.y)))
            .add("others_px", rounded(finding.others_px))
            .add("deviations", rounded(finding.deviations))
            .add("view_px", rounded(finding.view_px))
            .add("wrong", Json::boolean(finding.wrong))
            .add("doubted", Json::boolean(finding.doubted))
            .add("verdict", Json::text(words.verdict))
            .add("words", Json::text(words.sentence)));
  }
  return out;
}

double median_others_px(const Registration& found) {
  std::vector<double> kept;
  for (const PairFinding& finding : found.findings)
    if (!finding.wrong) kept.push_back(finding.others_px);
  return kept.empty() ? 0.0 : median(kept);
}

}  // namespace

Json setup_json(const PickingSetup& setup) {
  Json places = Json::array();
  Json names = Json::array();
  for (const KnownPlace& place : setup.places) {
    places.add(place_numbers(place));
    names.add(Json::text(place.name));
  }
  return Json::object()
      .add("painting", tiles_json(setup.painting_tiles).add("name", Json::text(setup.painting)))
      .add("map", tiles_json(setup.map_tiles)
                      .add("origin", point(setup.map_origin))
                      .add("px_m", point(setup.map_px_m, 1e6))
                      .add("crs", Json::text(setup.crs)))
      .add("min_fitted", Json::number(static_cast<double>(min_fitted_pairs)))
      .add("min_pairs", Json::number(static_cast<double>(min_control_pairs)))
      .add("places", std::move(places))
      .add("names", std::move(names))
      .add("next", Json::text(setup.next));
}

Json pairs_json(const PairsSession& session) {
  Json pairs = Json::array();
  for (const ControlPair& pair : session.pairs())
    pairs.add(Json::object()
                  .add("pixel", point(pair.pixel, 1e3))
                  .add("position", point(pair.position))
                  .add("lonlat", point(pair.lonlat, 1e7))
                  .add("altitude_m", rounded(pair.altitude_m))
                  .add("name", Json::text(pair.name))
                  .add("sure", Json::boolean(pair.sure)));
  return Json::object()
      .add("revision", Json::number(static_cast<double>(session.revision())))
      .add("file", Json::text(session.path()))
      .add("can_undo", Json::boolean(session.can_undo()))
      .add("can_redo", Json::boolean(session.can_redo()))
      .add("outside", Json::boolean(session.is_changed_outside()))
      .add("pairs", std::move(pairs));
}

Json fit_json(std::uint64_t revision, const FittedPairs* fit, glm::ivec2 painting_px) {
  Json out = Json::object().add("revision", Json::number(static_cast<double>(revision)));
  if (fit == nullptr) return out.add("state", Json::text("few"));
  const Registration& found = fit->registration;
  const bool judged = fit->pairs.size() >= min_control_pairs;
  // [number, x, y, sigma]
  Json places = Json::array();
  for (std::size_t i = 0; i < fit->places.size(); ++i) {
    const ProposedPixel& at = fit->places[i];
    if (at.pixel.x < 0.0 || at.pixel.y < 0.0 || at.pixel.x > painting_px.x ||
        at.pixel.y > painting_px.y)
      continue;
    places.add(Json::numbers(std::vector{static_cast<double>(i), std::round(at.pixel.x * 10.0) / 10,
                                         std::round(at.pixel.y * 10.0) / 10,
                                         std::round(at.sigma_px * 10.0) / 10}));
  }
  const auto wrong = std::count_if(found.findings.begin(), found.findings.end(),
                                   [](const PairFinding& f) { return f.wrong; });
  out.add("state", Json::text(judged ? "judged" : "rough"))
      .add("projection", Json::text(view_kind_name(found.frame.kind)))
      .add("eye", point(found.frame.origin +
                        found.frame.extent_m * glm::dvec2(found.view[view_unknown::east],
                                                          found.view[view_unknown::north])))
      .add("azimuth_deg", rounded(to_degrees(found.view[view_unknown::azimuth])))
      .add("sigma_px", rounded(found.sigma_px))
      .add("places", std::move(places));
  if (judged)
    out.add("others_px", rounded(median_others_px(found)))
        .add("wrong", Json::number(static_cast<double>(wrong)))
        .add("findings", findings_json(*fit));
  return out;
}

Json terrain_json(std::uint64_t revision, const FittedTerrain* terrain) {
  Json lines = Json::array();
  Json hidden = Json::array();
  if (terrain != nullptr) {
    for (const DrawnLine& drawn : terrain->lines) {
      std::vector<double> points;
      for (const glm::vec2& at : drawn.line.points)
        for (const float part : {at.x, at.y})
          points.push_back(std::round(static_cast<double>(part) * 10.0) / 10.0);
      lines.add(Json::object()
                    .add("skyline", Json::boolean(drawn.line.skyline))
                    .add("sigma_px", rounded(drawn.sigma_px))
                    .add("points", Json::numbers(points)));
    }
    for (std::size_t i = 0; i < terrain->seen.size(); ++i)
      if (!terrain->seen[i]) hidden.add(Json::number(static_cast<double>(i)));
  }
  return Json::object()
      .add("revision", Json::number(static_cast<double>(revision)))
      .add("lines", std::move(lines))
      .add("hidden", std::move(hidden));
}

std::optional<std::size_t> pair_of_place(const std::vector<ControlPair>& pairs, glm::dvec2 position,
                                         double within_m) {
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (std::hypot(pairs[i].position.x - position.x, pairs[i].position.y - position.y) <= within_m)
      return i;
  return std::nullopt;
}

Json place_json(const PlaceAnswer& answer) {
  Json painted = Json::raw("null");
  if (answer.painted)
    painted = Json::object()
                  .add("pixel", point(answer.painted->pixel))
                  .add("sigma_px", rounded(answer.painted->sigma_px));
  return Json::object()
      .add("known", index_json(answer.known))
      .add("name", Json::text(answer.place.name))
      .add("position", point(answer.place.position))
      .add("altitude_m", rounded(answer.place.altitude_m))
      .add("prominence_m", rounded(answer.place.prominence_m))
      .add("pair", index_json(answer.pair))
      .add("painted", std::move(painted))
      .add("seen", Json::boolean(answer.seen))
      .add("off_px", rounded(answer.off_px));
}

}  // namespace belvedere::tools
