#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

namespace belvedere {

// How a line of text is set.
struct TextStyle {
  std::string family = "serif";  // several, parted by commas: the first that is installed
  double size_px = 12.0;         // of the type, > 0
  bool bold = false;
  bool italic = false;
  double spacing = 0.0;  // between letters, of the type's size
};

// The room that a line of text takes: from its left end, up and down from its baseline. The box of the type, not of the letters' ink, so
// that lines of the same type are equally high.
struct TextRoom {
  double width_px = 0.0;
  double up_px = 0.0;
  double down_px = 0.0;
};

// One step of an outline, as of SVG paths: where it goes to, of a curve its two handles before that.
struct OutlineStep {
  enum Kind : int { move, line, curve, close };
  Kind kind = move;
  std::array<glm::dvec2, 3> points{};
};
using Outline = std::vector<OutlineStep>;
constexpr int points_of(OutlineStep::Kind kind) { return kind == OutlineStep::curve ? 3 : kind == OutlineStep::close ? 0 : 1; }

// A letter with its accents, or what a font makes of several letters: what is turned as one where a line is bent. From left to right.
struct TextLetter {
  double width_px = 0.0;  // to the next one
  std::string text;       // UTF-8, in the order of reading
  Outline outline;        // from the baseline's left end under the letter; empty: a space
};

// Measures lines of text in any script, also from right to left, without hinting, so that a text twice as large is twice as wide. The only
// file that knows Pango. Throws Error(input) where no fonts are installed. For one thread at a time.
class TextMeasure {
 public:
  TextMeasure();
  ~TextMeasure();
  TextMeasure(const TextMeasure&) = delete;
  TextMeasure& operator=(const TextMeasure&) = delete;

  TextRoom measure(const std::string& text, const TextStyle& style) const;
  // The same line letter by letter; the widths add up to the room's.
  std::vector<TextLetter> letters(const std::string& text, const TextStyle& style) const;
  // The family that is taken for a style: of those it names the first that is installed, or what the system gives instead.
  std::string family_of(const TextStyle& style) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
