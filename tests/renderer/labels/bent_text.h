#pragma once

#include <string>

#include "renderer/labels/drawing.h"

namespace belvedere::test {

// The font that Debian draws text with; tests of widths and shapes are skipped where it is missing.
inline constexpr const char* sans = "DejaVu Sans";

// Words along a curved line.
inline DrawnText bent(const std::string& words, double spacing = 0.0) {
  return {.text = words,
          .type = {.family = sans, .size_px = 40.0, .spacing = spacing},
          .colour = "#102040",
          .halo = "#ffcc00",
          .halo_px = 5.0,
          .along = {{20, 180}, {150, 120}, {300, 100}, {450, 120}, {580, 180}}};
}

}  // namespace belvedere::test
