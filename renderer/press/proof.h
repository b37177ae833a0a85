#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/image/icc/press_colour.h"
#include "renderer/press/press_picture.h"

namespace belvedere {

// Difference of a print from its picture, in ΔE2000, each relative to its own white.
struct ProofReport {
  std::string press;  // the profile's own name
  std::uint64_t pixels = 0;
  double outside_share = 0.0;  // share of the pixels with unprintable colours
  double mean_delta_e = 0.0;   // picture to print, with the given intent
  double delta_e_95 = 0.0;     // 95 % of the pixels are within it; in steps of .01
  double highest_delta_e = 0.0;
  InkCoverage ink;
};

// Writes STEM_proof.png, the simulated print, and STEM_outside.png, the picture in grey with
// unprintable colours in red. Row by row, and the same for any number of threads.
// `ink_limit_percent` 0: the profile's limit.
ProofReport write_proof(const PressPicture& picture, const std::vector<std::uint8_t>& press,
                        const ProofParameters& parameters, double ink_limit_percent,
                        const std::string& stem, Progress& progress);

}  // namespace belvedere
