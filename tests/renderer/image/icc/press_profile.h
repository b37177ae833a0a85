#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/image/icc/press_colour.h"

namespace belvedere::test {

// A press profile by others: Ghostscript's, which Debian packs alone (libgs-common, named in
// tools/setup).
inline const std::string press_file = "/usr/share/color/icc/ghostscript/default_cmyk.icc";
inline std::vector<std::uint8_t> press_profile() { return read_press_profile(press_file); }

// The profile with four letters of its header exchanged: at 12 its class, at 16 its colours
// (ICC.1, 7.2).
inline std::string changed_header(const std::vector<std::uint8_t>& profile, std::size_t at,
                                  const std::string& letters) {
  std::string text(profile.begin(), profile.end());
  return text.replace(at, letters.size(), letters);
}

}  // namespace belvedere::test
