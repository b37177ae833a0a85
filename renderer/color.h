#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/image.h"

namespace belvedere {

// Colour management. color.cpp is the only file that knows OpenColorIO, icc.cpp the only one that knows lcms2.
struct ColorParameters {
  std::string config;   // an OCIO config file; empty: $OCIO, else the program's own config, built in memory
  std::string working = "lin_srgb";  // name of the scene-linear space in it
  std::string display = "srgb";      // name of the encoded space of PNG and TIFF
};

// Scene-linear to encoded 0…1. Error(input) names a bad config or space.
Grid<glm::vec3> to_display(const Image& linear, const ColorParameters& parameters);
Image from_display(const Grid<glm::vec3>& encoded, const ColorParameters& parameters);
// "own" or the file's name, and OCIO's version: for provenance.
std::string describe_color(const ColorParameters& parameters);

// An sRGB profile made by lcms2 (same bytes every time: its date is fixed), for embedding.
std::vector<std::uint8_t> srgb_profile();
// Reads an ICC file; Error(input) where it is missing or no RGB profile.
std::vector<std::uint8_t> read_icc_profile(const std::string& path);
// Encoded sRGB to the device space of an RGB profile, perceptual intent with black-point compensation.
Grid<glm::vec3> to_profile(const Grid<glm::vec3>& encoded_srgb, const std::vector<std::uint8_t>& profile);

}  // namespace belvedere
