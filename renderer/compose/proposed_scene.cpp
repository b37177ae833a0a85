#include "renderer/compose/proposed_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "base/parallel.h"
#include "base/text/json.h"
#include "renderer/compose/view_changes.h"
#include "renderer/compose/view_score.h"
#include "renderer/compose/view_shape.h"

namespace belvedere {
namespace {

std::string_view compass(double azimuth_deg) {
  constexpr std::array<std::string_view, 8> names = {"north", "northeast", "east", "southeast",
                                                     "south", "southwest", "west", "northwest"};
  return names[static_cast<std::size_t>(std::floor(turned_deg(azimuth_deg) / 45.0 + 0.5)) % 8];
}

double km(double metres) { return metres / 1000.0; }

class Text {
 public:
  void line(const std::string& text = {}) { out_ += text + "\n"; }
  // key = value, and its reason, in a column.
  void value(const std::string& key, const std::string& value, const std::string& why = {}) {
    std::string text = key + " = " + value;
    constexpr std::size_t column = 34;
    if (!why.empty())
      text += std::string(text.size() < column ? column - text.size() : 2, ' ') + "# " + why;
    line(text);
  }
  std::string str() && { return std::move(out_); }

 private:
  std::string out_;
};

std::string metres(double m) { return fmt::format("{:.0f}", rounded_m(m)); }
std::string position(glm::dvec2 p) { return fmt::format("[{:.0f}, {:.0f}]", p.x, p.y); }

void write_source(Text& text, const ProposedFile& source) {
  text.value("file", json_quoted(source.file));
  if (source.band != 1) text.value("band", fmt::format("{}", source.band), "of the file's bands");
  if (!source.variable.empty()) text.value("variable", json_quoted(source.variable));
  if (!source.encoding.empty())
    text.value("encoding", json_quoted(source.encoding), "of heights as colours");
  if (!source.crs.empty()) text.value("crs", json_quoted(source.crs), "the file does not state it");
  if (source.lowest_m)
    text.value("lowest_m", fmt::format("{:.0f}", *source.lowest_m),
               "lower values are errors of the data");
  if (!source.origin.empty()) text.value("origin", json_quoted(source.origin));
  if (!source.licence.empty())
    text.value("licence", json_quoted(source.licence), "is written to every picture's file");
  if (!source.get_from.empty()) text.value("get_from", json_quoted(source.get_from));
}

std::string subject_words(const Anchor& anchor, const Massifs& massifs) {
  if (anchor.kind != AnchorKind::summit) return describe_anchor(anchor);
  if (massifs.lone > 0.5) return fmt::format("a lone mountain of {:.0f} m", anchor.altitude_m);
  return fmt::format("{}, {:.0f} m above its valleys", describe_anchor(anchor), anchor.stands_m);
}

// The main summit slightly more than its neighbours; other summits by the factor that improves the
// view.
void write_summits(Text& text, const ViewSearch& search, const Candidate& candidate) {
  std::vector<RaisedSummit> summits = candidate.changes.summits;
  const int main = candidate.plan.anchor;
  const Massifs& massifs = search.massifs;
  const Anchor& leads = massifs.anchors[static_cast<std::size_t>(main)];
  const bool done = std::any_of(summits.begin(), summits.end(),
                                [&](const RaisedSummit& s) { return s.anchor == main; });
  if (leads.kind == AnchorKind::summit && massifs.lone < 0.99 && !done)
    summits.push_back({.anchor = main,
                       .by = raise_of(leads, candidate.view, 1.0 + 0.15 * (1.0 - massifs.lone)),
                       .gain = {}});
  for (const RaisedSummit& summit : summits) {
    text.line("[[deform.summits]]");
    text.value("name", json_quoted(summit.anchor == main ? "main summit" : "summit"),
               subject_words(massifs.anchors[static_cast<std::size_t>(summit.anchor)], massifs));
    text.value("position", position(summit.by.centre));
    text.value("radius_m", metres(summit.by.radius_m));
    text.value("factor", fmt::format("{:.2f}", summit.by.factor),
               summit.gain.words.empty() ? "slightly more than its neighbours, to emphasize it"
                                         : "improves " + summit.gain.words);
    text.value("base_m", fmt::format("{:.0f}", summit.by.base_m), "only its upper part");
    text.line();
  }
}

}  // namespace

ViewWords view_words(const ViewSearch& search, const Candidate& candidate) {
  const ViewShape& v = candidate.view;
  const Anchor& anchor = search.massifs.anchors[static_cast<std::size_t>(candidate.plan.anchor)];
  const AnchorSight& sight =
      candidate.measures.anchors[static_cast<std::size_t>(candidate.plan.anchor)];
  const std::string_view where = sight.position.x < 0.42   ? "left of the centre"
                                 : sight.position.x > 0.58 ? "right of the centre"
                                                           : "at the centre";
  return {
      fmt::format("{} ({:.0f}°), {:.0f} to {:.0f} km, {:.0f}° wide",
                  v.field_of_view_deg >= 359.0 ? "full circle from"
                                               : fmt::format("looks {}", compass(v.azimuth_deg)),
                  turned_deg(v.azimuth_deg), km(v.near_m), km(v.far_m), v.field_of_view_deg),
      fmt::format("{} {}", subject_words(anchor, search.massifs), where)};
}

std::string describe_view(const ViewSearch& search, const Candidate& candidate) {
  const auto [view, subject] = view_words(search, candidate);
  return fmt::format("{}: {}; merit {:.1f}", view, subject, candidate.merit);
}

std::string proposed_scene_text(const ViewSearch& search, const Candidate& candidate,
                                const ProposedScene& about) {
  const ViewShape& v = candidate.view;
  const ViewMeasures& m = candidate.measures;
  const HorizonDefaults horizon = defaults_of_horizon(v.far_m);
  const PainterSun sun = painter_sun(turned_deg(v.azimuth_deg));
  Text text;
  text.line(fmt::format("# Proposed by belvedere new{}: {}.",
                        about.number.empty() ? "" : ", " + about.number,
                        describe_view(search, candidate)));
  text.line(
      fmt::format("# Every length is derived from the region: its side is {:.0f} km, the horizon "
                  "of this view is at {:.1f} km.",
                  km(search.ground.side_m), km(v.far_m)));
  text.value("version", "1");
  text.value("title", json_quoted(about.title));
  if (!about.style.empty()) text.value("style", json_quoted(about.style));
  if (!about.palette.empty()) text.value("palette", json_quoted(about.palette), about.palette_why);
  text.line();
  if (!about.crs.empty() || search.ground.void_share > 0.2) {
    text.line("[terrain]");
    if (!about.crs.empty())
      text.value("crs", json_quoted(about.crs),
                 "metres, true to scale here; all positions below are in it");
    if (search.ground.void_share > 0.2)
      text.value(
          "max_void_share", fmt::format("{:.2f}", std::min(0.9, search.ground.void_share + 0.1)),
          fmt::format("{:.0f} % of the data's extent is empty", 100.0 * search.ground.void_share));
    text.line();
  }
  for (const ProposedFile& source : about.sources) {
    text.line("[[terrain.sources]]");
    write_source(text, source);
    text.line();
  }
  if (about.land_cover) {
    text.line("[[land_cover.sources]]");
    write_source(text, *about.land_cover);
  }
  if (about.land_cover || !about.rock.empty()) {
    text.line("[land_cover]");
    if (about.land_cover) text.value("legend", json_quoted(about.legend));
    if (about.land_cover && !about.unknown.empty())
      text.value("unknown", json_quoted(about.unknown), "codes that the legend lacks");
    if (!about.rock.empty()) text.value("rock", json_quoted(about.rock), about.rock_why);
    text.line();
  }
  text.line(
      "# Large forms are raised a little near the viewer; far away, where ranges are close "
      "together, fine ones are removed.");
  text.line("[generalize]");
  text.line("foreground = [1.1, 1.1, 1.1, 1.0, 1.0, 0.9]");
  text.line("background = [1.2, 1.2, 1.1, 0.8, 0.5, 0.3]");
  text.value("foreground_to_m", metres(horizon.foreground_to_m), "0.42 of the horizon's distance");
  text.value("background_from_m", metres(horizon.background_from_m), "0.95 of it");
  text.value("crest", "0.4");
  if (candidate.changes.widen_valleys_m > 0.0)
    text.value("widen_valleys_m", metres(candidate.changes.widen_valleys_m),
               "improves " + candidate.changes.widened.words);
  text.line();
  text.line("[deform]");
  text.value(
      "exaggeration", fmt::format("{:.2f}", v.exaggeration),
      fmt::format("so that landforms take {:.0f} % of the picture's height above their valleys",
                  100.0 * m.forms));
  text.value("exaggeration_base_m", fmt::format("{:.0f}", v.base_m),
             "a tenth of the ground in view is lower, so that valleys stay in place");
  text.line("[deform.bend]");
  text.value("radius_m", metres(v.radius_m),
             fmt::format("so that level ground at {:.1f} km is on the lower edge", km(v.near_m)));
  text.value("crest_m", metres(v.crest_m),
             "level here, tilted towards the viewer before it, sinking to the horizon behind it");
  text.line();
  write_summits(text, search, candidate);
  text.line("[camera]");
  if (v.cylinder)
    text.value("projection", "\"cylindrical\"",
               "a plane projection would stretch the sides of a picture this wide");
  text.value(
      "position", position(v.viewer),
      search.ground.at(v.viewer) == nullptr ? "outside the data, which begin in front of it" : "");
  text.value("height_m", fmt::format("{:.0f}", v.eye_m),
             "so that the line of sight touches the bent level ground at the horizon");
  text.value("azimuth_deg", fmt::format("{:.1f}", turned_deg(v.azimuth_deg)),
             fmt::format("to the {}", compass(v.azimuth_deg)));
  text.value("pitch_deg", fmt::format("{:.2f}", v.pitch_deg),
             fmt::format("{:.0f} % of the picture is sky", 100.0 * m.skyline.mean));
  text.value("field_of_view_deg", fmt::format("{:.1f}", v.field_of_view_deg));
  text.line();
  text.line("[sun]");
  text.value("azimuth_deg", fmt::format("{:.0f}", sun.azimuth_deg),
             "from the upper left of the picture, as on maps");
  text.value("altitude_deg", fmt::format("{:.0f}", sun.altitude_deg));
  text.line();
  text.line("[air]");
  text.value("from_m", metres(horizon.air_from_m), "behind the foreground");
  text.value("scale_m", metres(horizon.air_scale_m), "far ranges turn blue but stay readable");
  text.value("haze", fmt::format("{}", view_haze));
  text.value("rim_fade_m", metres(horizon.rim_fade_m), "the end of the data disappears in haze");
  text.line();
  text.line("[output]");
  text.value("width", fmt::format("{}", about.width_px));
  text.value("height", fmt::format("{:.0f}", std::round(about.width_px / v.aspect)));
  text.value("sheet_width_mm", fmt::format("{:.0f}", about.sheet_width_mm));
  return std::move(text).str();
}

namespace {

double off_by(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d - 360.0 * std::floor(d / 360.0), 360.0 - (d - 360.0 * std::floor(d / 360.0)));
}

bool differ(const ViewSearch& search, const Candidate& a, const Candidate& b, double degrees) {
  const double turn = off_by(a.view.azimuth_deg, b.view.azimuth_deg);
  const double moved = glm::distance(a.view.viewer, b.view.viewer) / search.ground.side_m;
  if (turn > degrees) return true;
  // If the direction is given, another position, or another subject from a little farther off, is
  // another view.
  if (search.request.towards_deg)
    return moved > 0.25 || (moved > 0.12 && a.plan.anchor != b.plan.anchor);
  return moved > 0.25 && a.plan.anchor != b.plan.anchor;
}

std::vector<Candidate> best_that_differ(const ViewSearch& search, std::vector<Candidate> candidates,
                                        std::size_t max, double degrees) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  std::vector<Candidate> out;
  for (Candidate& candidate : candidates) {
    if (out.size() == max) break;
    if (std::all_of(out.begin(), out.end(), [&](const Candidate& other) {
          return differ(search, candidate, other, degrees);
        }))
      out.push_back(std::move(candidate));
  }
  return out;
}

// From a given position some directions have no leading subject; they are used only if all lack
// one.
void drop_views_of_nothing(const ViewSearch& search, std::vector<Candidate>& candidates) {
  if (!search.request.from) return;
  const auto shows_none = [](const Candidate& c) {
    return !c.measures.anchors[static_cast<std::size_t>(c.plan.anchor)].inside;
  };
  if (!std::all_of(candidates.begin(), candidates.end(), shows_none))
    std::erase_if(candidates, shows_none);
}

}  // namespace

void require_region(const CoarseGround& ground, const Massifs& massifs, const std::string& name) {
  constexpr double min_side_m = 8000.0;
  constexpr double max_void = 0.6;
  constexpr double min_relief = 0.008;  // of the side
  if (ground.side_m < min_side_m)
    throw Error(
        ErrorKind::input, name,
        fmt::format("holds data of {:.0f} km², a square of {:.1f} km: too little for a panorama",
                    ground.side_m * ground.side_m / 1e6, ground.side_m / 1000.0),
        "a region of 8 km or more per side, better 30 to 80; several files are joined");
  if (ground.void_share > max_void)
    throw Error(ErrorKind::input, name,
                fmt::format("{:.0f} % of it has no data", 100.0 * ground.void_share),
                "a part with data (gdal_translate -projwin), or further files that fill the gaps");
  if (ground.relief_m < min_relief * ground.side_m)
    throw Error(ErrorKind::input, name,
                fmt::format("is nearly flat: {:.0f} m between high and low on {:.0f} km",
                            ground.relief_m, ground.side_m / 1000.0),
                "a region with mountains, or a scene written by hand");
  if (massifs.anchors.empty())
    throw Error(ErrorKind::input, name,
                "all summits lie at its edge: there is no mountain to look at",
                "a larger region around the mountains");
}

std::vector<Candidate> propose_views(const ViewSearch& search,
                                     const ProposalParameters& parameters) {
  std::vector<Candidate> candidates = first_candidates(search);
  if (candidates.empty()) {
    std::string found = "no view fits: every one would show the end of the data";
    std::string allowed = "a larger region";
    if (search.request.from)
      found = "no view from there fits: the data do not cover the ground it would show",
      allowed = "another position for --from, or a larger region";
    else if (search.request.format.full_turn)
      allowed = "a larger region, or a narrower picture (--format 3:1)";
    else if (search.request.format.aspect > 2.5)
      allowed = "a larger region, or a narrower picture (--format 2:1)";
    if (search.request.towards_deg) allowed += ", or another direction";
    throw Error(ErrorKind::input, "the region", found, allowed);
  }
  drop_views_of_nothing(search, candidates);
  // More are refined than requested: some converge to the same view.
  const auto wanted = static_cast<std::size_t>(parameters.max);
  constexpr double apart_before = 20.0, apart = 25.0;
  std::vector<Candidate> starts =
      best_that_differ(search, std::move(candidates), wanted + 3, apart_before);
  const std::vector<WideGround> wide =
      search.request.plain ? std::vector<WideGround>{} : widen_grounds(search.ground);
  parallel_ranges(starts.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      starts[i] = refine(search, std::move(starts[i]));
      if (!search.request.plain) starts[i] = with_changes(search, wide, starts[i]);
    }
  });
  drop_views_of_nothing(search, starts);
  std::vector<Candidate> out = best_that_differ(search, std::move(starts), wanted, apart);
  for (const ViewRequest::Place& position : search.request.include) {
    const std::size_t at = search.massifs.anchors.size() +
                           static_cast<std::size_t>(&position - search.request.include.data());
    std::erase_if(out, [&](const Candidate& c) { return !c.measures.anchors[at].inside; });
    if (out.empty())
      throw Error(ErrorKind::input, "--include",
                  fmt::format("no view of this region shows {}",
                              position.name.empty() ? "that position" : position.name),
                  "a position farther from the edge of the data, or a larger region");
  }
  return out;
}

}  // namespace belvedere
