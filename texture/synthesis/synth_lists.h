#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "texture/synthesis/synth_plane.h"
#include "texture/synthesis/synth_texels.h"

namespace belvedere::synth {

// A patch in eight bytes: the grey at eight positions on a ring 1.4 … 2 pixels around its centre.
// Stored with each entry of the pick lists, it shows which of several texels may match the existing
// paint around a pixel without reading their patches.
inline constexpr std::size_t grey_places = 8;

struct Greys {
  std::array<std::uint8_t, grey_places> values{};
  std::array<std::uint8_t, grey_places> counts{};  // 255, or 0 where the position has no class
};

// Grey is (R + 2 G + B) / 4.
inline Greys greys_around(const Plane& plane, std::uint32_t at) {
  const std::ptrdiff_t down = plane.stride;
  const std::array<std::ptrdiff_t, grey_places> steps{-2,        2,        -2 * down, 2 * down,
                                                      -1 - down, 1 - down, -1 + down, 1 + down};
  const std::uint32_t* centre = plane.words.data() + at;
  Greys greys;
  for (std::size_t i = 0; i < grey_places; ++i) {
    const std::uint32_t word = centre[steps[i]];
    greys.values[i] = static_cast<std::uint8_t>(
        ((word & 255U) + 2 * (word >> 8 & 255U) + (word >> 16 & 255U)) >> 2);
    greys.counts[i] = class_of(word) == no_class ? 0 : 255;
  }
  return greys;
}

// Sum of squared differences at the positions that count in `requested`.
inline std::int32_t grey_distance(const Greys& requested, const std::uint8_t* offered) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < grey_places; ++i) {
    const std::int32_t off = std::abs(requested.values[i] - offered[i]) & requested.counts[i];
    sum += off * off;
  }
  return sum;
}

// A guide's part in the cost of a candidate. Guides of a plane are in descending order of weight.
struct GuideRole {
  std::int64_t weight_q4 = 0;  // cost of a squared difference, in sixteenths; > 0
};

// Which guides order the lists: the strongest (guide 0) sorts the texels of a class; the second
// (guide 1), where it is strong enough to matter, splits them into 16 buckets before.
struct ListKeys {
  static constexpr int bucket_width = 16;
  bool sorted = false;
  bool bucketed = false;
  int buckets() const { return bucketed ? 256 / bucket_width : 1; }
};
ListKeys choose_list_keys(const std::vector<GuideRole>& guides);

// Number of pixels that request each guide value: counts of a class by bucket and value, which
// determine the width of the windows of picks.
struct TexelDemand {
  ListKeys keys;
  std::vector<std::uint32_t> counts;  // (class × keys.buckets() + bucket) × 256 + value
  std::int64_t pixels_each = 1;       // pixels of the final picture per counted pixel: over 1
                                      // if a smaller view was counted
  bool complete = true;               // all values that pixels will request are counted here
};
TexelDemand count_texel_demand(const Plane& target, int classes,
                               const std::vector<GuideRole>& guides);

// Max distance of a pick from the pixel's own guides: wide enough for the window to contain enough
// texels for all pixels that draw from it. So no texel is needed more often than its class as a
// whole.
struct PickWindow {
  std::uint8_t slack = 0;  // of the sorting guide: the window is value ± (slack + 1), and costs
                           // nothing within ± slack
  std::uint8_t buckets =
      0;  // neighbouring buckets on either side; costs nothing within buckets × bucket_width
};

// The start of a pick: one entry of a part of the list, which is treated as cyclic.
struct PickRun {
  std::uint32_t first = 0;  // entry
  std::uint32_t count = 0;  // entries; 0: the class has no texel
  std::uint32_t start = 0;  // 0 … count - 1

  std::uint32_t entry(std::uint32_t i) const {
    return first + (start + i < count ? start + i : start + i - count);
  }  // i < count
};

// All texels of a level by class, bucket and value of the sorting guide, from which random
// candidates are picked. An entry contains everything needed to choose between texels, and texels
// of one value are in scattered order, so that a pick and the entries after it cost one memory
// access.
class PickLists {
 public:
  // An entry's words: the texel, then the share and commonest of other classes around it, its greys
  // and its guides, a byte each.
  struct Entry {
    static constexpr std::size_t guides_from = 2 + grey_places;
    const std::uint32_t* words = nullptr;
    std::uint32_t texel() const { return words[0]; }
    const std::uint8_t* bytes() const { return reinterpret_cast<const std::uint8_t*>(words + 1); }
    Surroundings around() const { return {bytes()[0], bytes()[1]}; }
    const std::uint8_t* greys() const { return bytes() + 2; }
    const std::uint8_t* guides() const { return bytes() + guides_from; }
  };

  // minimum: texels a window must contain. `around`, by exemplar index, may be empty.
  PickLists(const Plane& exemplars, const TexelDemand& demand, int classes,
            const std::vector<GuideRole>& guides, int minimum,
            const std::vector<Surroundings>& around = {});

  bool has_class(std::uint32_t label_class) const { return texel_count(label_class) > 0; }
  std::int64_t texel_count(std::uint32_t label_class) const;
  // The texels of a class, 0 … texel_count - 1.
  std::uint32_t texel(std::uint32_t label_class, std::int64_t nth) const {
    return entry(static_cast<std::uint32_t>(start_[cell(label_class, 0) * 257] + nth)).texel();
  }
  const ListKeys& keys() const { return keys_; }

  // The window of a pixel with these guides.
  PickWindow window(std::uint32_t label_class, const std::uint8_t* guides) const;
  // Begins at a texel of the class from that window, uniform in `random`, and stays within its
  // bucket. `widen`: from one twice as wide for each step.
  PickRun pick(std::uint32_t label_class, const std::uint8_t* guides, std::uint32_t random,
               int widen = 0) const;
  Entry entry(std::uint32_t nth) const {
    return {entries_.data() + static_cast<std::size_t>(nth) * entry_words_};
  }

 private:
  int value_of(const std::uint8_t* guides) const { return keys_.sorted ? guides[0] : 0; }
  int bucket_of(const std::uint8_t* guides) const {
    return keys_.bucketed ? guides[1] / ListKeys::bucket_width : 0;
  }
  std::size_t cell(std::uint32_t label_class, int bucket) const {
    return static_cast<std::size_t>(label_class) * static_cast<std::size_t>(keys_.buckets()) +
           static_cast<std::size_t>(bucket);
  }

  ListKeys keys_;
  std::size_t entry_words_ = 2;
  std::vector<std::uint32_t> entries_;  // by class, bucket, value
  std::vector<std::uint32_t> start_;    // cell × 257: the entry where a value begins
  std::vector<PickWindow> windows_;     // cell × 256
};

// Keeps contrast and colour of a class like the exemplar's: patch distance alone prefers flat
// patches. The texels of each class are divided into 8 quantiles of luminance × 8 of local
// contrast; a bin used more often than random picks would use it gets a cost.
inline constexpr int bins_per_class = 64;

// The bin of every texel; 0 outside classes. Luminance is r + g + b, contrast its deviation over 7
// × 7.
std::vector<std::uint8_t> make_bins(const Plane& exemplars, int classes);

// Cost of one more texel from each bin (class × 64 + bin), from its actual and expected uses:
// strength / 16 × clamp(16 (actual - expected) / (expected + 4), -16, 32).
std::vector<std::int32_t> bin_penalties(const std::vector<std::int32_t>& actual,
                                        const std::vector<std::int32_t>& expected,
                                        std::int32_t strength);

// The same with an integral term, as in a controller: a sixteenth of each round's cost is kept,
// within ± 2 × strength, so that the cost of a bin with a steady excess grows until the excess is
// gone. Changes `kept`; the sum of both is the cost.
std::vector<std::int32_t> steer_bins(const std::vector<std::int32_t>& actual,
                                     const std::vector<std::int32_t>& expected,
                                     std::int32_t strength, std::vector<std::int32_t>& kept);

}  // namespace belvedere::synth
