#include "renderer/register/register_by_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "renderer/image/oklab.h"
#include "renderer/register/match_paint.h"
#include "renderer/register/registered_ground.h"
#include "renderer/register/registered_scene.h"
#include "renderer/register/registered_view.h"

namespace belvedere {
namespace {

struct Round {
  int width_px = 600;  // of the pictures that are compared
  MatchPaintParameters match;
};
constexpr std::array<Round, 3> rounds = {
    {{400, {.half_px = 20, .reach_px = {15, 12}, .spacing_px = 18, .prior_px = 4.0}},
     {600, {.half_px = 22, .reach_px = {15, 12}, .spacing_px = 23, .prior_px = 4.0}},
     {600, {.half_px = 17, .reach_px = {11, 9}, .spacing_px = 20, .prior_px = 3.0}}}};

// Means of the painting in OKLab, of that size.
Grid<glm::vec3> reduced_paint(const Grid<glm::vec3>& painting, glm::ivec2 size) {
  const auto range = [](int i, int count, int whole) {
    const std::int64_t from = std::int64_t{i} * whole / count;
    const std::int64_t to = (std::int64_t{i + 1} * whole + count - 1) / count;
    return std::pair(static_cast<int>(from), static_cast<int>(to));
  };
  Grid<glm::vec3> out(size.x, size.y);
  parallel_rows(size.y, [&](int y) {
    const auto [top, bottom] = range(y, size.y, painting.height());
    for (int x = 0; x < size.x; ++x) {
      const auto [left, right] = range(x, size.x, painting.width());
      glm::dvec3 sum(0.0);
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) sum += glm::dvec3(painting(u, v));
      out(x, y) = glm::vec3(
          to_oklab(glm::vec3(sum / static_cast<double>((bottom - top) * (right - left)))));
    }
  });
  return out;
}

std::vector<PaintedPlace> painted_places(const std::vector<PaintMatch>& matches,
                                         const RegisteredGround& ground, double px) {
  std::vector<PaintedPlace> out;
  constexpr double min_sigma_px = 2.5;  // of 1200: forests overhang the ground that they stand on
  for (const PaintMatch& match : matches) {
    PaintedPlace painted;
    painted.place.pixel = px * (glm::dvec2(match.pixel) + 0.5 + match.shift_px);
    painted.place.position = ground.position(match.pixel.x, match.pixel.y);
    painted.place.altitude_m = static_cast<double>(ground.altitude_m(match.pixel.x, match.pixel.y));
    const double min_px = min_sigma_px * px * ground.altitude_m.width() / 1200.0;
    painted.sigma_px = {exact::hypot(px * match.sigma_px.x, min_px),
                        exact::hypot(px * match.sigma_px.y, min_px)};
    out.push_back(painted);
  }
  return out;
}

}  // namespace

PaintRegistration register_by_paint(const Registration& from_pairs,
                                    std::span<const ControlPair> pairs,
                                    const Grid<glm::vec3>& painting, const Dem& dem,
                                    Progress& progress) {
  PaintRegistration out{from_pairs};
  const glm::ivec2 painting_px(painting.width(), painting.height());
  for (const Round& round : rounds) {
    const int width = round.width_px;
    if (painting.width() < width) continue;
    const glm::ivec2 size(width, std::max(1, width * painting.height() / painting.width()));
    const double px = static_cast<double>(painting.width()) / width;
    RegisteredGround ground = trace_registered(RegisteredView(
        out.registration, registered_scene(out.registration, painting_px), dem, size, progress));
    for (float& sigma : ground.sigma_px) sigma /= static_cast<float>(px);
    MatchPaintParameters parameters = round.match;
    constexpr double independent_px2 = 50.0;  // of a painting 1200 px wide: a stroke
    parameters.independent_px2 = independent_px2 * (width / 1200.0) * (width / 1200.0);
    const std::vector<PaintMatch> matches =
        match_paint(reduced_paint(painting, size), ground, parameters);
    constexpr std::size_t min_matches = 8;
    if (matches.size() < min_matches) continue;
    std::optional<Registration> better =
        refine_registration(out.registration, pairs, painted_places(matches, ground, px));
    if (!better) continue;
    out.registration = *std::move(better);
    out.matches = matches.size();
    ++out.rounds;
  }
  return out;
}

}  // namespace belvedere
