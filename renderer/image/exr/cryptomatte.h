#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/image/image_file.h"

namespace belvedere {

// Masks by name in OpenEXR as compositing programs read them: Cryptomatte 1.2 (Psyop), whose
// channels LAYER00.r, .g, .b, .a hold the two names that cover most of a pixel, each as an id and
// its share of the pixel.

// MurmurHash3_x86_32 with seed 0 (A. Appleby).
std::uint32_t murmur_hash3(std::string_view text);
// The id of a name: its hash as the bits of a float. A hash that would be zero, subnormal, infinite
// or no number gets another exponent.
float cryptomatte_id(std::string_view name);
// The attributes of a layer: its name, how ids are made, and a manifest of all names.
FileNotes cryptomatte_notes(const std::string& layer, const std::vector<std::string>& names);

}  // namespace belvedere
