#pragma once

#include <cstdint>
#include <vector>

#include "texture/synthesis/synth_plane.h"

namespace belvedere::synth {

// Which classes lie around a pixel: counts n_k of the neighbourhood's pixels per class, kept as the share of other classes and the
// commonest of them. Exact where the neighbourhood holds no more than two classes.
struct Surroundings {
  std::uint8_t others = 0;            // share of other classes, 255: all
  std::uint8_t commonest = no_class;  // of the others
};

// Of every pixel, over (2 radius + 1)² pixels inside the picture; pixels without class count nowhere.
std::vector<Surroundings> make_surroundings(const Plane& plane, int radius, int classes);

// The price of other surroundings: weight × Σ_k (n_k(pixel) - n_k(texel))² with n_k in shares of 255, which for two neighbourhoods of one
// class, u and v of others in them, is 2 (u - v)² + 2 d u v; d, from a table of class pairs, is how unlike the two other classes are.
class SurroundingsPrice {
 public:
  // pairs: by class × classes + class, unlikeness in sixteenths.
  SurroundingsPrice(std::int64_t weight_q8, std::vector<std::uint8_t> pairs, int classes)
      : weight_q8_(weight_q8), pairs_(std::move(pairs)), classes_(static_cast<std::size_t>(classes)) {}
  bool is_free() const { return weight_q8_ == 0; }
  std::int64_t weight_q8() const { return weight_q8_; }
  const std::vector<std::uint8_t>& pairs() const { return pairs_; }
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
};

inline SurroundingsPrice no_surroundings() { return {0, {}, 0}; }

}  // namespace belvedere::synth
