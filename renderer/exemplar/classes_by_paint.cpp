#include "renderer/exemplar/classes_by_paint.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/filter.h"
#include "base/land_cover_class.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "renderer/image/rows/picture_rows.h"
#include "renderer/image/srgb.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

constexpr int max_compared_px = 1400;  // of the picture that is compared; wider ones are reduced
constexpr double place_share = 5.0 / 1200.0;  // of the width: how far places may be off
constexpr double paint_share = 1.2 / 1200.0;  // of the width: what one stroke says of its neighbour
constexpr float altitude_weight = 0.3F;       // of the shares of classes at an altitude
constexpr float even_weight = 0.04F;          // of all classes alike
constexpr double belt_m = 50.0;               // height of the belts in which classes are counted
constexpr double min_class_share = 0.002;     // of the ground: a class with less has no histogram
constexpr int class_rounds = 6;
constexpr int axis_bins = 14;  // of each axis of OKLab …
constexpr double beyond_axis =
    0.005;  // … and the share of pixels below the first, or above the last
constexpr double unseen_colour = 1e-5;  // probability of a colour that a class does not show
constexpr double unlikely = 1e-9;       // probability that no paint outweighs
constexpr auto sky_number = static_cast<std::uint8_t>(LandCoverClass::sky);

bool stays(std::uint8_t id) {
  return id == static_cast<std::uint8_t>(LandCoverClass::water) ||
         id == static_cast<std::uint8_t>(LandCoverClass::settlement);
}

// The painting in OKLab and the map's labels, in the size in which they are compared.
struct Compared {
  Grid<glm::vec3> oklab;
  Grid<std::uint8_t> labels;
  Grid<float> altitude_m;
};

Compared compare_at(const Grid<glm::vec3>& painting, const PlaceClasses& places) {
  const int width = std::min({max_compared_px, painting.width(), places.labels.width()});
  const int height = std::clamp(static_cast<int>(std::lround(static_cast<double>(width) *
                                                             painting.height() / painting.width())),
                                1, std::min(painting.height(), places.labels.height()));
  Compared out{reduced_oklab(painting, {width, height}), Grid<std::uint8_t>(width, height),
               Grid<float>(width, height)};
  const auto from = [](int k, int count, int of) {
    return static_cast<int>(static_cast<std::int64_t>(k) * of / count);
  };
  parallel_rows(height, [&](int y) {
    const int row = from(2 * y + 1, 2 * height, places.labels.height());
    for (int x = 0; x < width; ++x) {
      const int column = from(2 * x + 1, 2 * width, places.labels.width());
      out.labels(x, y) = places.labels(column, row);
      out.altitude_m(x, y) = places.altitude_m(column, row);
    }
  });
  return out;
}

// The classes with enough ground, and the sky, in the order of their ids.
std::vector<std::uint8_t> classes_of(const Grid<std::uint8_t>& labels) {
  std::array<std::size_t, 256> count{};
  for (const std::uint8_t label : labels) ++count[label];
  const double ground =
      static_cast<double>(labels.size() - count[sky_number] - count[unused_label]);
  std::vector<std::uint8_t> out;
  for (const LandCoverClassInfo& info : land_cover_classes()) {
    const auto id = static_cast<std::uint8_t>(info.id);
    const auto pixels = static_cast<double>(count[id]);
    if (pixels > 0.0 && (id == sky_number || stays(id) || pixels >= min_class_share * ground))
      out.push_back(id);
  }
  return out;
}

// A value of each class at each pixel.
using OfClasses = std::vector<Grid<float>>;

// The shares of classes in each belt of altitude, of all but the sky.
class Belts {
 public:
  Belts(const Compared& compared, const std::vector<std::uint8_t>& classes) {
    std::array<std::size_t, 256> slot;
    slot.fill(classes.size());
    for (std::size_t k = 0; k < classes.size(); ++k)
      if (classes[k] != sky_number) slot[classes[k]] = k;
    float min_m = std::numeric_limits<float>::max(), max_m = -min_m;
    for (std::size_t i = 0; i < compared.labels.size(); ++i) {
      if (slot[compared.labels[i]] == classes.size()) continue;
      min_m = std::min(min_m, compared.altitude_m[i]);
      max_m = std::max(max_m, compared.altitude_m[i]);
    }
    min_altitude_m_ = static_cast<double>(std::min(min_m, max_m));
    const auto count = static_cast<std::size_t>(
                           std::max(0.0, static_cast<double>(max_m) - min_altitude_m_) / belt_m) +
                       1;
    shares_.assign(classes.size(), std::vector<float>(count, 0.F));
    std::vector<float> all(count, 0.F);
    for (std::size_t i = 0; i < compared.labels.size(); ++i) {
      const std::size_t k = slot[compared.labels[i]];
      if (k == classes.size()) continue;
      const std::size_t belt = belt_of(compared.altitude_m[i]);
      shares_[k][belt] += 1.F;
      all[belt] += 1.F;
    }
    for (std::vector<float>& shares : shares_)
      for (std::size_t belt = 0; belt < count; ++belt)
        if (all[belt] > 0.F) shares[belt] /= all[belt];
  }

  float share(std::size_t k, float altitude_m) const { return shares_[k][belt_of(altitude_m)]; }

 private:
  std::size_t belt_of(float altitude_m) const {
    const double above = std::max(0.0, static_cast<double>(altitude_m) - min_altitude_m_) / belt_m;
    return std::min(static_cast<std::size_t>(above), shares_.front().size() - 1);
  }

  double min_altitude_m_ = 0.0;
  std::vector<std::vector<float>> shares_;
};

// Probabilities of the classes according to the map. Pixels far from any label have none.
OfClasses map_probabilities(const Compared& compared, const std::vector<std::uint8_t>& classes) {
  const double sigma = place_share * compared.labels.width();
  OfClasses out;
  Grid<float> ground(compared.labels.width(), compared.labels.height(), 0.F);
  for (const std::uint8_t id : classes) {
    Grid<float> own(ground.width(), ground.height());
    for (std::size_t i = 0; i < own.size(); ++i) own[i] = compared.labels[i] == id ? 1.F : 0.F;
    out.push_back(gaussian_blur(own, sigma));
    for (std::size_t i = 0; i < own.size() && id != sky_number; ++i) ground[i] += out.back()[i];
  }
  const Belts belts(compared, classes);
  const auto even = 1.F / static_cast<float>(classes.size());
  parallel_rows(ground.height(), [&](int y) {
    for (int x = 0; x < ground.width(); ++x) {
      const std::size_t i = ground.index(x, y);
      const bool on_ground = compared.labels[i] != sky_number && compared.labels[i] != unused_label;
      const float altitude = on_ground ? altitude_weight : 0.F;
      for (std::size_t k = 0; k < classes.size(); ++k) {
        if (classes[k] == sky_number) continue;
        out[k][i] = (1.F - altitude - even_weight) * out[k][i] + ground[i] * even_weight * even;
        if (on_ground) out[k][i] += ground[i] * altitude * belts.share(k, compared.altitude_m[i]);
      }
    }
  });
  return out;
}

// The bin of each pixel's colour.
Grid<std::uint16_t> colour_bins(const Compared& compared) {
  std::array<double, 3> from{}, scale{};
  for (int c = 0; c < 3; ++c) {
    std::vector<float> values;
    for (std::size_t i = 0; i < compared.labels.size(); ++i)
      if (compared.labels[i] != unused_label) values.push_back(compared.oklab[i][c]);
    const auto axis = static_cast<std::size_t>(c);
    from[axis] = static_cast<double>(value_at_share(values, beyond_axis));
    scale[axis] =
        axis_bins /
        std::max(static_cast<double>(value_at_share(values, 1.0 - beyond_axis)) - from[axis], 1e-6);
  }
  Grid<std::uint16_t> out(compared.labels.width(), compared.labels.height());
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      int bin = 0;
      for (int c = 0; c < 3; ++c) {
        const auto axis = static_cast<std::size_t>(c);
        const double at = (static_cast<double>(compared.oklab(x, y)[c]) - from[axis]) * scale[axis];
        bin = bin * axis_bins + static_cast<int>(std::clamp(at, 0.0, axis_bins - 1.0));
      }
      out(x, y) = static_cast<std::uint16_t>(bin);
    }
  });
  return out;
}

// ln of the probability of each bin's colour in a class, whose pixels have these probabilities.
std::vector<float> log_histogram(const Grid<float>& probability, const Grid<std::uint16_t>& bin) {
  std::vector<double> counts(axis_bins * axis_bins * axis_bins, 0.0);
  for (std::size_t i = 0; i < bin.size(); ++i)
    counts[bin[i]] += static_cast<double>(probability[i]);
  for (const int step : {1, axis_bins, axis_bins * axis_bins}) {
    const std::vector<double> sharp = counts;
    for (int k = 0; k < axis_bins * axis_bins * axis_bins; ++k) {
      const int along = k / step % axis_bins;
      const auto at = [&](int to) { return sharp[static_cast<std::size_t>(to)]; };
      counts[static_cast<std::size_t>(k)] = 0.5 * at(k) + 0.25 * (along > 0 ? at(k - step) : 0.0) +
                                            0.25 * (along + 1 < axis_bins ? at(k + step) : 0.0);
    }
  }
  double sum = 0.0;
  for (const double count : counts) sum += count;
  std::vector<float> out;
  for (const double count : counts)
    out.push_back(static_cast<float>(exact::log(count / std::max(sum, 1e-9) + unseen_colour)));
  return out;
}

// From logarithms to probabilities whose sum is 1.
void normalize(OfClasses& values) {
  parallel_rows(values.front().height(), [&](int y) {
    for (int x = 0; x < values.front().width(); ++x) {
      const std::size_t i = values.front().index(x, y);
      float largest = values.front()[i];
      for (const Grid<float>& of : values) largest = std::max(largest, of[i]);
      float sum = 0.F;
      for (Grid<float>& of : values) {
        of[i] = static_cast<float>(exact::exp(static_cast<double>(of[i] - largest)));
        sum += of[i];
      }
      for (Grid<float>& of : values) of[i] /= sum;
    }
  });
}

OfClasses class_probabilities(const Compared& compared, const std::vector<std::uint8_t>& classes) {
  const OfClasses by_map = map_probabilities(compared, classes);
  const Grid<std::uint16_t> bin = colour_bins(compared);
  OfClasses out = by_map;
  const double blur = paint_share * compared.labels.width();
  for (int round = 0; round < class_rounds; ++round) {
    parallel_ranges(out.size(), std::size_t{1}, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) {
        const std::vector<float> colour = log_histogram(out[k], bin);
        for (std::size_t i = 0; i < bin.size(); ++i)
          out[k][i] = colour[bin[i]] +
                      static_cast<float>(exact::log(static_cast<double>(by_map[k][i]) + unlikely));
      }
    });
    for (Grid<float>& of : out) of = gaussian_blur(of, blur);
    normalize(out);
  }
  return out;
}

// Water, settlement and unused pixels as on the map, the first two nowhere else.
void keep_as_on_map(const Grid<std::uint8_t>& labels, const std::vector<std::uint8_t>& classes,
                    OfClasses& probability) {
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t k = 0; k < classes.size(); ++k)
      if (labels[i] == unused_label || stays(labels[i]) || stays(classes[k]))
        probability[k][i] = labels[i] == classes[k] ? 1.F : 0.F;
}

}  // namespace

PlaceClasses places_of(const GuidanceBuffers& guidance) {
  PlaceClasses out{Grid<std::uint8_t>(guidance.width(), guidance.height()), guidance.altitude_m};
  for (std::size_t i = 0; i < out.labels.size(); ++i)
    out.labels[i] =
        guidance.is_sky(i) ? sky_number : static_cast<std::uint8_t>(guidance.land_cover[i]);
  return out;
}

Grid<std::uint8_t> classes_by_paint(const Grid<glm::vec3>& painting, const PlaceClasses& places) {
  const Compared compared = compare_at(painting, places);
  const std::vector<std::uint8_t> classes = classes_of(compared.labels);
  Grid<std::uint8_t> out(painting.width(), painting.height(), unused_label);
  if (classes.empty()) return out;
  OfClasses probability = class_probabilities(compared, classes);
  keep_as_on_map(compared.labels, classes, probability);
  const double across = static_cast<double>(compared.labels.width()) / out.width();
  const double down = static_cast<double>(compared.labels.height()) / out.height();
  parallel_rows(out.height(), [&](int y) {
    for (int x = 0; x < out.width(); ++x) {
      float likeliest = 0.F;
      for (std::size_t k = 0; k < classes.size(); ++k) {
        const float value =
            sample_bilinear(probability[k], (x + 0.5) * across - 0.5, (y + 0.5) * down - 0.5);
        if (!(value > likeliest)) continue;
        likeliest = value;
        out(x, y) = classes[k];
      }
    }
  });
  return out;
}

namespace {

// Sums over pixels, which add up when parts are merged.
struct LookSums {
  glm::dvec3 oklab{0.0};
  double y = 0.0;
  double upper_edge = 0.0;
  double across = 0.0;
  double down = 0.0;
  double pixels = 0.0;
  LookSums& operator+=(const LookSums& other) {
    oklab += other.oklab;
    y += other.y;
    upper_edge += other.upper_edge;
    across += other.across;
    down += other.down;
    pixels += other.pixels;
    return *this;
  }
};

std::vector<LookSums> measure_looks(const Grid<glm::vec3>& oklab, const Superpixels& pieces) {
  std::vector<LookSums> sums(pieces.count);
  for (int y = 0; y < oklab.height(); ++y)
    for (int x = 0; x < oklab.width(); ++x) {
      LookSums& sum = sums[pieces.of(x, y)];
      const double lightness = oklab(x, y).x;
      sum.oklab += oklab(x, y);
      sum.y += (y + 0.5) / oklab.height();
      sum.upper_edge += y == 0 ? 1.0 / oklab.width() : 0.0;
      sum.across += std::abs(static_cast<double>(oklab.clamped(x + 1, y).x) - lightness);
      sum.down += std::abs(static_cast<double>(oklab.clamped(x, y + 1).x) - lightness);
      sum.pixels += 1.0;
    }
  return sums;
}

void look_at_nodes(std::vector<LookSums> sums, PaintingSegments& segments) {
  for (const auto& [a, b] : segments.tree.joins) {
    LookSums both = sums[a];
    both += sums[b];
    sums.push_back(both);
  }
  const LookSums& whole = sums.back();
  const double usual = std::max((whole.across + whole.down) / whole.pixels, 1e-6);
  for (const LookSums& sum : sums) {
    PartLook look{sum.oklab / sum.pixels, sum.y / sum.pixels, sum.upper_edge,
                  sum.across / sum.pixels, sum.down / sum.pixels};
    look.rough = (look.across + look.down) / usual;
    segments.looks.push_back(look);
    segments.pixels.push_back(sum.pixels);
    segments.inferred.push_back(infer_class(look));
  }
}

void check_picture(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                   const std::string& path) {
  if (std::min(picture.width(), picture.height()) < min_segment_side)
    throw Error(ErrorKind::input, path,
                fmt::format("{} × {} pixels", picture.width(), picture.height()),
                fmt::format("at least {} pixels on each side", min_segment_side));
  if (std::all_of(picture.begin(), picture.end(),
                  [&](const glm::vec3& colour) { return colour == picture[0]; }))
    throw Error(ErrorKind::input, path, "the picture has a single colour",
                "a painting with several colours");
  if (!alpha.empty() && std::all_of(alpha.begin(), alpha.end(), [](float a) { return a < 1.F; }))
    throw Error(ErrorKind::input, path, "the picture is fully transparent",
                "a painting with opaque parts");
}

}  // namespace

std::uint8_t infer_class(const PartLook& look) {
  using enum LandCoverClass;
  const double lightness = look.oklab.x;
  const double red = look.oklab.y;     // positive towards red, negative towards green
  const double yellow = look.oklab.z;  // positive towards yellow, negative towards blue
  const double chroma = std::sqrt(red * red + yellow * yellow);
  const bool blue = yellow < -0.012;
  const bool pale = lightness > 0.68 && chroma < 0.05;
  const bool green = red < -0.006 && yellow > 0.0 && chroma > 0.015;
  const bool olive =
      red < 0.0045 && yellow > 0.025 && yellow < 0.05;  // forest and fields under old varnish
  const bool warm = yellow > 0.03 && red > -0.01;
  const bool level = look.down > 1.25 * look.across;
  // Leaves against the sky are as bright as the sky, and the roughest texture of all; a cliff in
  // blue shade is not sky either. A part that covers much of the upper edge may be as rough as the
  // rest.
  const bool smooth = look.rough < (look.upper_edge > 0.25 ? 1.15 : 0.8);
  const auto of = [&] {
    if (look.height < 0.5 && lightness > 0.45 && smooth && (!green || pale) &&
        (blue || pale || look.upper_edge > 0.02))
      return sky;
    if (look.height < 0.65 && lightness > 0.68 && chroma < 0.03 && look.rough < 0.6)
      return sky;  // haze above the horizon
    if (look.height >= (level ? 0.35 : 0.5) && blue && (level || chroma > 0.04)) return water;
    if (look.height > 0.5 && blue && chroma > 0.025 && look.rough < 1.2) return water;
    if (lightness > 0.72 && chroma < 0.035) return snow;
    if (green || olive) return lightness < 0.5 || look.rough > 1.8 ? forest : pasture;
    if (warm && lightness > 0.72) return sand;
    if (warm && chroma > 0.09) return valley_floor;
    if (look.height > 0.5 && smooth && lightness > 0.45 && red > 0.01 && yellow > 0.01)
      return sand;  // wet, or in shade
    if (lightness < 0.28 || (lightness < 0.4 && yellow > 0.01)) return forest;
    return rock;
  };
  return static_cast<std::uint8_t>(of());
}

PaintingSegments segment_painting(const Grid<glm::vec3>& picture, const Grid<float>& alpha,
                                  double theta, const std::string& path) {
  check_picture(picture, alpha, path);
  // In a long and narrow painting the short side must not become too short.
  const int factor = std::min(segment_reduction(picture.width(), picture.height()),
                              std::min(picture.width(), picture.height()) / min_segment_side);
  Grid<glm::vec3> oklab = reduce_blocks(picture, factor);
  parallel_rows(oklab.height(), [&](int y) {
    for (int x = 0; x < oklab.width(); ++x) oklab(x, y) = glm::vec3(to_oklab(oklab(x, y)));
  });
  const Segments segments = find_segments(oklab);
  PaintingSegments out;
  const Partition groups = group_pieces(segments, theta);
  out.groups = std::size_t{*std::max_element(groups.begin(), groups.end())} + 1;
  out.tree = join_pieces(segments.distance, segments.pixels, groups);
  look_at_nodes(measure_looks(oklab, segments.pieces), out);
  out.pieces = enlarge_pieces(segments.pieces.of, picture, factor);
  for (std::size_t i = 0; i < alpha.size(); ++i)
    if (alpha[i] < 1.F) out.pieces[i] = no_piece;
  return out;
}

Grid<std::uint8_t> class_mask(const PaintingSegments& segments, const Partition& groups,
                              const std::vector<std::uint8_t>& classes) {
  Grid<std::uint8_t> mask(segments.pieces.width(), segments.pieces.height(), unused_label);
  for (std::size_t i = 0; i < mask.size(); ++i)
    if (segments.pieces[i] != no_piece) mask[i] = classes[groups[segments.pieces[i]]];
  return mask;
}

}  // namespace belvedere
