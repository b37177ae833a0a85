#include "tools/pick/pairs_fitter.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/files/output_file.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/statistics.h"
#include "base/text/missing_file.h"
#include "tools/report/register_page.h"

namespace belvedere::tools {
namespace {

constexpr int lines_width_px = 1400;  // of the picture in which skyline and ridges are looked for

Error superseded() {
  return {ErrorKind::interrupted, "pairs", "superseded", "the present revision"};
}

glm::ivec2 traced_size(glm::ivec2 painting_px) {
  const int width = std::min(lines_width_px, painting_px.x);
  return {width, std::max(1, painting_px.y * width / painting_px.x)};
}

FittedPairs fit_pairs(const PairsFitterInput& input, std::uint64_t revision,
                      const std::vector<ControlPair>& pairs, Progress& progress) {
  FittedPairs out{
      .revision = revision,
      .pairs = pairs,
      .registration = register_pairs(pairs, input.painting_px, input.registration, progress),
      .field = {},
      .places = {}};
  out.field = DisplacementField(out.registration.displacement);
  for (const KnownPlace& place : input.places)
    out.places.push_back(propose_pixel(out.registration, out.field, place));
  return out;
}

// A line in pieces, since far ground may be unsure where near ground is not.
void add_pieces(std::vector<DrawnLine>& out, const SeenLine& line, const RegisteredView& view,
                const DisplacementField& field, float scale) {
  constexpr std::size_t piece = 40;  // points
  const Registration& found = view.registration();
  for (std::size_t from = 0; from + 1 < line.points.size(); from += piece) {
    const std::size_t to = std::min(from + piece + 1, line.points.size());  // joined to the next
    const glm::vec2 middle = line.points[(from + to) / 2];
    const auto ground = view.map().to_geo(glm::dvec2(middle.x, middle.y + 0.5F));
    DrawnLine& drawn = out.emplace_back();
    drawn.line.skyline = line.skyline;
    if (ground)
      drawn.sigma_px = exact::hypot(
          found.sigma_px, registered_sigma_px(found, field, ground->position, ground->altitude_m));
    for (std::size_t i = from; i < to; ++i) drawn.line.points.push_back(scale * line.points[i]);
  }
}

std::vector<DrawnHandle> handles_of_pairs(const PairsFitterInput& input, const FittedPairs& fit) {
  std::vector<DrawnHandle> out;
  const std::optional<Registration> found = refine_registration(fit.registration, fit.pairs, {});
  if (!found) return out;
  const DisplacementField field(found->displacement);
  for (const DeformHandle& handle : handles_of(found->mountains))
    if (const auto altitude_m = measured_altitude_m(input.drawn, handle.centre))
      out.push_back({handle, registered_pixel(*found, field, handle.centre, *altitude_m)});
  return out;
}

FittedTerrain terrain_of(const PairsFitterInput& input, const FittedPairs& fit,
                         Progress& progress) {
  FittedTerrain out{
      .view = nullptr, .lines = {}, .seen = std::vector<bool>(input.places.size(), true)};
  if (fit.pairs.size() < min_control_pairs) return out;
  const glm::ivec2 size = traced_size(input.painting_px);
  const float scale = static_cast<float>(input.painting_px.x) / static_cast<float>(size.x);
  out.view = std::make_unique<const RegisteredView>(
      fit.registration, registered_scene(fit.registration, input.painting_px), input.drawn, size,
      progress);
  progress.advance(0.0);
  for (const SeenLine& line : seen_lines(trace_registered(*out.view)))
    add_pieces(out.lines, line, *out.view, fit.field, scale);
  for (std::size_t i = 0; i < input.places.size(); ++i) {
    progress.advance(0.0);
    out.seen[i] = is_seen(*out.view, input.places[i]);
  }
  out.handles = handles_of_pairs(input, fit);
  return out;
}

}  // namespace

// Ends work whose pairs are no longer the newest.
class PairsFitter::WhileNewest : public Progress {
 public:
  WhileNewest(const PairsFitter& fitter, std::uint64_t revision)
      : fitter_(fitter), revision_(revision) {}
  void begin(std::string_view, double) override { check(); }
  void advance(double) override { check(); }

 private:
  void check() const {
    const std::lock_guard lock(fitter_.mutex_);
    if (fitter_.ended_ || fitter_.newest_ != revision_) throw superseded();
  }
  const PairsFitter& fitter_;
  std::uint64_t revision_;
};

PairsFitter::PairsFitter(PairsFitterInput input)
    : input_(std::move(input)), thread_([this] { work(); }) {}

PairsFitter::~PairsFitter() {
  end();
  thread_.join();
}

void PairsFitter::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void PairsFitter::fit(std::uint64_t revision, std::vector<ControlPair> pairs) {
  const std::lock_guard lock(mutex_);
  newest_ = revision;
  pairs_ = std::move(pairs);
  changed_.notify_all();
}

void PairsFitter::work() {
  for (;;) {
    std::uint64_t revision = 0;
    std::vector<ControlPair> pairs;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return ended_ || newest_ != done_; });
      if (ended_) return;
      revision = newest_;
      pairs = pairs_;
      error_.reset();
    }
    std::optional<Error> error;
    try {
      fit_newest(revision, pairs);
    } catch (const Error& caught) {
      error = caught;
      // Priors may not determine a view that a few pairs leave open.
      if (caught.kind() == ErrorKind::bug && pairs.size() < min_control_pairs)
        error = Error(ErrorKind::input, "pairs", "they do not tell a view",
                      "pairs that are spread over the painting");
    } catch (const std::exception& caught) {  // memory
      error = Error(ErrorKind::limit, "pairs", caught.what());
    }
    const std::lock_guard lock(mutex_);
    error_ = std::move(error);
    done_ = revision;
    changed_.notify_all();
  }
}

void PairsFitter::fit_newest(std::uint64_t revision, const std::vector<ControlPair>& pairs) {
  WhileNewest progress(*this, revision);
  if (pairs.size() < min_fitted_pairs) {
    const std::lock_guard lock(mutex_);
    latest_ = {};
    return;
  }
  const auto fit =
      std::make_shared<const FittedPairs>(fit_pairs(input_, revision, pairs, progress));
  {
    const std::lock_guard lock(mutex_);
    latest_ = {fit, nullptr};
    changed_.notify_all();
  }
  auto terrain = std::make_shared<const FittedTerrain>(terrain_of(input_, *fit, progress));
  const std::lock_guard lock(mutex_);
  latest_.terrain = std::move(terrain);
}

PairsFitter::Latest PairsFitter::wait(std::uint64_t revision, bool for_terrain) {
  const auto is_there = [&] {
    return latest_.fit != nullptr && latest_.fit->revision == revision &&
           (!for_terrain || latest_.terrain != nullptr);
  };
  std::unique_lock lock(mutex_);
  changed_.wait(lock,
                [&] { return ended_ || newest_ != revision || done_ == revision || is_there(); });
  if (ended_ || newest_ != revision) throw superseded();
  if (is_there()) return latest_;
  if (error_) throw *error_;
  return {};
}

std::shared_ptr<const FittedPairs> PairsFitter::fitted(std::uint64_t revision) {
  return wait(revision, false).fit;
}

std::shared_ptr<const FittedTerrain> PairsFitter::terrain(std::uint64_t revision) {
  return wait(revision, true).terrain;
}

PairsFitter::Latest PairsFitter::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

namespace {

std::string read_text(const std::string& path) {
  require_file(path, "a table of pairs");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::input, path, "cannot be read", "a table of pairs");
  return {std::istreambuf_iterator<char>(file), {}};
}

// The path, whose file is made if it is missing.
const std::string& with_file(const std::string& path) {
  if (!std::filesystem::exists(path)) write_text_file(path, control_pairs_text({}));
  return path;
}

}  // namespace

PairsSession::PairsSession(std::string path, glm::ivec2 painting_px, const Dem& dem)
    : path_(std::move(path)),
      painting_px_(painting_px),
      dem_(dem),
      owner_(with_file(path_), "page that picks pairs"),
      text_(read_text(path_)),
      pairs_(parse(text_)) {}

std::vector<ControlPair> PairsSession::parse(const std::string& text) const {
  return parse_control_pairs(text, path_, painting_px_, dem_,
                             {.min_pairs = 0, .other_columns = false});
}

bool PairsSession::is_changed_outside() const {
  std::ifstream file(path_, std::ios::binary);
  return !file || !std::filesystem::is_regular_file(path_) ||
         std::string(std::istreambuf_iterator<char>(file), {}) != text_;
}

void PairsSession::write(const std::string& text) {
  write_text_file(path_, text);
  owner_.renew();
}

void PairsSession::replace(const std::string& text, std::vector<ControlPair> pairs) {
  if (is_changed_outside())
    throw Error(ErrorKind::output, path_, "another program changed the file",
                "reload it, or write over it");
  write(text);
  text_ = text;
  pairs_ = std::move(pairs);
  ++revision_;
}

void PairsSession::change(std::span<const ControlPair> pairs) {
  const std::string text = control_pairs_text(pairs);
  if (text == text_) return;
  const std::string before = text_;
  replace(text, parse(text));
  undo_.push_back(before);
  redo_.clear();
}

void PairsSession::undo() {
  if (undo_.empty()) return;
  const std::string before = text_;
  replace(undo_.back(), parse(undo_.back()));
  undo_.pop_back();
  redo_.push_back(before);
}

void PairsSession::redo() {
  if (redo_.empty()) return;
  const std::string before = text_;
  replace(redo_.back(), parse(redo_.back()));
  redo_.pop_back();
  undo_.push_back(before);
}

void PairsSession::reload() {
  const std::string text = read_text(path_);
  if (text == text_) return;
  std::vector<ControlPair> pairs = parse(text);
  owner_.renew();
  undo_.push_back(std::exchange(text_, text));
  redo_.clear();
  pairs_ = std::move(pairs);
  ++revision_;
}

void PairsSession::save_over() { write(text_); }

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

// The findings on each pair once there are enough to judge them.
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
      .add("next", Json::text(setup.next))
      .add("room", Json::boolean(setup.room));
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
  Json handles = Json::array();
  if (terrain != nullptr) {
    for (const auto& [handle, pixel] : terrain->handles)
      handles.add(Json::object()
                      .add("position", point(handle.centre))
                      .add("moved", point(handle.centre + handle.move_m))
                      .add("radius_m", rounded(handle.radius_m))
                      .add("core_m", rounded(handle.core_m))
                      .add("turn_deg", rounded(handle.rotate_deg))
                      .add("pixel", point(pixel)));
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
      .add("hidden", std::move(hidden))
      .add("handles", std::move(handles));
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
