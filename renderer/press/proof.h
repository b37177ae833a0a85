#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/progress.h"
#include "renderer/image/icc/press_color.h"
#include "renderer/press/press_picture.h"

namespace belvedere {

// How far a print will be from its picture, in ΔE2000, each against its own white.
struct ProofReport {
  std::string press;  // the profile's name for itself
  std::uint64_t pixels = 0;
  double outside_share = 0.0;  // of the pixels: no inks make their colour
  double mean_delta_e = 0.0;   // picture to print, as the intent asks
  double delta_e_95 = 0.0;     // 95 % of the pixels are within it; in steps of .01
  double highest_delta_e = 0.0;
  InkCoverage ink;
};

// Writes STEM_proof.png, the print as a monitor can show it, and STEM_outside.png, the picture in grey with what no inks make in red. Row
// by row, and the same for any threads. `ink_limit_percent` 0: the profile's own.
ProofReport write_proof(const PressPicture& picture, const std::vector<std::uint8_t>& press, const ProofParameters& parameters,
                        double ink_limit_percent, const std::string& stem, Progress& progress);

}  // namespace belvedere
