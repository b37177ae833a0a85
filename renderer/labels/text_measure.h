#pragma once

#include <memory>
#include <string>

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

// Measures lines of text in any script, also from right to left, without hinting, so that a text twice as large is twice as wide. The only
// file that knows Pango. Throws Error(input) where no fonts are installed. For one thread at a time.
class TextMeasure {
 public:
  TextMeasure();
  ~TextMeasure();
  TextMeasure(const TextMeasure&) = delete;
  TextMeasure& operator=(const TextMeasure&) = delete;

  TextRoom measure(const std::string& text, const TextStyle& style) const;
  // The family that is taken for a style: of those it names the first that is installed, or what the system gives instead.
  std::string family_of(const TextStyle& style) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace belvedere
