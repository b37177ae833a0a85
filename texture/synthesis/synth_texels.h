#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "texture/synthesis/synth_plane.h"
#include "texture/synthesis/synth_surroundings.h"

namespace belvedere::synth {

// The inputs for pricing a candidate before its patch is read, contiguous in memory: for a texel
// not in cache they arrive together, and so do those of its neighbours, which come next. Memory
// latency is most of the cost of a candidate.
class TexelRecords {
 public:
  struct Record {
    const std::uint32_t* words = nullptr;
    const std::uint8_t* bytes() const { return reinterpret_cast<const std::uint8_t*>(words); }
    std::uint32_t uses() const { return words[0]; }  // pixels that copy this texel
    std::uint8_t bin() const { return bytes()[4] & bin_bits; }
    // Whether a silhouette lies between the texel and the next one to the right, and below.
    bool is_cut_right() const { return (bytes()[4] & cut::right << bin_width) != 0; }
    bool is_cut_down() const { return (bytes()[4] & cut::down << bin_width) != 0; }
    Surroundings around() const { return {bytes()[5], bytes()[6]}; }
    const std::uint8_t* guides() const {
      return bytes() + guides_from;
    }  // eight may be read, however few there are
  };

  TexelRecords() = default;
  // `around` may be empty. All uses are 0.
  TexelRecords(const Plane& exemplars, const std::vector<std::uint8_t>& bins,
               const std::vector<Surroundings>& around);

  Record at(std::uint32_t texel) const {
    return {words_.data() + static_cast<std::size_t>(texel) * record_words_};
  }
  std::uint32_t& uses(std::uint32_t texel) {
    return words_[static_cast<std::size_t>(texel) * record_words_];
  }
  const std::uint32_t* data() const { return words_.data(); }
  void forget_uses();
  // Whether a silhouette of the exemplar lies between a texel and its neighbour by (dx, dy), each
  // -1 … 1; diagonals may pass either corner.
  bool is_cut(std::uint32_t texel, int dx, int dy, int stride) const {
    const auto step_is_cut = [&](std::uint32_t from, int x, int y) {
      if (x != 0) return at(x > 0 ? from : from - 1).is_cut_right();
      return at(y > 0 ? from : from - static_cast<std::uint32_t>(stride)).is_cut_down();
    };
    if (dx == 0 || dy == 0) return step_is_cut(texel, dx, dy);
    const auto moved = [&](int x, int y) {
      return static_cast<std::uint32_t>(static_cast<std::ptrdiff_t>(texel) + x +
                                        static_cast<std::ptrdiff_t>(y) * stride);
    };
    return (step_is_cut(texel, dx, 0) || step_is_cut(moved(dx, 0), 0, dy)) &&
           (step_is_cut(texel, 0, dy) || step_is_cut(moved(0, dy), dx, 0));
  }
  bool operator==(const TexelRecords&) const = default;

 private:
  static constexpr int bin_width = 6;  // bits of a bin; those above are cuts
  static constexpr std::uint8_t bin_bits = (1U << bin_width) - 1U;
  static constexpr std::size_t guides_from =
      7;  // one guide ends with the record's second word; more take up further pairs of words

  std::size_t record_words_ = 2;
  std::vector<std::uint32_t> words_;
};

}  // namespace belvedere::synth
