#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/grid.h"
#include "renderer/image/icc/device_colour.h"

namespace belvedere {

// Colour management: display_conversion.cpp by OpenColorIO, icc/ by lcms2.
struct DisplayParameters {
  std::string
      config;  // an OCIO config file; empty: $OCIO, else the program's own config, built in memory
  std::string working = "lin_srgb";  // scene-linear space, role or alias in it
  std::string display = "srgb";      // space, role or alias of PNG and TIFF, or `display/view`
};
// The program's own config has lin_srgb, srgb (IEC 61966-2-1, exact), aces (ACES2065-1) and acescg;
// the last two are adapted to D65 by Bradford. Every function throws Error(input) with the name of
// a config, a file that it needs, or a space that is missing or invalid.

// Encodes scene-linear rows to 0…1, any number at a time, because pixels are independent. For many
// rows: the config is read once.
class DisplayConversion {
 public:
  explicit DisplayConversion(const DisplayParameters& parameters);
  ~DisplayConversion();
  DisplayConversion(DisplayConversion&&) noexcept;
  DisplayConversion& operator=(DisplayConversion&&) noexcept;
  Grid<glm::vec3> convert(Image linear) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Scene-linear to encoded 0…1. Not clamped: values beyond white stay beyond 1. The same bits for
// any number of threads.
Grid<glm::vec3> to_display(const Image& linear, const DisplayParameters& parameters);

// Encoded sRGB, or the space of another RGB profile (`source`), to the device space of an RGB
// profile, clamped to 0…1. Error(input) for bytes that are not a profile of an RGB output. The same
// bits for any number of threads.
class ProfileConversion {
 public:
  explicit ProfileConversion(const std::vector<std::uint8_t>& profile,
                             const DeviceParameters& parameters = {},
                             const std::vector<std::uint8_t>& source = {});
  ~ProfileConversion();
  ProfileConversion(ProfileConversion&&) noexcept;
  ProfileConversion& operator=(ProfileConversion&&) noexcept;
  Grid<glm::vec3> convert(const Grid<glm::vec3>& encoded_srgb) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};
}  // namespace belvedere
