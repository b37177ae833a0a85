#include "tools/studio/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>

#include "base/config.h"
#include "base/text/embedded.h"
#include "renderer/compose/proposed_scene.h"
#include "renderer/labels/drawing_svg.h"
#include "renderer/labels/label_files.h"
#include "renderer/pipeline/named_picture.h"
#include "renderer/pipeline/scene_check.h"
#include "renderer/register/pair_proposals.h"
#include "renderer/scene/edit/scene_edit.h"
#include "renderer/scene/edit/toml_layout.h"
#include "renderer/scene/scene_schema.h"
#include "terrain/io/crs.h"
#include "terrain/shape/derivatives.h"

namespace belvedere::tools {
namespace {

Json numbers(glm::dvec2 position) { return Json::numbers(std::vector{position.x, position.y}); }

// Whether a text is a key of scenes: "sun.azimuth_deg", "deform.handles.0.move_m".
bool is_scene_key(const std::string& text) {
  const std::size_t dot = text.rfind('.');
  if (dot == std::string::npos) return false;
  std::string section;  // without indices
  for (std::size_t at = 0; at < dot;) {
    const std::size_t end = text.find('.', at);
    const std::string part = text.substr(at, end - at);
    if (part.find_first_not_of("0123456789") != std::string::npos)
      section = join_key(section, part);
    at = end + 1;
  }
  const SceneSection* found = find_section(section);
  return found != nullptr && find_key(*found, text.substr(dot + 1)) != nullptr;
}

// A value of TOML as JSON: only tables are written differently.
Json json_of(const ConfigValue& value) {
  if (const auto* list = std::get_if<ConfigArray>(&value.value)) {
    Json out = Json::array();
    for (const ConfigValue& element : *list) out.add(json_of(element));
    return out;
  }
  if (const auto* table = std::get_if<ConfigTable>(&value.value)) {
    Json out = Json::object();
    for (const ConfigEntry& entry : *table) out.add(entry.key, json_of(entry.value));
    return out;
  }
  return Json::raw(toml_text(value));
}

Json error_members(const Error& error) {
  Json out = Json::object()
                 .add("message", Json::text(error.found().empty() ? error.what() : error.found()))
                 .add("where", Json::text(error.where()))
                 .add("allowed", Json::text(error.allowed()));
  // "karwendel.toml:12:3", "sun.azimuth_deg" or "karwendel.toml:12:3: sun.azimuth_deg"
  const std::string& where = error.where();
  int line = 0;
  int column = 0;
  for (std::size_t at = where.find(':'); at != std::string::npos; at = where.find(':', at + 1)) {
    const char* end = where.data() + where.size();
    const auto [after, bad] = std::from_chars(where.data() + at + 1, end, line);
    if (bad != std::errc() || after == end || *after != ':') continue;
    std::from_chars(after + 1, end, column);
    break;
  }
  if (line > 0) out.add("line", Json::number(line)).add("column", Json::number(column));
  // Messages of values begin with their key: "sun.altitude_deg is the number 900".
  const std::string last = where.substr(where.rfind(' ') + 1);
  const std::string first = error.found().substr(0, error.found().find(' '));
  if (is_scene_key(last) || is_scene_key(first))
    out.add("key", Json::text(is_scene_key(last) ? last : first));
  return out;
}

// Leaves of a table as edits: "camera.height_m" and "22000"; tables of a list are appended to it.
void add_edits(const ConfigValue& value, const std::string& key, std::vector<SceneEdit>& edits) {
  const auto* list = std::get_if<ConfigArray>(&value.value);
  if (const auto* table = std::get_if<ConfigTable>(&value.value))
    for (const ConfigEntry& entry : *table) add_edits(entry.value, key + "." + entry.key, edits);
  else if (list != nullptr && !list->empty() && list->front().is_table())
    for (const ConfigValue& element : *list)
      edits.push_back({.key = key, .value = toml_text(element), .append = true});
  else
    edits.push_back({.key = key, .value = toml_text(value)});
}

}  // namespace

Json error_json(const Error& error) { return Json::object().add("error", error_members(error)); }

Json scene_json(const SceneSession& session, const std::vector<DerivedValue>& derived,
                const std::vector<std::string>& notes) {
  Json values = Json::object();
  for (const auto& [key, text] : scene_values(session.scene().scene))
    values.add(key, Json::raw(text));
  Json open = Json::array();
  for (const DerivedValue& value : derived)
    open.add(Json::object()
                 .add("key", Json::text(value.key))
                 .add("value", Json::text(value.value))
                 .add("why", Json::text(value.why)));
  return Json::object()
      .add("revision", Json::number(static_cast<double>(session.revision())))
      .add("file", Json::text(session.path()))
      .add("name", Json::text(session.scene().name))
      .add("title", Json::text(session.scene().scene.title))
      .add("saved", Json::boolean(session.is_saved()))
      .add("can_undo", Json::boolean(session.can_undo()))
      .add("can_redo", Json::boolean(session.can_redo()))
      .add("text", Json::text(session.text()))
      .add("drawn_file", Json::text(session.drawn_file()))
      .add("drawn", Json::raw(session.drawn().empty() ? "null" : session.drawn()))
      .add("values", std::move(values))
      .add("derived", std::move(open))
      .add("error", Json::raw("null"))
      .add("notes", Json::texts(notes))
      .add("outside", Json::boolean(session.is_changed_outside()));
}

Json rungs_json(const LoadedScene& scene, const std::vector<Rung>& rungs) {
  Json out = Json::array();
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    const Rung& rung = rungs[i];
    const SceneOutput& size = scene_of_rung(scene, rung).scene.output;
    out.add(Json::object()
                .add("rung", Json::number(static_cast<double>(i)))
                .add("name", Json::text(rung.name))
                .add("width", Json::number(size.width))
                .add("height", Json::number(size.height))
                .add("without", Json::texts(lacks_of(scene, rung))));
  }
  return out;
}

namespace {

void add_lonlat(Json& to, const std::string& crs, glm::dvec2 position) {
  if (!crs.empty())
    to.add("lonlat", numbers(transform_point(crs, normalize_crs("EPSG:4326"), position)));
}

}  // namespace

Json pointer_json(const LivePicture& picture, glm::dvec2 share) {
  const GuidanceBuffers& seen = picture.seen;
  const auto pixel = [](double part, int size) {
    return std::clamp(static_cast<int>(part * size), 0, size - 1);
  };
  const std::size_t i = static_cast<std::size_t>(pixel(share.y, seen.height())) *
                            static_cast<std::size_t>(seen.width()) +
                        static_cast<std::size_t>(pixel(share.x, seen.width()));
  if (std::isinf(seen.depth_m[i])) return Json::object().add("sky", Json::boolean(true));
  const glm::dvec2 position = glm::dvec2(seen.position_m[i]) + glm::dvec2(seen.origin_m);
  Json out = Json::object()
                 .add("sky", Json::boolean(false))
                 .add("position", numbers(position))
                 .add("altitude_m", Json::number(std::round(seen.altitude_m[i])))
                 .add("distance_m", Json::number(std::round(seen.depth_m[i])))
                 .add("class", Json::text(class_name(seen.land_cover[i])));
  add_lonlat(out, picture.crs, position);
  return out;
}

Json place_json(const Dem& dem, glm::dvec2 position) {
  const std::optional<double> altitude_m = measured_altitude_m(dem, position);
  Json out = Json::object().add("sky", Json::boolean(!altitude_m));
  if (!altitude_m) return out;
  out.add("position", numbers(position)).add("altitude_m", Json::number(std::round(*altitude_m)));
  add_lonlat(out, dem.crs, position);
  return out;
}

namespace {

std::string groups_svg(const std::vector<DrawnGroup>& groups) {
  std::string out;
  for (const DrawnGroup& group : groups) out += "<g>" + shapes_svg(group.shapes) + "</g>";
  return out;
}

Json name_json(const LabelSheet& sheet, const Label& label) {
  const LabelBox& box = label.spot.text;
  return Json::object()
      .add("name", Json::text(label.point.name))
      .add("text", Json::text(label.text))
      .add("kind", Json::text(sheet.kind_of(label).name))
      .add("rank", Json::number(label.point.rank))
      .add("outcome", Json::text(outcome_of(label)))
      .add("placed", Json::boolean(label.spot.placed))
      .add("along", Json::boolean(!label.spot.baseline.empty()))
      .add("by_hand", label.point.by_hand_mm ? numbers(*label.point.by_hand_mm) : Json::raw("null"))
      .add("mark", numbers(label.mark.pixel))
      .add("box", Json::numbers(std::vector{box.left, box.top, box.right, box.bottom}))
      .add("svg", Json::text(shapes_svg(draw_label(sheet, label))));
}

}  // namespace

Json sheet_json(const LivePicture& picture) {
  if (!picture.sheet) return Json::object().add("names", Json::array());
  const auto& [sheet, margin] = *picture.sheet;
  Json names = Json::array();
  for (const Label& label : sheet.labels)
    if (label.mark.state == MarkState::seen) names.add(name_json(sheet, label));
  Json kinds = Json::array();
  for (const LabelKindStyle& kind : sheet.style.kinds) kinds.add(Json::text(kind.name));
  Json out = Json::object()
                 .add("width", Json::number(sheet.size_px.x))
                 .add("height", Json::number(sheet.size_px.y))
                 .add("px_per_mm", Json::number(sheet.px_per_mm))
                 .add("kinds", std::move(kinds))
                 .add("names", std::move(names))
                 .add("tracks", Json::text(groups_svg(draw_tracks(sheet))));
  if (!margin.drawing.shapes.empty())
    out.add("margin", Json::object()
                          .add("left", Json::number(margin.left))
                          .add("top", Json::number(margin.top))
                          .add("width", Json::number(margin.drawing.size_px.x))
                          .add("height", Json::number(margin.drawing.size_px.y))
                          .add("paper", Json::text(sheet.style.margin.paper))
                          .add("svg", Json::text(shapes_svg(margin.drawing.shapes))));
  return out;
}

std::string seen_bytes(const LivePicture& picture) {
  constexpr int max_columns = 360;
  const GuidanceBuffers& seen = picture.seen;
  const int step = (seen.width() + max_columns - 1) / max_columns;
  const int width = seen.width() / step;
  const int height = seen.height() / step;
  std::string out;
  const auto add = [&](auto value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  static_assert(std::endian::native == std::endian::little);
  add(static_cast<std::uint32_t>(width));
  add(static_cast<std::uint32_t>(height));
  add(seen.origin_m.x);
  add(seen.origin_m.y);
  const auto add_plane = [&](const auto& value_at) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        add(static_cast<float>(value_at(x * step + step / 2, y * step + step / 2)));
  };
  add_plane([&](int x, int y) { return seen.position_m(x, y).x; });
  add_plane([&](int x, int y) { return seen.position_m(x, y).y; });
  add_plane([&](int x, int y) { return seen.altitude_m(x, y); });
  add_plane([&](int x, int y) { return seen.depth_m(x, y); });
  return out;
}

MapSize map_size(const Dem& dem) {
  constexpr int max_px = 600;
  const int step = std::max(1, (std::max(dem.width(), dem.height()) + max_px - 1) / max_px);
  return {step, dem.width() / step, dem.height() / step};
}

Json map_json(const LiveView::Ground& ground, const LoadedScene& loaded) {
  const Dem& dem = *ground.dem;
  const GeoTransform& t = dem.transform;
  const MapSize size = map_size(dem);
  const CameraParameters& camera = ground.view.camera;
  Json handles = Json::array();
  for (const DeformHandle& handle : ground.view.deform.handles)
    handles.add(Json::object()
                    .add("position", numbers(handle.centre))
                    .add("radius_m", Json::number(handle.radius_m)));
  Json out = Json::object()
                 .add("extent", Json::numbers(std::vector{
                                    t.origin_x, t.origin_y - size.height * size.step * t.cell_y,
                                    t.origin_x + size.width * size.step * t.cell_x, t.origin_y}))
                 .add("width", Json::number(size.width))
                 .add("height", Json::number(size.height))
                 .add("cell_m", Json::number(dem.cell_m() / (1 << dem.halved)))
                 .add("crs", Json::text(dem.crs.empty() ? "" : describe_crs(dem.crs)))
                 .add("viewer", numbers(ground.view.viewer_xy))
                 .add("height_m", Json::number(camera.eye.z))
                 .add("azimuth_deg", Json::number(camera.azimuth_deg))
                 .add("pitch_deg", Json::number(camera.pitch_deg))
                 .add("field_of_view_deg", Json::number(camera.field_of_view_deg))
                 .add("handles", std::move(handles));
  if (loaded.scene.camera.look_at) out.add("target", numbers(*loaded.scene.camera.look_at));
  return out;
}

Grid<glm::vec3> map_picture(const LiveView::Ground& ground) {
  const Dem& dem = *ground.dem;
  const MapSize size = map_size(dem);
  Grid<float> altitude_m(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      altitude_m(x, y) = (*ground.generalized_m)(x * size.step, y * size.step);
  const Grid<std::uint8_t> shade =
      hillshade(altitude_m, size.step * dem.transform.cell_x, size.step * dem.transform.cell_y, {});
  Grid<glm::vec3> picture(size.width, size.height);
  constexpr glm::vec3 no_data{0.16F};
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      if (dem.filled(x * size.step, y * size.step) != 0) {
        picture(x, y) = no_data;
        continue;
      }
      const glm::dvec2 at = dem.transform.to_crs(x * size.step, y * size.step);
      // Pale, so that the forms show.
      const std::uint32_t rgb = class_info(ground.land_cover->at(at.x, at.y)).rgb;
      const glm::vec3 own =
          0.55F + 0.45F / 255.0F * glm::vec3((rgb >> 16U) & 255U, (rgb >> 8U) & 255U, rgb & 255U);
      picture(x, y) = own * (0.35F + 0.65F * static_cast<float>(shade(x, y)) / 255.0F);
    }
  return picture;
}

Json check_json(const ViewEvaluation& evaluation) {
  Json items = Json::array();
  for (const ScoreTerm& term : evaluation.terms) {
    const std::string_view advice = term.advice();
    items.add(Json::object()
                  .add("name", Json::text(term.name))
                  .add("value", Json::text(measure_text(term)))
                  .add("meaning", Json::text(term.meaning))
                  .add("side", Json::text(advice.empty()            ? ""
                                          : advice == term.too_high ? "high"
                                                                    : "low"))
                  .add("verdict", Json::text(advice.empty() ? "good" : "note"))
                  .add("advice", Json::text(advice)));
  }
  return Json::object()
      .add("merit", Json::number(std::round(10.0 * evaluation.merit) / 10.0))
      .add("subject", Json::text(evaluation.subject))
      .add("why_not", Json::text(evaluation.why_not))
      .add("items", std::move(items));
}

std::vector<Proposal> find_proposals(const LiveView::Ground& ground) {
  const CoarseGround coarse = coarse_ground_of(coarse_altitudes_of(*ground.dem));
  const Massifs massifs = find_massifs(coarse);
  require_region(coarse, massifs, "the terrain");
  const ViewSearch search{coarse, massifs, {}};
  std::vector<Proposal> out;
  for (const Candidate& candidate : propose_views(search)) {
    Proposal& proposal = out.emplace_back();
    const ViewWords words = view_words(search, candidate);
    proposal.name = words.view;
    proposal.why = fmt::format("{}; merit {:.1f}", words.subject, candidate.merit);
    // The view as a whole is replaced, so that no key of the view before remains.
    proposal.edits = {{.key = "camera", .value = {}}, {.key = "deform", .value = {}}};
    const ConfigValue text = parse_config(proposed_scene_text(search, candidate, {}), "proposal");
    for (const ConfigEntry& entry : std::get<ConfigTable>(text.value))
      if (entry.key == "camera" || entry.key == "deform" || entry.key == "air")
        add_edits(entry.value, entry.key, proposal.edits);
  }
  return out;
}

Json proposals_json(const std::vector<Proposal>& proposals) {
  Json list = Json::array();
  for (const Proposal& proposal : proposals) {
    Json changes = Json::array();
    for (const SceneEdit& edit : proposal.edits) {
      Json change = Json::object().add("key", Json::text(edit.key));
      if (edit.value)
        change.add(edit.append ? "append" : "value",
                   json_of(parse_config_value(*edit.value, edit.key)));
      else
        change.add("remove", Json::boolean(true));
      changes.add(std::move(change));
    }
    list.add(Json::object()
                 .add("name", Json::text(proposal.name))
                 .add("why", Json::text(proposal.why))
                 .add("changes", std::move(changes)));
  }
  return Json::object().add("proposals", std::move(list));
}

Json choices_json() {
  Json projections_list = Json::array();
  for (const Projection& projection : projections())
    projections_list.add(Json::text(projection.name));
  return Json::object()
      .add("styles", Json::texts(embedded_names("styles")))
      .add("palettes", Json::texts(embedded_names("palettes")))
      .add("projections", std::move(projections_list));
}

}  // namespace belvedere::tools
