#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/labels/drawing.h"
#include "renderer/labels/label_style.h"
#include "renderer/labels/text_measure.h"

namespace belvedere {

// Legend symbols of kinds of features.
enum class SwatchForm : int { line, cable, house };

// A kind of features for a legend. Colours "#rrggbb", empty: none; lengths in mm of the sheet, as
// in the foreground.
struct FeatureSwatch {
  std::string name;
  SwatchForm form = SwatchForm::line;
  std::string ground = "#c8cfa4";  // ground below it; empty: a piece of the picture
  std::string fill = "#f2e7cb";
  std::string casing = "#6b4a33";
  std::string bed = {};
  double width_mm = 0.6;    // of the fill, 0…50
  double min_px = 0.0;      // never narrower, 0…100
  double casing_mm = 0.14;  // of each edge, 0…10
  double bed_mm = 0.0;      // beyond the fill on each side, 0…50
  double opacity = 1.0;     // of fill and casing, 0…1
  glm::dvec2 dash_mm{0.0};  // of the fill: on and off; 0, 0: solid
  bool has_pylons = false;  // below a cable
};

// A short piece of it on its ground, in a box of that size whose corner is (0, 0), without a frame.
// Features wider than the box, such as ski runs of a small sheet, are drawn narrower.
std::vector<DrawnShape> draw_swatch(const FeatureSwatch& swatch, glm::dvec2 size_px,
                                    double px_per_mm);

struct LegendEntry {
  std::string name;
  std::string colour;  // "#rrggbb", where the picture cannot be shown
  PixelRect at = {};   // the piece of the picture that shows it; empty: the colour
};

// A piece of the picture, scaled to a rectangle of the paper.
struct LegendCrop {
  PixelRect from;  // of the sheet
  PixelRect to;    // of the paper, over its drawing's fills and below its lines
};

// The size of a length across the line of sight in the picture.
struct ScaleBar {
  double distance_m = 0.0;  // from the eye
  double px_per_m = 0.0;
};

// The texts beside a picture. Empty ones are left out.
struct MarginContent {
  std::string title;
  std::string subtitle;
  std::vector<LegendEntry> classes;
  std::vector<FeatureSwatch> features;  // roads, runs and the like, after the classes
  PixelRect features_at = {};           // the piece of the picture below them; empty: their ground
  std::vector<ScaleBar> scales;         // near ones first
  bool directions = false;              // with these three, degrees clockwise from north
  double view_azimuth_deg = 0.0;
  double sun_azimuth_deg = 0.0;
  double sun_altitude_deg = 0.0;
  std::vector<std::string> sources;
};

// Size of a swatch of the legend, mm.
glm::dvec2 swatch_size_mm(const MarginStyle& style);

// The largest round length (1, 2 or 5 times a power of ten) whose bar fits, m.
double bar_length_m(double px_per_m, double max_px);

// "10 km", "500 m".
std::string length_text(double length_m);

// A part of a margin, relative to its upper left corner.
struct MarginBlock {
  glm::dvec2 size{0.0};
  std::vector<DrawnShape> shapes;  // none: nothing to say
  std::vector<LegendCrop> crops = {};
};

// Sets the blocks of a margin in one style at one scale. Larger sheets are seen from farther away:
// above a width of 600 mm all of it grows with the root of the width, up to 1.5 times.
class MarginSetter {
 public:
  // Throws Error(input) as TextMeasure does. `style` must outlive it.
  MarginSetter(const MarginStyle& style, double px_per_mm, double picture_width_px);

  double mm(double length) const { return length * scale_; }

  // The title over a rule and the subtitle in spaced capitals, no wider than max_px.
  MarginBlock title(const MarginContent& content, double max_px) const;
  // Swatches with their names, in columns of that many.
  MarginBlock classes(const std::vector<LegendEntry>& entries, std::size_t rows) const;
  // On that piece of the picture; empty: on the colour of their ground.
  MarginBlock features(const std::vector<FeatureSwatch>& entries, PixelRect ground,
                       std::size_t rows) const;
  MarginBlock scales(const std::vector<ScaleBar>& bars) const;
  // A compass rose seen from above with the line of sight upward: north in its direction, the sun
  // on its side.
  MarginBlock directions(const MarginContent& content) const;
  // Credits of all sources one after the other, broken into lines.
  MarginBlock sources(const std::vector<std::string>& all, double max_px) const;

 private:
  struct Swatch {
    std::string name;
    std::vector<DrawnShape> shapes;
    PixelRect at = {};
  };

  double text_px() const { return mm(style_.text_mm); }
  DrawnText text(const std::string& words, glm::dvec2 at, double size_px, double anchor = 0.0,
                 bool italic = false) const;
  double width(const std::string& words, double size_px, bool italic = false) const;
  DrawnPath rule(glm::dvec2 from, glm::dvec2 to) const;
  // A heading in spaced capitals; returns the height below which the block goes on.
  double add_heading(const std::string& words, MarginBlock& block) const;
  // The rule below it, as wide as the block.
  void underline(MarginBlock& block) const;
  MarginBlock legend(const std::string& heading, std::vector<Swatch> entries,
                     std::size_t rows) const;
  glm::dvec2 swatch_px() const;
  void add_rose(const MarginContent& content, glm::dvec2 centre, double radius_px,
                std::vector<DrawnShape>& shapes) const;

  const MarginStyle& style_;
  double scale_;
  TextMeasure measure_;
};

}  // namespace belvedere
