#pragma once

#include <string>
#include <string_view>

namespace belvedere {

// Text between tags of an SVG file or in an attribute. What XML 1.0 cannot hold at all becomes a blank.
inline std::string svg_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

}  // namespace belvedere
