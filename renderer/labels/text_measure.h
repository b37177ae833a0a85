#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

namespace belvedere {

// Style of a line of text.
struct TextStyle {
  std::string family = "serif";  // several, separated by commas: the first that is installed
  double size_px = 12.0;         // of the type, > 0
  int weight = 400;              // as in CSS: 400 regular, 700 bold; 100…900
  bool italic = false;
  double spacing = 0.0;  // between letters, of the type's size
};

// The extent of a line of text: from its left end, up and down from its baseline. The box of the
// type, not of the letters' ink, so that lines of the same type are equally high.
struct TextRoom {
  double width_px = 0.0;
  double up_px = 0.0;
  double down_px = 0.0;
};

// One segment of an outline, as in SVG paths: its end point, for a curve preceded by its two
// handles.
struct OutlineStep {
  enum Kind : int { move, line, curve, close };
  Kind kind = move;
  std::array<glm::dvec2, 3> points{};
};
using Outline = std::vector<OutlineStep>;
constexpr int points_of(OutlineStep::Kind kind) {
  return kind == OutlineStep::curve ? 3 : kind == OutlineStep::close ? 0 : 1;
}

// A letter with its accents, or a ligature: rotated as a unit on a curved line. From left to right.
struct TextLetter {
  double width_px = 0.0;  // to the next one
  std::string text;       // UTF-8, in reading order
  Outline outline;        // from the baseline's left end under the letter; empty: a space
};

// A text in capitals, the same for every language of the machine; ß becomes SS.
std::string capitals(const std::string& text);

// Measures lines of text in any script, also from right to left, without hinting, so that a text
// twice as large is twice as wide. Fonts are those of the system and those that an installed
// program brings along, in share/belvedere/fonts beside its bin. The only file that uses Pango.
// Throws Error(input) where there are no fonts. Not thread-safe.
class TextMeasure {
 public:
  TextMeasure();
  ~TextMeasure();
  TextMeasure(const TextMeasure&) = delete;
  TextMeasure& operator=(const TextMeasure&) = delete;

  TextRoom measure(const std::string& text, const TextStyle& style) const;
  // The same line letter by letter; the widths add up to the total.
  std::vector<TextLetter> letters(const std::string& text, const TextStyle& style) const;
  // Whether one of the families, separated by commas, is installed, so that no substitute is used.
  // "serif", "sans-serif", "sans" and "monospace" always are.
  static bool has_family(const std::string& families);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
