#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "texture/synthesis/synth_plane.h"

namespace belvedere::synth {

// Classes around a pixel: counts n_k of the neighbourhood's pixels per class, kept as the share of
// other classes and the most common of them. Exact if the neighbourhood contains at most two
// classes.
struct Surroundings {
  std::uint8_t others = 0;            // share of other classes, 255: all
  std::uint8_t commonest = no_class;  // of the others
};

// For every pixel, over (2 radius + 1)² pixels inside the picture; pixels without class are
// ignored.
std::vector<Surroundings> make_surroundings(const Plane& plane, int radius, int classes);

// The price of different surroundings: weight × Σ_k (n_k(pixel) - n_k(texel))² with n_k in shares
// of 255, which for two neighbourhoods of one class, u and v of others in them, is 2 (u - v)² + 2 d
// u v; d, from a table of class pairs, is the dissimilarity of the two other classes.
class SurroundingsPrice {
 public:
  // pairs: by class × classes + class, dissimilarity in sixteenths.
  SurroundingsPrice(std::int64_t weight_q8, std::vector<std::uint8_t> pairs, int classes)
      : weight_q8_(weight_q8),
        pairs_(std::move(pairs)),
        classes_(static_cast<std::size_t>(classes)),
        all_dissimilar_(
            std::all_of(pairs_.begin(), pairs_.end(), [](std::uint8_t d) { return d == 16; })) {}
  bool is_free() const { return weight_q8_ == 0; }
  std::int64_t weight_q8() const { return weight_q8_; }
  const std::vector<std::uint8_t>& pairs() const { return pairs_; }
  bool all_dissimilar() const { return all_dissimilar_; }
  std::int64_t operator()(Surroundings requested, Surroundings offered) const {
    const std::int64_t u = requested.others;
    const std::int64_t v = offered.others;
    std::int64_t sum = 2 * (u - v) * (u - v);
    if (requested.commonest != offered.commonest && u * v > 0)
      sum += u * v * pairs_[requested.commonest * classes_ + offered.commonest] / 8;
    return sum * weight_q8_ >> 8;
  }

 private:
  std::int64_t weight_q8_;
  std::vector<std::uint8_t> pairs_;
  std::size_t classes_;
  bool all_dissimilar_;
};

inline SurroundingsPrice no_surroundings() { return {0, {}, 0}; }

// Surroundings with all classes of a neighbourhood: the share of each, to a 64th. Equal
// neighbourhoods have one number, so that a texel needs no more memory than with the most common
// class alone; Surroundings then contain that number, with its low byte in `others`.
class ClassShares {
 public:
  static constexpr int steps = 64;

  ClassShares() = default;
  // For every pixel with a class, over (2 radius + 1)² pixels inside the picture. If there are more
  // than 65535 kinds of neighbourhood, shares are quantized half as finely, and so on.
  ClassShares(const Plane& plane, int radius, int classes);

  bool empty() const { return shares_.empty(); }
  const std::vector<Surroundings>& numbers() const { return numbers_; }  // by index of the plane
  void forget_numbers() { numbers_ = {}; }
  // Shares in 255ths, by class.
  const std::uint8_t* of(Surroundings number) const {
    return shares_.data() + (number.others + std::size_t{256} * number.commonest) *
                                static_cast<std::size_t>(classes_);
  }
  std::size_t kinds() const {
    return classes_ == 0 ? 0 : shares_.size() / static_cast<std::size_t>(classes_);
  }

 private:
  bool number_kinds(const Plane& plane, int radius, int step);

  int classes_ = 0;
  std::vector<std::uint8_t> shares_;  // by number × classes
  std::vector<Surroundings> numbers_;
};

// The price of different surroundings if all classes count: weight × Σ_kl (1 - d_kl) δ_k δ_l, δ_k =
// n_k(pixel) - n_k(texel) in shares of 255 and d as above; so Σ_k δ_k² if all classes are fully
// dissimilar.
std::int64_t shares_cost(const std::uint8_t* requested, const std::uint8_t* offered,
                         const SurroundingsPrice& price, int classes);

}  // namespace belvedere::synth
