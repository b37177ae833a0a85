#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "base/text/json.h"
#include "renderer/pipeline/scene_check.h"
#include "tools/cli/commands.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

Json composition_json(const ViewEvaluation& evaluation) {
  Json terms = Json::object();
  for (const ScoreTerm& term : evaluation.terms)
    terms.add(std::string(term.name), Json::object()
                                          .add("value", Json::number(term.value))
                                          .add("good_from", Json::number(term.good.b))
                                          .add("good_to", Json::number(std::min(term.good.c, 1e9)))
                                          .add("advice", Json::text(std::string(term.advice()))));
  return Json::object()
      .add("judged", Json::boolean(evaluation.evaluated()))
      .add("merit", Json::number(evaluation.merit))
      .add("subject", Json::text(evaluation.subject))
      .add("near_m", Json::number(evaluation.near_m))
      .add("far_m", Json::number(evaluation.far_m))
      .add("measures", std::move(terms));
}

std::string composition_text(const ViewEvaluation& evaluation) {
  if (!evaluation.evaluated()) return "composition: not evaluated, " + evaluation.why_not + "\n";
  std::string out = fmt::format(
      "composition: merit {:.1f} of 10; about {}; from {:.1f} km to a horizon at {:.1f} km\n",
      evaluation.merit, evaluation.subject, evaluation.near_m / 1000.0, evaluation.far_m / 1000.0);
  const auto value = [&](std::string_view name) {
    for (const ScoreTerm& term : evaluation.terms)
      if (term.name == name) return measure_text(term);
    return std::string();
  };
  out += fmt::format(
      "composition: sky {}, rim {}, valley floor seen {}, ranges apart {}, edge through mountains "
      "{}, haze {}\n",
      value("sky"), value("rim"), value("floor"), value("ranges"), value("cut"), value("haze"));
  for (const ScoreTerm& term : evaluation.terms)
    if (!term.advice().empty())
      out += fmt::format("  {} ({} {})\n", term.advice(), measure_text(term), term.meaning);
  return out;
}

// Main ranges that are in shade, and the light on the others.
std::string light_text(const SceneReport& report) {
  constexpr std::size_t max = 8;
  std::string out;
  bool shade = false;
  for (std::size_t i = 0; i < std::min(report.ranges.size(), max); ++i) {
    const SeenRange& range = report.ranges[i];
    shade = shade || range.in_shade();
    out += fmt::format(
        "  around E {:.0f} N {:.0f}, {:.0f} m, {:.0f} km away, {:.0f} % of the slopes seen: {:.0f} "
        "% lit, {:.0f} % in cast shadow, "
        "{:.0f} % turned away{}\n",
        range.summit.x, range.summit.y, range.altitude_m, range.distance_m / 1000.0,
        100.0 * range.share, 100.0 * range.lit, 100.0 * range.cast, 100.0 * range.away,
        range.in_shade() ? "; in shade" : "");
  }
  if (out.empty()) return out;
  return "light on the main ranges:\n" + out +
         (shade ? "  light regions to correct it: belvedere check --propose-light\n" : "");
}

Json ranges_json(const SceneReport& report) {
  Json out = Json::array();
  for (const SeenRange& range : report.ranges)
    out.add(
        Json::object()
            .add("summit", Json::array({Json::number(range.summit.x), Json::number(range.summit.y),
                                        Json::number(range.altitude_m)}))
            .add("distance_m", Json::number(range.distance_m))
            .add("share", Json::number(range.share))
            .add("lit", Json::number(range.lit))
            .add("cast_shadow", Json::number(range.cast))
            .add("turned_away", Json::number(range.away))
            .add("in_shade", Json::boolean(range.in_shade())));
  return out;
}

// Values that the scene leaves open, as one could write them.
Json derived_json(const std::vector<DerivedValue>& derived) {
  Json out = Json::object();
  for (const DerivedValue& value : derived) out.add(value.key, Json::raw(value.value));
  return out;
}

std::string derived_text(const std::vector<DerivedValue>& derived) {
  std::string out = derived.empty() ? "" : "not set in the scene, derived from the region:\n";
  for (const DerivedValue& value : derived)
    out += fmt::format("  {:<42}# {}\n", value.key + " = " + value.value, value.why);
  return out;
}

std::string as_json(const LoadedScene& scene, const SceneReport& report) {
  Json inputs = Json::array();
  for (const SceneInput& input : report.inputs)
    inputs.add(Json::object()
                   .add("key", Json::text(input.key))
                   .add("file", Json::text(input.file))
                   .add("found", Json::boolean(!input.path.empty()))
                   .add("origin", Json::text(input.origin))
                   .add("licence", Json::text(input.licence)));
  Json classes = Json::object();
  for (const auto& [id, share] : report.classes) classes.add(class_name(id), Json::number(share));
  Json areas = Json::object();
  for (const ClassArea& area : report.land_cover)
    areas.add(class_name(area.id), Json::object()
                                       .add("before_m2", Json::number(area.before_m2))
                                       .add("after_m2", Json::number(area.after_m2))
                                       .add("patches_before", Json::number(area.patches_before))
                                       .add("patches_after", Json::number(area.patches_after)));
  const CameraParameters& camera = report.view.camera;
  return Json::object()
             .add("scene", Json::text(scene.name))
             .add("valid", Json::boolean(true))
             .add("inputs", std::move(inputs))
             .add("crs", Json::text(report.crs))
             .add("cells",
                  Json::array({Json::number(report.cells_wide), Json::number(report.cells_high)}))
             .add("cell_m", Json::number(report.cell_m))
             .add("larger_than_memory", Json::text(report.larger_than_memory))
             .add("eye", Json::array({Json::number(camera.eye.x), Json::number(camera.eye.y),
                                      Json::number(camera.eye.z)}))
             .add("azimuth_deg", Json::number(camera.azimuth_deg))
             .add("pitch_deg", Json::number(camera.pitch_deg))
             .add("sun_azimuth_deg", Json::number(report.view.sun.azimuth_deg))
             .add("sun_altitude_deg", Json::number(report.view.sun.altitude_deg))
             .add("derived", derived_json(report.view.derived))
             .add("classes", std::move(classes))
             .add("land_cover", std::move(areas))
             .add("exemplars", Json::texts(report.exemplars))
             .add("composition", composition_json(report.evaluation))
             .add("ranges", ranges_json(report))
             .str() +
         "\n";
}

std::string as_text(const LoadedScene& scene, const SceneReport& report) {
  std::string out;
  for (const SceneInput& input : report.inputs)
    out += fmt::format("{} {}{}\n", input.path.empty() ? "left out:" : "found:", input.file,
                       input.origin.empty() ? "" : " (" + input.origin + ")");
  const CameraParameters& camera = report.view.camera;
  out +=
      fmt::format("terrain: {} × {} cells of {:.4g} m, {}\n", report.cells_wide, report.cells_high,
                  report.cell_m, report.crs == "none" ? "no CRS" : report.crs);
  if (!report.larger_than_memory.empty())
    out += fmt::format("terrain: checked here at that cell size only; in the picture {}\n",
                       report.larger_than_memory);
  out +=
      fmt::format("camera: E {:.0f} N {:.0f}, {:.0f} m; azimuth {:.1f}°, pitch {:.1f}°\n",
                  camera.eye.x, camera.eye.y, camera.eye.z, camera.azimuth_deg, camera.pitch_deg);
  out += fmt::format("sun: azimuth {:.1f}°, {:.1f}° high\n", report.view.sun.azimuth_deg,
                     report.view.sun.altitude_deg);
  out += derived_text(report.view.derived);
  for (const ClassArea& area : report.land_cover)
    out += fmt::format(
        "land cover: {} {:.2f} km² in {} patches, {:.2f} km² in {} before small ones were "
        "removed\n",
        class_name(area.id), area.after_m2 / 1e6, area.patches_after, area.before_m2 / 1e6,
        area.patches_before);
  out += "in the picture:";
  for (const auto& [id, share] : report.classes)
    out += fmt::format(" {} {:.1f} %,", class_name(id), 100.0 * share);
  out.back() = '\n';
  for (std::size_t i = 0; i < report.exemplars.size(); ++i) {
    out += "copied from: " + report.exemplars[i] + ":";
    for (const LandCoverClass id : report.exemplar_classes[i])
      out += fmt::format(" {},", class_name(id));
    out.back() = '\n';
  }
  return out + composition_text(report.evaluation) + light_text(report) + scene.name +
         " is valid\n";
}

}  // namespace

Action add_check(CommandOptions& command) {
  const auto options = std::make_shared<SceneOptions>();
  add_scene_options(command, *options);
  add_locked_option(command, *options);
  const auto propose = std::make_shared<bool>(false);
  command.add_flag(
      "--propose-light", *propose,
      "Print [[light.regions]] that light the ranges in shade, to be appended to the scene");
  command.footer(
      "Checks the scene's keys, its files, the terrain, the position of the camera, and, where "
      "texture is copied, whether\n"
      "the exemplars show every class that is in the picture. Nothing is painted. Exit status 0: "
      "valid.\n"
      "\n"
      "It also evaluates the composition by the measures that belvedere new uses to choose views, "
      "and names those outside\n"
      "their good range; a picture may have its reasons, so that is not an error. It also reports "
      "the light on the main\n"
      "ranges, and which of them are in shade.\n"
      "\n"
      "  belvedere check scenes/karwendel.toml --data ../data\n"
      "  belvedere check scenes/karwendel.toml --data ../data --propose-light >> "
      "scenes/karwendel.toml");
  return [options, propose] {
    const LoadedScene scene = load(*options);
    const RunLimits limits(make_run(*options));
    TerminalProgress progress(options->quiet);
    const SceneReport report = check_scene(scene, progress, make_cache(*options), *propose);
    progress.end();
    if (*propose) {
      print_out(proposed_light_text(report.proposed));
      return 0;
    }
    print_out(options->json ? as_json(scene, report) : as_text(scene, report));
    return 0;
  };
}

}  // namespace belvedere::tools
