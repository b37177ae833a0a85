#include "tools/pick/picking.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <mutex>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/statistics.h"
#include "base/text/parse_number.h"
#include "terrain/io/crs.h"
#include "terrain/register/control_pairs.h"
#include "terrain/shape/derivatives.h"
#include "tools/pick/pairs_fitter.h"
#include "tools/report/report_pictures.h"
#include "tools/studio/answers.h"

namespace belvedere::tools {
namespace {

struct Tint {
  float at;  // share of the range of altitudes
  glm::vec3 colour;
};
constexpr std::array<Tint, 5> tints = {{{0.F, {0.66F, 0.76F, 0.62F}},
                                        {0.25F, {0.80F, 0.83F, 0.68F}},
                                        {0.5F, {0.90F, 0.85F, 0.70F}},
                                        {0.75F, {0.89F, 0.83F, 0.77F}},
                                        {1.F, {0.98F, 0.98F, 0.99F}}}};

glm::vec3 tint_at(float share) {
  for (std::size_t i = 1; i < tints.size(); ++i)
    if (share <= tints[i].at)
      return glm::mix(tints[i - 1].colour, tints[i].colour,
                      std::max(0.F, (share - tints[i - 1].at) / (tints[i].at - tints[i - 1].at)));
  return tints.back().colour;
}

// Range of altitudes, without the few lowest and highest.
struct Range {
  float low, high;
};
Range usual_range(const Grid<float>& altitude_m) {
  std::vector<float> some;
  const std::size_t every = altitude_m.size() / 100000 + 1;
  for (std::size_t i = 0; i < altitude_m.size(); i += every) some.push_back(altitude_m[i]);
  const float low = value_at_share(some, 0.02), high = value_at_share(some, 0.995);
  return {low, std::max(high, low + 1.F)};
}

}  // namespace

ReliefMap relief_map(const Dem& dem, int longest_px) {
  const Reduced ground = reduce_to(dem.altitude_m, longest_px);
  const int n = ground.factor;
  ReliefMap out{Grid<glm::vec3>(ground.cells.width(), ground.cells.height()), n};
  const auto shaded = [&](float azimuth_deg, float altitude_deg) {
    return hillshade(ground.cells, n * dem.transform.cell_x, n * dem.transform.cell_y,
                     {azimuth_deg, altitude_deg, 1.4F});
  };
  const Grid<std::uint8_t> sun = shaded(315.F, 40.F), fill = shaded(250.F, 60.F);
  const Range range = usual_range(ground.cells);
  constexpr glm::vec3 no_data(0.30F);
  constexpr float share_of_sun = 0.75F, darkest = 0.30F;
  for (int y = 0; y < out.picture.height(); ++y)
    for (int x = 0; x < out.picture.width(); ++x) {
      if (!dem.filled.empty() && dem.filled(x * n, y * n) != 0) {
        out.picture(x, y) = no_data;
        continue;
      }
      const float light = (share_of_sun * static_cast<float>(sun(x, y)) +
                           (1.F - share_of_sun) * static_cast<float>(fill(x, y))) /
                          255.F;
      const float share = (ground.cells(x, y) - range.low) / (range.high - range.low);
      out.picture(x, y) =
          tint_at(std::clamp(share, 0.F, 1.F)) * std::min(1.F, darkest + (1.2F - darkest) * light);
    }
  return out;
}

PictureTiles picture_tiles(const Grid<glm::vec3>& picture, const TileParameters& parameters) {
  constexpr int strip_px = 64;
  PictureTiles out;
  std::mutex mutex;
  const auto read = [&](const TakeRows& take) {
    for (int y = 0; y < picture.height(); y += strip_px)
      take(part_of(picture, {0, y, picture.width(), std::min(y + strip_px, picture.height())}));
  };
  const auto keep = [&](int level, int column, int row, const Grid<glm::vec3>& tile) {
    std::string bytes = jpeg_bytes(tile, parameters.quality);
    const std::lock_guard lock(mutex);
    out.files[fmt::format("{}/{}_{}.jpg", level, column, row)] = std::move(bytes);
  };
  out.pyramid = cut_into_tiles(picture.width(), picture.height(), parameters.tile_px, read, keep);
  return out;
}

namespace {

constexpr std::size_t max_drawn_cells = 1'200'000;  // of the DEM for skyline and ridges
constexpr std::size_t max_proposals = 3;

double number_of(const HttpRequest& request, const std::string& name, double min, double max) {
  const std::string text = request.value(name);
  const std::optional<double> value = parse_number<double>(text);
  if (!value || !(*value >= min && *value <= max))
    throw Error(ErrorKind::usage, name, fmt::format("\"{}\"", text),
                fmt::format("a number, {} … {}", min, max));
  return *value;
}

// One line of text.
std::string one_line(std::string text) {
  constexpr std::size_t longest = 200;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  if (text.size() > longest)
    throw Error(ErrorKind::usage, "name", "has more than 200 bytes", "a shorter name");
  return text;
}

std::uint64_t asked_revision(const HttpRequest& request) {
  return static_cast<std::uint64_t>(number_of(request, "revision", 0.0, 1e15));
}

glm::dvec2 rounded_to(glm::dvec2 at, double digits) {
  return {std::round(at.x * digits) / digits, std::round(at.y * digits) / digits};
}

}  // namespace

// Members in the order in which they need each other.
struct PickingState {
  PickingState(PickingInput given, Progress& progress);

  HttpAnswer route(const HttpRequest& request);
  HttpAnswer change_pairs(const std::string& name, const std::string& body);
  HttpAnswer change_all(const std::function<void()>& change);
  void edit(const std::string& name, const std::string& body);
  ControlPair edited(ControlPair pair, const std::string& body) const;
  std::size_t pair_number(const std::string& body) const;
  glm::dvec2 pixel_of_moved(glm::dvec2 position, glm::dvec2 moved) const;
  std::optional<KnownPlace> ground_at(glm::dvec2 position) const;
  KnownPlace place_at(glm::dvec2 position) const;
  HttpAnswer place(const HttpRequest& request);
  HttpAnswer places(const HttpRequest& request);
  static HttpAnswer tile(const PictureTiles& tiles, const std::string& name);

  const Dem dem;
  const glm::ivec2 painting_px;
  std::mutex mutex;  // of the session
  PairsSession session;
  PickingSetup setup;
  PictureTiles painting;
  PictureTiles map;
  const Dem drawn;
  PairsFitter fitter;
  PageVisits visits;
  std::optional<HttpServer> server;
};

namespace {

PickingSetup make_setup(const PickingInput& given, const Dem& dem, Progress& progress) {
  progress.begin("looking for summits", 0.0);
  PickingSetup out;
  out.painting = given.painting_name;
  out.next = given.next;
  out.room = given.port < 0;
  out.crs = describe_crs(dem.crs);
  out.map_origin = {dem.transform.origin_x, dem.transform.origin_y};
  out.places = known_places(dem, given.named);
  return out;
}

PictureTiles make_map(const Dem& dem, PickingSetup& setup, Progress& progress) {
  progress.begin("drawing the map", 0.0);
  const ReliefMap relief = relief_map(dem);
  setup.map_px_m = static_cast<double>(relief.cells_per_px) *
                   glm::dvec2(dem.transform.cell_x, dem.transform.cell_y);
  PictureTiles out = picture_tiles(relief.picture);
  setup.map_tiles = out.pyramid;
  return out;
}

PictureTiles make_painting(const Grid<glm::vec3>& picture, PickingSetup& setup,
                           Progress& progress) {
  progress.begin("cutting the painting into tiles", 0.0);
  PictureTiles out = picture_tiles(picture);
  setup.painting_tiles = out.pyramid;
  return out;
}

}  // namespace

PickingState::PickingState(PickingInput given, Progress& progress)
    : dem(std::move(given.dem)),
      painting_px(given.painting.width(), given.painting.height()),
      session(given.pairs, painting_px, dem),
      setup(make_setup(given, dem, progress)),
      painting(make_painting(given.painting, setup, progress)),
      map(make_map(dem, setup, progress)),
      drawn(highest_cells(dem, max_drawn_cells)),
      fitter({drawn, setup.places, painting_px, given.registration}) {
  fitter.fit(session.revision(), session.pairs());
}

HttpAnswer PickingState::tile(const PictureTiles& tiles, const std::string& name) {
  const auto found = tiles.files.find(name);
  if (found == tiles.files.end()) return not_found("tile");
  return picture_answer(found->second, "image/jpeg");
}

// ---- changes

std::size_t PickingState::pair_number(const std::string& body) const {
  const int number = read_number_member(body, "pair", -1);
  if (number < 0 || number >= static_cast<int>(session.pairs().size()))
    throw Error(ErrorKind::usage, "pair", fmt::format("{}", number),
                fmt::format("0 … {}", static_cast<int>(session.pairs().size()) - 1));
  return static_cast<std::size_t>(number);
}

// Where the painting shows the ground of a position if it stands at `moved`.
glm::dvec2 PickingState::pixel_of_moved(glm::dvec2 position, glm::dvec2 moved) const {
  const std::shared_ptr<const FittedPairs> fit = fitter.latest().fit;
  if (fit == nullptr)
    throw Error(ErrorKind::usage, "moved", "no view is fitted yet", "more pairs, or a pixel");
  const Registration& found = fit->registration;
  const ViewPixel at =
      project_in_view(found.frame, found.view, moved, place_at(position).altitude_m);
  return glm::clamp(found.scale * glm::dvec2(at.u.value, at.v.value), glm::dvec2(0.0),
                    glm::dvec2(painting_px));
}

// A pair with what a request says of it.
ControlPair PickingState::edited(ControlPair pair, const std::string& body) const {
  if (const auto pixel = read_point_member(body, "pixel")) pair.pixel = rounded_to(*pixel, 10.0);
  if (const auto position = read_point_member(body, "position")) {
    place_at(*position);  // refuses what lies outside
    pair.lonlat = rounded_to(transform_point(dem.crs, normalize_crs("EPSG:4326"), *position), 1e7);
  }
  if (const auto moved = read_point_member(body, "moved"))
    pair.pixel = rounded_to(
        pixel_of_moved(read_point_member(body, "position").value_or(pair.position), *moved), 10.0);
  pair.name = one_line(read_text_member(body, "name", pair.name));
  pair.sure = read_flag_member(body, "sure").value_or(pair.sure);
  return pair;
}

void PickingState::edit(const std::string& name, const std::string& body) {
  std::vector<ControlPair> pairs = session.pairs();
  if (name == "add") {
    const bool painted = read_point_member(body, "pixel") || read_point_member(body, "moved");
    if (!painted || !read_point_member(body, "position"))
      throw Error(ErrorKind::usage, "pair", "lacks its pixel or its position", "both");
    pairs.push_back(edited({}, body));
  } else if (name == "change") {
    ControlPair& pair = pairs[pair_number(body)];
    pair = edited(pair, body);
  } else {
    pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(pair_number(body)));
  }
  session.change(pairs);
}

HttpAnswer PickingState::change_all(const std::function<void()>& change) {
  const std::lock_guard guard(mutex);
  const std::uint64_t before = session.revision();
  change();
  if (session.revision() != before) fitter.fit(session.revision(), session.pairs());
  return json_answer(pairs_json(session));
}

HttpAnswer PickingState::change_pairs(const std::string& name, const std::string& body) {
  if (name == "undo") return change_all([&] { session.undo(); });
  if (name == "redo") return change_all([&] { session.redo(); });
  if (name == "reload") return change_all([&] { session.reload(); });
  if (name == "save") return change_all([&] { session.save_over(); });
  return change_all([&] {
    // Numbers of pairs are those of a revision.
    const int revision = read_number_member(body, "revision", -1);
    if (revision >= 0 && static_cast<std::uint64_t>(revision) != session.revision())
      throw Error(ErrorKind::interrupted, "pairs", "superseded", "the present revision");
    edit(name, body);
  });
}

// ---- proposals

// The ground at a position; nothing outside the data.
std::optional<KnownPlace> PickingState::ground_at(glm::dvec2 position) const {
  const std::optional<double> altitude_m = measured_altitude_m(dem, position);
  if (!altitude_m) return std::nullopt;
  return KnownPlace{{}, position, *altitude_m, 0.0};
}

KnownPlace PickingState::place_at(glm::dvec2 position) const {
  const std::optional<KnownPlace> ground = ground_at(position);
  if (!ground)
    throw Error(ErrorKind::usage, "position", "the DEM has no data there", "a place of the map");
  return *ground;
}

// A place of the map: the known one near by, else the ground there.
HttpAnswer PickingState::place(const HttpRequest& request) {
  const glm::dvec2 at(number_of(request, "east", -1e8, 1e8),
                      number_of(request, "north", -1e8, 1e8));
  const double radius_m = number_of(request, "radius", 0.0, 1e6);
  PlaceAnswer out;
  out.known = radius_m > 0.0 ? nearest_place(setup.places, at, radius_m) : std::nullopt;
  out.place = out.known ? setup.places[*out.known] : place_at(at);
  const PairsFitter::Latest latest = fitter.latest();
  if (latest.fit != nullptr) {
    out.painted = propose_pixel(latest.fit->registration, latest.fit->field, out.place);
    if (latest.terrain != nullptr && latest.terrain->view != nullptr)
      out.seen = is_seen(*latest.terrain->view, out.place);
  }
  const std::lock_guard guard(mutex);
  out.pair = pair_of_place(session.pairs(), out.place.position, dem.cell_m());
  return json_answer(place_json(out));
}

// Proposes known places that a pixel of the painting may show.
HttpAnswer PickingState::places(const HttpRequest& request) {
  const glm::dvec2 pixel(number_of(request, "x", 0.0, painting_px.x),
                         number_of(request, "y", 0.0, painting_px.y));
  const PairsFitter::Latest latest = fitter.latest();
  Json proposals = Json::array();
  Json ground = Json::raw("null");
  if (latest.fit != nullptr) {
    const std::vector<bool> seen = latest.terrain != nullptr
                                       ? latest.terrain->seen
                                       : std::vector<bool>(setup.places.size(), true);
    std::vector<ProposedPlace> found = propose_places(setup.places, latest.fit->places, seen, pixel,
                                                      latest.fit->registration.scale);
    const std::lock_guard guard(mutex);
    std::erase_if(found, [&](const ProposedPlace& proposal) {
      return pair_of_place(session.pairs(), setup.places[proposal.place].position, dem.cell_m());
    });
    if (found.size() > max_proposals) found.resize(max_proposals);
    for (const ProposedPlace& proposal : found)
      proposals.add(place_json({.place = setup.places[proposal.place],
                                .known = proposal.place,
                                .pair = {},
                                .painted = latest.fit->places[proposal.place],
                                .seen = true,
                                .off_px = proposal.off_px}));
  }
  if (latest.terrain != nullptr && latest.terrain->view != nullptr) {
    const RegisteredView& view = *latest.terrain->view;
    const auto shown = view.map().to_geo(pixel * static_cast<double>(view.size_px().x) /
                                         static_cast<double>(painting_px.x));
    if (shown)
      if (const std::optional<KnownPlace> place = ground_at(shown->position))
        ground = place_json({.place = *place});
  }
  return json_answer(
      Json::object().add("proposals", std::move(proposals)).add("ground", std::move(ground)));
}

HttpAnswer PickingState::route(const HttpRequest& request) {
  const std::string& path = request.path;
  if (path.starts_with("painting/")) return tile(painting, path.substr(9));
  if (path.starts_with("map/")) return tile(map, path.substr(4));
  if (!path.starts_with("api/")) return page_file({"pick", "studio", "web"}, path);
  const std::string name = path.substr(4);
  if (request.method == "POST") {
    for (const char* known : {"add", "change", "remove", "undo", "redo", "reload", "save"})
      if (name == known) return change_pairs(name, request.body);
    if (name == "close") return json_answer(Json::object());
  } else {
    if (name == "setup") return json_answer(setup_json(setup));
    if (name == "pairs") return change_all([] {});
    if (name == "fit") {
      const std::uint64_t revision = asked_revision(request);
      return json_answer(fit_json(revision, fitter.fitted(revision).get(), painting_px));
    }
    if (name == "terrain") {
      const std::uint64_t revision = asked_revision(request);
      return json_answer(terrain_json(revision, fitter.terrain(revision).get()));
    }
    if (name == "place") return place(request);
    if (name == "places") return places(request);
  }
  return json_answer(
      error_json(Error(ErrorKind::usage, path, "no such request", "those of docs/registration.md")),
      404);
}

Picking::Picking(PickingInput input, Progress& progress) {
  const int port = input.port;
  state_ = std::make_unique<PickingState>(std::move(input), progress);
  if (port >= 0)
    state_->server.emplace(HttpParameters{.port = port, .token = random_token()},
                           [this](const HttpRequest& request) { return answer(request); });
}

Picking::~Picking() { stop(); }

std::string Picking::address() const { return state_->server->address(); }

void Picking::run() { state_->server->run(); }

void Picking::stop() {
  state_->fitter.end();
  if (state_->server) state_->server->stop();
}

bool Picking::is_left(double wait_s) const { return state_->visits.is_left(wait_s); }

HttpAnswer Picking::answer(const HttpRequest& request) {
  state_->visits.asked(request);
  try {
    return state_->route(request);
  } catch (const Error& error) {
    return error_answer(error);
  }
}

}  // namespace belvedere::tools
