#include "renderer/ground/braided_rivers.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <iterator>

#include "base/math.h"
#include "base/parallel.h"
#include "renderer/ground/laid_rivers.h"
#include "renderer/ground/river_banks.h"

namespace belvedere {
namespace {

// Lengths in half widths of the river.
constexpr double broadest = 4.5;     // half of the gravel
constexpr double braids_from = 2.0;  // half of the floor: one thread below …
constexpr double braids_full = 3.5;  // … and the full breadth of gravel from here
constexpr double look = 0.5;         // step to the sides of the floor
constexpr double meeting = 6.0;  // deviation of the noise of threads, which meet twice as far apart
constexpr double thread = 0.42;  // half width of a thread …
constexpr double joined = 0.24;  // … and more for each that it joins
constexpr double varying = 0.2;  // of the width
// Half widths on the sheet, in its units, from which braids are drawn.
constexpr double drawn_from = 0.7;
constexpr double drawn_full = 1.4;
constexpr double closed = 0.22;      // gaps below this share of the gravel close: threads meet
constexpr double normal_span = 0.9;  // deviations that reach the edge of the gravel
constexpr double bundle = 0.35;      // share of the room left by which all threads move together
constexpr double ragged_edge = 0.14;
constexpr std::size_t lanes = 3;
constexpr std::size_t end_steps = 8;  // positions over which gravel begins and ends
constexpr int smoothing_passes_braid = 24;
// Parts of the stream of banks.
constexpr std::uint64_t lane_part = 9;
constexpr std::uint64_t edge_part = lane_part + lanes;
constexpr std::uint64_t thread_part = edge_part + 1;
constexpr std::uint64_t bundle_part = thread_part + lanes;

// To the left of a line at each position.
std::vector<glm::dvec2> left_of(const std::vector<glm::dvec2>& line) {
  std::vector<glm::dvec2> left(line.size(), glm::dvec2(0.0));
  for (std::size_t i = 0; i < line.size(); ++i) {
    const glm::dvec2 way =
        line[std::min(i + 4, line.size() - 1)] - line[i - std::min<std::size_t>(i, 4)];
    const double length = glm::length(way);
    if (length > 0.0) left[i] = glm::dvec2(-way.y, way.x) / length;
  }
  return left;
}

// Half the breadth of the gravel along a river, m: the floor's narrower side, the narrowest nearby.
std::vector<double> gravel_half_m(const CoverRiver& river, const std::vector<glm::dvec2>& left,
                                  const std::vector<double>& units_per_m,
                                  const BraidParameters& p) {
  const std::size_t count = river.positions.size();
  std::vector<double> own(count, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto half = static_cast<double>(river.half_width_m[i]);
    const double drawn = smoothstep(drawn_from, drawn_full, half * units_per_m[i]);
    double room = drawn > 0.0 ? broadest : 0.0;
    for (const double side : {-1.0, 1.0})
      for (double away = 1.0 + look; away <= room; away += look)
        if (!p.is_floor(river.positions[i], river.positions[i] + side * away * half * left[i]))
          room = away - look;
    own[i] = drawn * half * room * smoothstep(braids_from, braids_full, room);
  }
  std::vector<double> gravel(count, 0.0);
  for (std::size_t i = end_steps; i + end_steps < count; ++i)
    gravel[i] = *std::min_element(own.begin() + static_cast<std::ptrdiff_t>(i - end_steps),
                                  own.begin() + static_cast<std::ptrdiff_t>(i + end_steps + 1));
  for (int pass = 0; pass < smoothing_passes_braid; ++pass) {
    const std::vector<double> before = gravel;
    for (std::size_t i = 1; i + 1 < count; ++i)
      gravel[i] = 0.5 * before[i] + 0.25 * (before[i - 1] + before[i + 1]);
  }
  return gravel;
}

// Noise of a braid, within -1…1.
double braid_noise(std::uint64_t seed, std::uint64_t part, glm::dvec2 at, double sigma_m) {
  return std::clamp(bank_noise(seed, part, at, sigma_m), -1.0, 1.0);
}

// Threads at a position: their distances to the left of the line as shares of the gravel, -1…1,
// from right to left. Where two come near each other they are one.
std::array<double, lanes> lanes_at(std::uint64_t seed, glm::dvec2 at, double sigma_m) {
  std::array<double, lanes> lane{};
  for (std::size_t k = 0; k < lanes; ++k)
    lane[k] = std::clamp(braid_noise(seed, lane_part + k, at, sigma_m) / normal_span, -1.0, 1.0);
  std::sort(lane.begin(), lane.end());
  const double right = std::max(0.0, lane[1] - lane[0] - closed);
  const double both = right + std::max(0.0, lane[2] - lane[1] - closed);
  // Of gaps that add up to 2 at most, none lies farther than 4/3 from the mean.
  const double mean = (right + both) / 3.0;
  lane = {-0.75 * mean, 0.75 * (right - mean), 0.75 * (both - mean)};
  const double room = 1.0 - std::max(-lane.front(), lane.back());
  const double moved = bundle * room * braid_noise(seed, bundle_part, at, 2.0 * sigma_m);
  for (double& one : lane) one += moved;
  return lane;
}

std::vector<CoverRiver> braid_river(const CoverRiver& river, const std::vector<double>& units_per_m,
                                    const BraidParameters& p) {
  const std::size_t count = river.positions.size();
  if (count <= 2 * end_steps || river.painted_as != LandCoverClass::water) return {river};
  const std::vector<glm::dvec2> left = left_of(river.positions);
  const std::vector<double> gravel = gravel_half_m(river, left, units_per_m, p);
  const auto is_gravel = [](double half_m) { return half_m > 0.0; };
  const auto first = std::find_if(gravel.begin(), gravel.end(), is_gravel);
  if (first == gravel.end()) return {river};
  const auto last = std::find_if(gravel.rbegin(), gravel.rend(), is_gravel).base();
  std::vector<CoverRiver> out(lanes + 2, river);  // gravel, the line, threads
  out[0].painted_as = LandCoverClass::sand;
  out[0].kind = shore_kind;
  for (std::size_t n = 0; n < out.size(); ++n)
    if (n != 1) out[n].positions.clear(), out[n].half_width_m.clear();
  for (auto i = static_cast<std::size_t>(first - gravel.begin());
       i < static_cast<std::size_t>(last - gravel.begin()); ++i) {
    const glm::dvec2 at = river.positions[i];
    const auto half = static_cast<double>(river.half_width_m[i]);
    const double sigma_m = meeting * half;
    const auto noise = [&](std::uint64_t part) { return braid_noise(p.seed, part, at, sigma_m); };
    const double belt = gravel[i] * (1.0 - ragged_edge + ragged_edge * noise(edge_part));
    const auto add = [&](CoverRiver& to, double aside, double half_m) {
      to.positions.push_back(at + aside * left[i]);
      to.half_width_m.push_back(static_cast<float>(half_m));
    };
    add(out[0], 0.0, belt);
    out[1].half_width_m[i] *= static_cast<float>(1.0 - smoothstep(half, 2.0 * half, belt));
    const std::array<double, lanes> lane = lanes_at(p.seed, at, sigma_m);
    const double usable = std::max(0.0, belt - half);
    const auto near = [&](std::size_t k) {
      return 1.0 - smoothstep(0.0, 2.0 * thread * half, usable * (lane[k + 1] - lane[k]));
    };
    const double right = near(0);
    const double beyond = near(1);
    const std::array<double, lanes> joins{right + right * beyond, right + beyond,
                                          beyond + right * beyond};
    for (std::size_t k = 0; k < lanes; ++k)
      add(out[2 + k], usable * lane[k],
          half * (thread * (1.0 + varying * noise(thread_part + k)) + joined * joins[k]) *
              smoothstep(0.0, half, belt));
  }
  return out;
}

}  // namespace

std::vector<CoverRiver> braid_rivers(std::span<const CoverRiver> rivers,
                                     const BraidParameters& parameters) {
  std::vector<std::vector<CoverRiver>> each(rivers.size());
  parallel_ranges<std::size_t>(rivers.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      each[i] = braid_river(rivers[i], parameters.units_per_m(i), parameters);
  });
  std::vector<CoverRiver> out;
  for (std::vector<CoverRiver>& one : each)
    std::move(one.begin(), one.end(), std::back_inserter(out));
  std::stable_partition(out.begin(), out.end(), [](const CoverRiver& line) {
    return line.painted_as == LandCoverClass::sand;
  });
  return out;
}

}  // namespace belvedere
