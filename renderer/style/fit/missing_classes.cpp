#include "renderer/style/fit/missing_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/math_exact.h"
#include "base/matrix/matrix.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr std::size_t min_sky_texels = 600;
constexpr std::size_t max_paint = 8'000;  // texels that sample the painting's colours
constexpr double to_paint = 0.6;          // share of the shift towards colours of the painting
constexpr double paint_lightness = 0.06;  // sigmas of L, and of a and b, of similar colours
constexpr double paint_hue = 0.045;
constexpr double bare_chroma = 0.6;  // of bare ground, over that of the ground
constexpr double to_green = 0.75;    // share of the shift towards the painting's green
constexpr double green_lightness = 0.14;
constexpr double green_reach_cos = 0.766;            // cosine of ±40° of hue
constexpr double max_turn = std::numbers::pi / 6.0;  // of hue, between related classes
constexpr double variance_floor = 1e-5;              // OKLab², limits the amplification of noise

bool is_green(LandCoverClass id) {
  return id == pasture || id == alpine_grass || id == valley_floor || id == forest || id == shrub;
}

std::vector<glm::dvec3> paint_of(const std::vector<glm::vec3>& every) {
  const std::size_t step = std::max<std::size_t>(1, every.size() / max_paint);
  std::vector<glm::dvec3> paint;
  for (std::size_t i = 0; i < every.size(); i += step) paint.emplace_back(every[i]);
  return paint;
}

// Mean and covariance of weighted colours.
struct ColourSpread {
  glm::dvec3 mean{0.0};
  glm::dmat3 covariance{0.0};
  double hue() const { return std::sqrt(covariance[1][1] + covariance[2][2]); }
};

class SpreadSum {
 public:
  void add(const glm::dvec3& colour, double weight) {
    weight_ += weight;
    sum_ += weight * colour;
    products_ += weight * glm::outerProduct(colour, colour);
  }
  ColourSpread spread() const {
    const glm::dvec3 mean = sum_ / weight_;
    return {mean, products_ / weight_ - glm::outerProduct(mean, mean)};
  }

 private:
  double weight_ = 0.0;
  glm::dvec3 sum_{0.0};
  glm::dmat3 products_{0.0};
};

// Optimal linear transport (Monge–Kantorovich) of the reference's colours to the ground's.
struct ColourRelation {
  glm::dvec3 from{0.0};
  glm::dvec3 to{0.0};
  glm::dmat3 matrix{1.0};
  double hue_gain = 1.0;  // kc: spread of hue, painting over reference
  glm::dvec3 operator()(const glm::dvec3& colour) const { return to + matrix * (colour - from); }
};

ColourRelation fit_relation(const StylePainting& painting, const ClassRamps& reference) {
  SpreadSum from;
  for (std::size_t c = 1; c < reference.size(); ++c)
    for (std::size_t k = 0; k < reference[c].size(); ++k) from.add(reference[c][k], tone_shares[k]);
  SpreadSum to;
  for (const glm::vec3& texel : painting.ground) to.add(texel, 1.0);
  const ColourSpread a = from.spread();
  const ColourSpread b = to.spread();
  return {a.mean, b.mean,
          linear_transport_map(a.covariance, b.covariance, variance_floor, {0.45, 1.8}),
          std::clamp(b.hue() / std::max(a.hue(), 1e-6), 0.55, 1.15)};
}

// Ramp of water from the bluest 30 % of the sky, which it reflects; dark to light.
std::optional<LabRamp> water_from_sky(const StylePainting& painting) {
  std::vector<glm::vec3> texels = class_texels(painting.colours, painting.drawn, sky, 200'000);
  if (texels.size() <= min_sky_texels) return std::nullopt;
  // Low a + b: blue rather than violet.
  std::vector<float> warmth;
  warmth.reserve(texels.size());
  for (const glm::vec3& texel : texels) warmth.push_back(texel.y + texel.z);
  const float bluest = value_at_share(std::move(warmth), 0.30);
  std::erase_if(texels, [&](const glm::vec3& texel) { return texel.y + texel.z > bluest; });
  std::stable_sort(texels.begin(), texels.end(),
                   [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
  constexpr std::array<std::array<double, 2>, 4> shares = {
      {{0.0, 0.1}, {0.1, 0.4}, {0.4, 0.8}, {0.9, 1.0}}};
  constexpr std::array<double, 4> darker = {0.22, 0.14, 0.06, 0.0};
  LabRamp ramp{};
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const auto count = static_cast<double>(texels.size());
    const auto begin = static_cast<std::size_t>(shares[k][0] * count);
    const auto end = std::max(begin + 1, static_cast<std::size_t>(shares[k][1] * count));
    for (int channel = 0; channel < 3; ++channel) {
      std::vector<float> values;
      for (std::size_t i = begin; i < end; ++i) values.push_back(texels[i][channel]);
      ramp[k][channel] = static_cast<double>(middle_value(std::move(values)));
    }
    ramp[k].x -= darker[k];
  }
  return ramp;
}

// The ramp of a class from that of a related class: they differ as in the reference, in lightness
// and as a ratio of chroma and a turn of hue. (The difference of a and b would turn gold into pink
// where the reference only turns yellow into grey.)
LabRamp ramp_from_relative(const LabRamp& relative, const LabRamp& reference,
                           const LabRamp& relative_reference, double hue_gain) {
  constexpr double grey = 0.02;  // chroma below which a hue is unreliable
  LabRamp ramp{};
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const glm::dvec3& to = reference[k];
    const glm::dvec3& from = relative_reference[k];
    const double ratio = std::clamp((chroma(to) + grey) / (chroma(from) + grey), 0.5, 1.5);
    double turn = exact::atan2(to.z, to.y) - exact::atan2(from.z, from.y);
    turn -= 2.0 * std::numbers::pi * std::round(turn / (2.0 * std::numbers::pi));
    const double sure = std::min(1.0, std::min(chroma(to), chroma(from)) / (2.0 * grey));
    const exact::Turn at = exact::turn(hue_gain * sure * std::clamp(turn, -max_turn, max_turn));
    const glm::dvec3& own = relative[k];
    ramp[k] = {own.x + 0.9 * (to.x - from.x), ratio * (at.cosine * own.y - at.sine * own.z),
               ratio * (at.sine * own.y + at.cosine * own.z)};
  }
  return ramp;
}

// Moves hues towards similar colours of the painting, weighted with their chroma.
LabRamp toward_paint(LabRamp ramp, const std::vector<glm::dvec3>& paint) {
  for (glm::dvec3& colour : ramp) {
    std::vector<double> distances;
    distances.reserve(paint.size());
    for (const glm::dvec3& p : paint) {
      const glm::dvec3 d = p - colour;
      distances.push_back(d.x * d.x / (paint_lightness * paint_lightness) +
                          (d.y * d.y + d.z * d.z) / (paint_hue * paint_hue));
    }
    const double nearest = *std::min_element(distances.begin(), distances.end());
    glm::dvec2 sum(0.0);
    double weight = 0.0;
    for (std::size_t i = 0; i < paint.size(); ++i) {
      if (distances[i] - nearest > 80.0) continue;
      const double w = exact::exp(-0.5 * (distances[i] - nearest)) * (chroma(paint[i]) + 0.01);
      sum += w * glm::dvec2(paint[i].y, paint[i].z);
      weight += w;
    }
    colour.y += to_paint * (sum.x / weight - colour.y);
    colour.z += to_paint * (sum.y / weight - colour.z);
  }
  return ramp;
}

// Moves bare ground towards the hue of its tone, greyer than the ground.
LabRamp toward_tone(LabRamp ramp, const LightLaw& law, double share) {
  for (glm::dvec3& colour : ramp) {
    const glm::dvec2 hue = bare_chroma * law.at(colour.x);
    colour.y += share * (hue.x - colour.y);
    colour.z += share * (hue.y - colour.z);
  }
  return ramp;
}

// Moves a ramp towards the painting's green wherever it occurs, sky and sea included: colours of
// the reference's hue and of similar lightness, with their chroma but at most the reference's.
LabRamp toward_own_green(LabRamp ramp, const LabRamp& reference,
                         const std::vector<glm::dvec3>& paint) {
  double mean_chroma = 0.0;
  for (const glm::dvec3& p : paint) mean_chroma += chroma(p);
  mean_chroma = std::max(mean_chroma / static_cast<double>(paint.size()), 1e-6);
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const double wanted = chroma(reference[k]);
    glm::dvec2 sum(0.0);
    double chromas = 0.0;
    double weight = 0.0;
    for (const glm::dvec3& p : paint) {
      const double c = chroma(p);
      if (c <= 0.015 || p.y * reference[k].y + p.z * reference[k].z < green_reach_cos * c * wanted)
        continue;
      const double off = (p.x - ramp[k].x) / green_lightness;
      const double w = exact::exp(-0.5 * off * off) * c;
      sum += w * glm::dvec2(p.y, p.z);
      chromas += w * c;
      weight += w;
    }
    // Equivalent number of texels of mean chroma among 6000 of the painting, as the recipe counts.
    const double count = weight / mean_chroma * 6000.0 / static_cast<double>(paint.size());
    if (count < 12.0) continue;
    glm::dvec2 own = sum / weight;
    own *= std::min(chromas / weight, wanted) / std::max(exact::hypot(own.x, own.y), 1e-6);
    const double share = to_green * std::min(1.0, count / 60.0);
    ramp[k].y += share * (own.x - ramp[k].y);
    ramp[k].z += share * (own.y - ramp[k].z);
  }
  return ramp;
}

}  // namespace

const std::vector<LandCoverClass>& relatives_of(LandCoverClass id) {
  static const std::array<std::vector<LandCoverClass>, land_cover_class_count> relatives = [] {
    std::array<std::vector<LandCoverClass>, land_cover_class_count> r;
    r[index_of(pasture)] = {alpine_grass, valley_floor, shrub, forest};
    r[index_of(alpine_grass)] = {pasture, valley_floor, shrub, sand};
    r[index_of(valley_floor)] = {pasture, alpine_grass, sand};
    r[index_of(forest)] = {shrub, pasture, alpine_grass};
    r[index_of(shrub)] = {forest, alpine_grass, pasture};
    r[index_of(scree)] = {rock, sand};
    r[index_of(sand)] = {scree, rock, alpine_grass};
    r[index_of(rock)] = {scree, sand};
    r[index_of(snow)] = {glacier};
    r[index_of(glacier)] = {snow};
    r[index_of(settlement)] = {rock, scree};
    return r;
  }();
  return relatives[index_of(id)];
}

DerivedRamps derive_missing_classes(const SeenRamps& seen, const StylePainting& painting,
                                    const LightLaw& law, const ClassRamps& reference) {
  const LightnessLimits limits{painting.min_lightness, painting.max_lightness};
  const ColourRelation relation = fit_relation(painting, reference);
  const std::vector<glm::dvec3> paint = paint_of(painting.every);
  DerivedRamps out{seen.ramps, {}};
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const std::size_t c = index_of(info.id);
    if (info.id == sky || seen.seen[c]) continue;
    const std::vector<LandCoverClass>& all = relatives_of(info.id);
    const auto relative = std::find_if(all.begin(), all.end(),
                                       [&](LandCoverClass id) { return seen.seen[index_of(id)]; });
    const std::optional<LabRamp> mirrored =
        info.id == water ? water_from_sky(painting) : std::nullopt;
    LabRamp ramp{};
    std::string from;
    if (mirrored) {
      ramp = *mirrored;
      from = "the bluest of the sky";
    } else if (relative != all.end()) {
      const std::size_t r = index_of(*relative);
      ramp = ramp_from_relative(seen.ramps[r], reference[c], reference[r], relation.hue_gain);
      from = class_words(*relative);
    } else {
      for (std::size_t k = 0; k < ramp.size(); ++k) ramp[k] = relation(reference[c][k]);
      from = "the colours of all its ground";
      if (info.id == snow || info.id == glacier) {  // must be the lightest classes
        constexpr std::array<double, 4> least = {0.60, 0.76, 0.90, 0.965};
        for (std::size_t k = 0; k < ramp.size(); ++k) {
          ramp[k].x = std::max(ramp[k].x, least[k] + limits.max - 0.97);
          ramp[k].y += 0.5 * (relation.hue_gain * reference[c][k].y - ramp[k].y);
          ramp[k].z += 0.5 * (relation.hue_gain * reference[c][k].z - ramp[k].z);
        }
        from += ", as the lightest thing in the picture";
      }
    }
    if (!mirrored) ramp = toward_paint(ramp, paint);
    ramp = toward_tone(ramp, law, law.by_tone(info.id));
    if (is_green(info.id) && relative == all.end()) {
      ramp = toward_own_green(ramp, reference[c], paint);
      from += " and the painter's green wherever there is some";
    }
    out.ramps[c] = stretch_ramp(ramp, reference[c], limits, law_of(info.id, law));
    out.notes.push_back("no " + class_words(info.id) + " in the painting: its colours are from " +
                        from);
  }
  return out;
}

}  // namespace belvedere
