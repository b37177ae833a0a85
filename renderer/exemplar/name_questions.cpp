#include "renderer/exemplar/name_questions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "base/config.h"
#include "base/land_cover_class.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

constexpr double sure_of_sky = 0.9;
constexpr double min_rough = 0.4;
constexpr double max_rough = 3.0;
constexpr double max_upper_edge = 0.3;

double log_rough(double rough) { return exact::log(std::clamp(rough, min_rough, max_rough)); }

// What groups are compared by, scaled so that a difference of 1 is seen at once. Where across the
// painting a group lies does not count: woods on both sides are one question.
constexpr std::size_t look_axes = 6;
using LookAxes = std::array<double, look_axes>;
LookAxes axes_of(const PartLook& look) {
  const double level = exact::log(std::max(look.down, 1e-4) / std::max(look.across, 1e-4));
  return {8.3 * look.oklab.x, 37.5 * look.oklab.y,   37.5 * look.oklab.z,
          5.0 * look.height,  log_rough(look.rough), std::clamp(level, -1.0, 1.0)};
}

// Groups that one question is asked for.
struct LikeGroups {
  LookAxes look{};  // mean over the pixels
  double pixels = 0.0;
  std::vector<std::size_t> groups;
};

// How soon two are joined: small ones before large ones that are slightly more alike.
double dissimilarity(const LikeGroups& a, const LikeGroups& b, double all_pixels) {
  double squares = 0.0;
  for (std::size_t k = 0; k < look_axes; ++k)
    squares += (a.look[k] - b.look[k]) * (a.look[k] - b.look[k]);
  const double share = std::min(a.pixels, b.pixels) / all_pixels;
  return std::sqrt(squares) * exact::pow(share, 0.4);
}

void join_groups(LikeGroups& to, const LikeGroups& from) {
  const double pixels = to.pixels + from.pixels;
  for (std::size_t k = 0; k < look_axes; ++k)
    to.look[k] = (to.look[k] * to.pixels + from.look[k] * from.pixels) / pixels;
  to.pixels = pixels;
  to.groups.insert(to.groups.end(), from.groups.begin(), from.groups.end());
}

// The group, one of `nodes`, of each piece; nodes come after what they were joined from.
Partition group_of_pieces(const JoinTree& tree, const std::vector<std::uint16_t>& nodes) {
  std::vector<std::uint16_t> of(tree.pieces + tree.joins.size(), no_piece);
  for (std::size_t k = 0; k < nodes.size(); ++k) of[nodes[k]] = static_cast<std::uint16_t>(k);
  for (std::size_t k = tree.joins.size(); k-- > 0;)
    if (const std::uint16_t group = of[tree.pieces + k]; group != no_piece)
      for (const std::uint16_t part : tree.joins[k]) of[part] = group;
  of.resize(tree.pieces);
  return of;
}

PlaceName read_place_name(const ConfigValue& value, const std::string& path) {
  allow_only(as_table(value, path), {"at", "class"}, path);
  const ConfigValue& at = required(value, "at", path, "at = [across, down], shares of the size");
  const std::vector<double> shares = as_numbers(at, path, 2, 0.0, 1.0);
  const ConfigValue& name = required(value, "class", path, "class = \"forest\" or another class");
  if (as_string(name, path) == not_used_name) return {shares[0], shares[1], unused_label};
  const std::optional<LandCoverClass> id = find_class(as_string(name, path));
  if (!id) refuse_value(name, path, describe(name), "the name of a class, or \"not used\"");
  return {shares[0], shares[1], static_cast<std::uint8_t>(*id)};
}

}  // namespace

double sky_probability(const PartLook& look, const SkyModel& model) {
  const double sum = model.constant + model.lightness * look.oklab.x + model.yellow * look.oklab.z +
                     model.height * look.height +
                     model.upper_edge * std::min(look.upper_edge, max_upper_edge) +
                     model.log_rough * log_rough(look.rough);
  return 1.0 / (1.0 + exact::exp(-sum));
}

NameQuestions ask_names(const PaintingSegments& segments, const std::vector<std::uint16_t>& nodes,
                        std::size_t most, const SkyModel& model) {
  constexpr auto sky = static_cast<std::uint8_t>(LandCoverClass::sky);
  std::vector<LikeGroups> questions;
  double all_pixels = 0.0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const PartLook& look = segments.looks[nodes[k]];
    all_pixels += segments.pixels[nodes[k]];
    if (segments.inferred[nodes[k]] != sky || sky_probability(look, model) <= sure_of_sky)
      questions.push_back({axes_of(look), segments.pixels[nodes[k]], {k}});
  }
  while (questions.size() > most) {
    double least = std::numeric_limits<double>::max();
    std::size_t first = 0, second = 1;
    for (std::size_t a = 0; a < questions.size(); ++a)
      for (std::size_t b = a + 1; b < questions.size(); ++b) {
        const double value = dissimilarity(questions[a], questions[b], all_pixels);
        if (value >= least) continue;
        least = value;
        first = a;
        second = b;
      }
    join_groups(questions[first], questions[second]);
    questions.erase(questions.begin() + static_cast<std::ptrdiff_t>(second));
  }
  std::stable_sort(questions.begin(), questions.end(),
                   [](const LikeGroups& a, const LikeGroups& b) { return a.pixels > b.pixels; });
  NameQuestions out{std::vector<std::uint16_t>(nodes.size(), no_question), questions.size()};
  for (std::size_t k = 0; k < questions.size(); ++k)
    for (const std::size_t group : questions[k].groups)
      out.of_group[group] = static_cast<std::uint16_t>(k);
  return out;
}

std::vector<PlaceName> read_place_names(const std::string& path) {
  const ConfigValue root = read_config(path);
  allow_only(as_table(root, path), {"named"}, path);
  std::vector<PlaceName> out;
  const ConfigValue& places = required(root, "named", path, "[[named]] places");
  for (const ConfigValue& place : as_array(places, path))
    out.push_back(read_place_name(place, path));
  return out;
}

NamedGroups name_groups(const PaintingSegments& segments, std::size_t count,
                        const std::vector<PlaceName>& places) {
  const auto along = [](double share, int size) {
    return std::min(static_cast<int>(share * size), size - 1);
  };
  NamedGroups out;
  out.nodes = cut_nodes(segments.tree, count);
  for (;;) {
    out.of_pieces = group_of_pieces(segments.tree, out.nodes);
    out.classes.clear();
    for (const std::uint16_t node : out.nodes) out.classes.push_back(segments.inferred[node]);
    out.named.assign(out.nodes.size(), 0);
    std::optional<std::size_t> divided;
    for (const PlaceName& place : places) {
      const std::uint16_t piece = segments.pieces(along(place.across, segments.pieces.width()),
                                                  along(place.down, segments.pieces.height()));
      if (piece == no_piece) continue;
      const std::size_t group = out.of_pieces[piece];
      if (out.named[group] != 0 && out.classes[group] != place.class_id &&
          out.nodes[group] >= segments.tree.pieces)
        divided = group;
      out.classes[group] = place.class_id;
      out.named[group] = 1;
    }
    if (!divided) return out;
    const auto& parts = segments.tree.joins[out.nodes[*divided] - segments.tree.pieces];
    out.nodes[*divided] = parts[0];
    out.nodes.push_back(parts[1]);
  }
}

}  // namespace belvedere
