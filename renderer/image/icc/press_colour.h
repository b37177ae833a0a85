#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/icc/device_colour.h"

namespace belvedere {

// Cyan, magenta, yellow and black of a pixel, 0…1 each.
using Inks = glm::vec4;

// The ink coverage of a picture: the sum of the four inks, 0…400 %; too much of it does not dry.
struct InkCoverage {
  double limit_percent = 400.0;
  std::uint64_t pixels = 0;
  std::uint64_t pixels_above =
      0;  // above the limit by more than .5 %, half a step of 8 bits in two inks
  double highest_percent = 0.0;
  double mean_percent = 0.0;
  double above_share() const {
    return pixels == 0 ? 0.0 : static_cast<double>(pixels_above) / static_cast<double>(pixels);
  }
};

// Counts rows in any split.
class InkCount {
 public:
  explicit InkCount(double limit_percent) { coverage_.limit_percent = limit_percent; }
  void add(const Grid<Inks>& rows);
  InkCoverage coverage() const;

 private:
  InkCoverage coverage_;
  std::uint64_t sum_ =
      0;  // of coverages, in steps of 1/65536 %: whole numbers add up the same in any order
};

// The ICC profile of a printing press: CMYK, with tables in both directions. Error(input) naming
// what the file is instead.
std::vector<std::uint8_t> read_press_profile(const std::string& path);
// A profile of either kind: of a press, or of an RGB device or space. Error(input) naming what the
// file is instead.
std::vector<std::uint8_t> read_device_profile(const std::string& path);
// Whether bytes are a CMYK profile, whatever else may be wrong with it.
bool is_cmyk_profile(const std::vector<std::uint8_t>& profile);
// Whether bytes are an RGB profile: a picture file's own profile must be one.
bool is_rgb_profile(const std::vector<std::uint8_t>& profile);
// The name that a profile gives itself; empty where it has none.
std::string profile_name(const std::vector<std::uint8_t>& profile);
// The highest total ink of the profile's own tables, percent, for the given intent: the limit
// chosen by its maker. 400 where there is none.
double press_ink_limit_percent(const std::vector<std::uint8_t>& profile);

// Encoded RGB to inks 0…1, row by row. The same bits for any number of threads.
class PressConversion {
 public:
  // `source`: the picture's own RGB profile; empty: sRGB.
  PressConversion(const std::vector<std::uint8_t>& press, const DeviceParameters& parameters,
                  const std::vector<std::uint8_t>& source = {});
  ~PressConversion();
  PressConversion(PressConversion&&) noexcept;
  PressConversion& operator=(PressConversion&&) noexcept;
  Grid<Inks> convert(const Grid<glm::vec3>& encoded) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Simulates a press on a monitor.
struct ProofParameters {
  DeviceParameters device;
  bool paper = false;  // shows the paper's own colour; else paper is as white as the monitor
  double outside_delta_e = 2.0;  // ΔE2000 above which a colour counts as unprintable
};
struct ProofRows {
  Grid<glm::vec3> shown;  // encoded sRGB, clamped to 0…1
  Grid<float> delta_e;    // ΔE2000 between picture and print, both relative to their own white
  Grid<std::uint8_t> outside;  // 1: unprintable
  Grid<Inks> inks;
};
class SoftProof {
 public:
  SoftProof(const std::vector<std::uint8_t>& press, const ProofParameters& parameters,
            const std::vector<std::uint8_t>& source = {});
  ~SoftProof();
  ProofRows make(const Grid<glm::vec3>& encoded) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// ΔE2000 (CIE 142) of two colours in CIELAB.
double delta_e_2000(glm::vec3 lab_a, glm::vec3 lab_b);
// Appearance of printed inks: CIELAB relative to the paper's white (D50).
class InkLook {
 public:
  explicit InkLook(const std::vector<std::uint8_t>& press);
  ~InkLook();
  Grid<glm::vec3> lab(const Grid<Inks>& inks) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};
// Encoded RGB of a profile (empty: sRGB) as CIELAB relative to its white (D50).
Grid<glm::vec3> rgb_to_lab(const Grid<glm::vec3>& encoded,
                           const std::vector<std::uint8_t>& profile = {});

}  // namespace belvedere
