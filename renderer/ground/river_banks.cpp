#include "renderer/ground/river_banks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "base/math.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

// Lengths in half widths of the river.
constexpr double spacing_widths = 1.8;  // of positions
constexpr double tangent_widths = 2.0;  // over which directions are taken
constexpr double bend_gain = 10.0;      // of curvature times half width: 1 is a full bend
constexpr double noise_widths = 5.0;    // deviation of the noise of banks
constexpr double winding_widths = 4.5;  // the same of the windings
constexpr std::uint64_t winding_part = 8;
constexpr double source_widths = 16.0;     // over which a source grows to its width
constexpr double end_widths = 4.0;         // over which the line returns to its ends
constexpr double junction_widths = 8.0;    // of the wider river: where a tributary turns
constexpr double downstream_share = 0.62;  // of that, how far down it enters
// Shares of the half width by which a bank moves inwards.
constexpr double always = -0.04;
constexpr double inner_bank = 0.62;  // bends are narrower than straight reaches
constexpr double outer_bank = 0.13;
constexpr double broken = 0.19;
constexpr double min_in = -0.50;
constexpr double max_in = 0.60;
constexpr float source_width = 0.40F;
constexpr std::size_t max_positions = 20000;
constexpr std::size_t noise_step = 2;    // positions
constexpr std::size_t part_length = 32;  // of a river with a box of its own, positions

struct Line {
  std::vector<glm::dvec2> positions;
  std::vector<double> half_m;
  std::vector<double> along_m;  // from the source
};

double length_of(const CoverRiver& river) {
  double sum = 0.0;
  for (std::size_t i = 1; i < river.positions.size(); ++i)
    sum += glm::length(river.positions[i] - river.positions[i - 1]);
  return sum;
}

double mean_half_m(const CoverRiver& river) {
  double sum = 0.0;
  for (const float half : river.half_width_m) sum += static_cast<double>(half);
  return sum / static_cast<double>(river.half_width_m.size());
}

// Positions at even distances.
Line resampled(const CoverRiver& river, double step_m) {
  Line line;
  double next = 0.0;
  double passed = 0.0;
  for (std::size_t i = 1; i < river.positions.size(); ++i) {
    const glm::dvec2 from = river.positions[i - 1];
    const glm::dvec2 to = river.positions[i];
    const double length = glm::length(to - from);
    if (!(length > 0.0)) continue;
    while (next <= passed + length) {
      const double t = (next - passed) / length;
      line.positions.push_back(glm::mix(from, to, t));
      line.half_m.push_back(glm::mix(static_cast<double>(river.half_width_m[i - 1]),
                                     static_cast<double>(river.half_width_m[i]), t));
      line.along_m.push_back(next);
      next += step_m;
    }
    passed += length;
  }
  if (line.positions.empty() || line.positions.back() != river.positions.back()) {
    line.positions.push_back(river.positions.back());
    line.half_m.push_back(static_cast<double>(river.half_width_m.back()));
    line.along_m.push_back(passed);
  }
  return line;
}

// The direction downstream around a position; 0 where the line has no length.
glm::dvec2 direction_at(const Line& line, std::size_t i, std::size_t reach) {
  const std::size_t from = i - std::min(i, reach);
  const std::size_t to = std::min(i + reach, line.positions.size() - 1);
  const glm::dvec2 way = line.positions[to] - line.positions[from];
  const double length = glm::length(way);
  return length > 0.0 ? way / length : glm::dvec2(0.0);
}

// How far a bank moves inwards; `inner`: 1 on the inner side of a full bend, -1 on the outer.
double inwards(double inner, double noise) {
  return std::clamp(always + inner_bank * smoothstep(0.15, 0.9, inner) -
                        outer_bank * smoothstep(0.15, 0.9, -inner) + broken * noise,
                    min_in, max_in);
}

CoverRiver bank_river(CoverRiver river, std::uint64_t seed, double winding) {
  if (river.positions.size() < 3) return river;
  const double mean_m = mean_half_m(river);
  const double length_m = length_of(river);
  if (!(mean_m > 0.0) || length_m < 6.0 * mean_m) return river;
  const double step_m =
      std::max(spacing_widths * mean_m, length_m / static_cast<double>(max_positions));
  const Line line = resampled(river, step_m);
  const std::size_t count = line.positions.size();
  const auto reach =
      static_cast<std::size_t>(std::max(1.0, std::round(tangent_widths * mean_m / step_m)));
  // Noise is smooth over several positions.
  std::array<std::vector<double>, 2> noise;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t i = 0; i < count + noise_step; i += noise_step) {
      const glm::dvec2 at = line.positions[std::min(i, count - 1)];
      noise[side].push_back(std::clamp(gaussian_noise(stream_seed(seed, Stream::river_banks, side),
                                                      at.x, at.y, noise_widths * mean_m),
                                       -2.0, 2.0));
    }
  const auto noise_at = [&](std::size_t side, std::size_t i) {
    const std::size_t k = i / noise_step;
    return glm::mix(noise[side][k], noise[side][k + 1],
                    static_cast<double>(i % noise_step) / static_cast<double>(noise_step));
  };
  CoverRiver out = std::move(river);
  out.positions.clear();
  out.half_width_m.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 at = line.positions[i];
    const double half = line.half_m[i];
    const glm::dvec2 way = direction_at(line, i, reach);
    const glm::dvec2 before = direction_at(line, i - std::min(i, 2 * reach), reach);
    const glm::dvec2 after = direction_at(line, std::min(i + 2 * reach, count - 1), reach);
    const glm::dvec2 left(-way.y, way.x);
    // Curvature times half width: > 0 where the river turns left.
    const double turn = before.x * after.y - before.y * after.x;
    const double bend = std::clamp(
        bend_gain * turn * half / (4.0 * static_cast<double>(reach) * step_m), -1.2, 1.2);
    // The inner bank of a left turn is the left one.
    const double left_m = half * (1.0 - inwards(bend, noise_at(0, i)));
    const double right_m = half * (1.0 - inwards(-bend, noise_at(1, i)));
    const double to_end =
        std::min(line.along_m[i], line.along_m.back() - line.along_m[i]) / (end_widths * mean_m);
    const double wound =
        winding > 0.0
            ? winding * half *
                  std::clamp(bank_noise(seed, winding_part, at, winding_widths * half), -2.0, 2.0)
            : 0.0;
    const double moved = (0.5 * (left_m - right_m) + wound) * smoothstep(to_end);
    const double grown = static_cast<double>(source_width) +
                         (1.0 - static_cast<double>(source_width)) *
                             smoothstep(line.along_m[i] / (source_widths * mean_m));
    out.positions.push_back(at + moved * left);
    out.half_width_m.push_back(static_cast<float>(0.5 * (left_m + right_m) * grown));
  }
  return out;
}

struct Box {
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};
  bool holds(glm::dvec2 p) const {
    return p.x >= low.x && p.y >= low.y && p.x <= high.x && p.y <= high.y;
  }
};
// A part of a river and everything that may flow into it.
struct Part {
  std::size_t river = 0;
  std::size_t first = 0;
  std::size_t end = 0;
  Box box;
};

constexpr double mouth_reach = 1.5;  // half widths of the wider river

std::vector<Part> parts_of(const std::vector<CoverRiver>& rivers) {
  std::vector<Part> parts;
  for (std::size_t k = 0; k < rivers.size(); ++k) {
    const CoverRiver& river = rivers[k];
    if (river.positions.size() < 3) continue;
    for (std::size_t first = 0; first < river.positions.size(); first += part_length) {
      Part part{k,
                first,
                std::min(first + part_length, river.positions.size()),
                {river.positions[first], river.positions[first]}};
      for (std::size_t i = first; i < part.end; ++i) {
        const double reach = mouth_reach * static_cast<double>(river.half_width_m[i]);
        part.box.low = glm::min(part.box.low, river.positions[i] - reach);
        part.box.high = glm::max(part.box.high, river.positions[i] + reach);
      }
      parts.push_back(part);
    }
  }
  return parts;
}

// Where the end of a river meets a wider one: the river and the position in it.
struct Mouth {
  const CoverRiver* into = nullptr;
  std::size_t at = 0;
};

Mouth find_mouth(const std::vector<CoverRiver>& rivers, const std::vector<Part>& parts,
                 std::size_t own) {
  const glm::dvec2 end = rivers[own].positions.back();
  const float half = rivers[own].half_width_m.back();
  Mouth mouth;
  double nearest = 1.0;
  for (const Part& part : parts) {
    if (part.river == own || !part.box.holds(end)) continue;
    const CoverRiver& other = rivers[part.river];
    for (std::size_t i = part.first; i < part.end; ++i) {
      if (other.half_width_m[i] < half) continue;
      const double distance = glm::length(other.positions[i] - end) /
                              (mouth_reach * static_cast<double>(other.half_width_m[i]));
      if (distance >= nearest) continue;
      nearest = distance;
      mouth = {&other, i};
    }
  }
  return mouth;
}

// The last part of a river, turned downstream to where it enters.
void turn_downstream(CoverRiver& river, const Mouth& mouth) {
  const CoverRiver& main = *mouth.into;
  const double turned_m = junction_widths * static_cast<double>(main.half_width_m[mouth.at]);
  std::size_t to = mouth.at;
  double passed = 0.0;
  while (to + 1 < main.positions.size() && passed < downstream_share * turned_m) {
    passed += glm::length(main.positions[to + 1] - main.positions[to]);
    ++to;
  }
  const glm::dvec2 shift = main.positions[to] - river.positions.back();
  double from_end = 0.0;
  for (std::size_t i = river.positions.size(); i-- > 0;) {
    const glm::dvec2 at = river.positions[i];
    if (from_end >= turned_m) break;
    if (i > 0) {
      const double next = glm::length(river.positions[i - 1] - at);
      river.positions[i] += shift * square(1.0 - from_end / turned_m);
      from_end += next;
    }
  }
}

}  // namespace

double bank_noise(std::uint64_t seed, std::uint64_t part, glm::dvec2 at, double sigma_m) {
  constexpr std::uint64_t octaves = 64;  // more than there are, of every part
  const double octave = exact::log2(std::max(sigma_m, 1.0));
  const double below = std::floor(octave);
  const double above = octave - below;
  const auto of = [&](double power) {
    const std::uint64_t key = octaves * part + static_cast<std::uint64_t>(power);
    return gaussian_noise(stream_seed(seed, Stream::river_banks, key), at.x, at.y,
                          exact::exp2(power));
  };
  return ((1.0 - above) * of(below) + above * of(below + 1.0)) /
         std::sqrt(above * above + (1.0 - above) * (1.0 - above));
}

std::vector<CoverRiver> with_banks(std::vector<CoverRiver> rivers, std::uint64_t seed,
                                   double winding) {
  parallel_ranges<std::size_t>(rivers.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      rivers[i] = bank_river(std::move(rivers[i]), seed, winding);
  });
  const std::vector<Part> parts = parts_of(rivers);
  // All mouths first: they are those of rivers that have not turned yet.
  std::vector<Mouth> mouths(rivers.size());
  parallel_ranges<std::size_t>(rivers.size(), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i)
      if (rivers[i].positions.size() >= 3) mouths[i] = find_mouth(rivers, parts, i);
  });
  const std::vector<CoverRiver> before = rivers;
  for (std::size_t i = 0; i < rivers.size(); ++i)
    if (mouths[i].into != nullptr)
      turn_downstream(rivers[i], {&before[static_cast<std::size_t>(mouths[i].into - rivers.data())],
                                  mouths[i].at});
  return rivers;
}

}  // namespace belvedere
