#pragma once

#include <string>
#include <vector>

namespace belvedere {

// Position of a name relative to its mark.
enum class LabelPlace : int {
  above,   // above the mark, higher up with a leader where that is taken; on the skyline in rows
  beside,  // on any side of the mark
  over,    // centred on the position itself
  on       // in a disc on the line of its shape, as numbers of ski runs
};

enum class LabelMarkShape : int { none, dot, ring, triangle, square };

// Style of the names of one kind. Lengths in mm of the sheet; colours "#rrggbb".
struct LabelKindStyle {
  std::string name;               // as in files: "summit"
  std::vector<std::string> also;  // other words for it
  LabelPlace position = LabelPlace::beside;
  std::string family =
      "serif";  // as known to fontconfig, several separated by commas: the first that is installed
  double size_mm = 3.5;    // of the type at rank 5, 0.5…100
  double rank_step = 0.0;  // by which each better rank enlarges it, of size_mm, 0…0.2
  int weight = 400;        // 400 regular, 700 bold; 100…900
  bool italic = false;
  bool capitals = false;
  double lift =
      -0.3;  // height of the baseline of a curved name above its line, of the type's size, -3…3
  double aside =
      0.0;  // further offsets below or above where others block it, of the type's size, 0…5
  double spacing = 0.0;  // between letters, of the type's size, 0…2
  std::string colour = "#202020";
  std::string light = "#fdf9ee";  // on dark ground
  // Mean luminance of the ground below which letters are light, 0…1. Dark letters on ground of .075
  // would need a halo four times as light as it; spaced ones have no halo that holds them together.
  double light_below = 0.075;
  std::string halo = "#ffffff";  // around the letters where there is no picture below them
  double halo_mm = 0.35;         // 0…10
  LabelMarkShape mark = LabelMarkShape::dot;
  double mark_mm = 1.0;   // across, 0…20
  bool altitude = false;  // under a name that stands above its mark, else after it
  bool barrier = false;   // names of places stay on their side of this line or area
  bool straight = false;  // its line runs straight from end to end over the ground, as cables
  double climb_m = 0.0;   // maximum distance of the drawn summit that the mark moves to, 0…5000
};

// Style of tracks.
struct TrackStyle {
  std::string colour = "#c1272d";
  double width_mm = 0.8;  // 0.05…20
  std::string halo = "#ffffff";
  double halo_mm = 0.25;  // 0…10
};

// Altitudes beside names.
struct AltitudeStyle {
  std::string family = "serif";
  double size = 0.8;  // of the name's size, 0.3…1
  int weight = 400;
  std::string colour = "#404040";
};

// The paper around a picture.
struct MarginStyle {
  std::string family = "serif";        // title and texts
  std::string heading = "sans-serif";  // headings and names in the legend
  std::string paper = "#fdfaf2";
  std::string ink = "#1f2634";
  std::string sun = "#f2c33d";
  double title_mm = 14.0;  // 1…200
  double text_mm = 4.0;    // 0.5…50
};

struct LabelStyle {
  std::string name;  // of the file, for messages
  double min_px = 11.0;
  double gap_mm = 0.9;
  double row_mm = 6.5;
  double longest_leader_mm = 75.0;  // in front of the sky
  double ground_leader_mm = 12.0;   // in front of ground
  double min_contrast = 4.0;        // of letters to the ground beside them (WCAG 2: 1…21), 1…12
  double names_per_dm2 = 4.0;       // of the same or better rank around a name, 0.1…1000
  double clearance_mm = 0.7;
  double margin_mm = 3.0;
  std::string leader = "#404040";
  double leader_mm = 0.22;
  AltitudeStyle altitude;
  TrackStyle track;
  MarginStyle margin;
  std::vector<LabelKindStyle>
      kinds;  // in the order of the file; the first is that of points without a kind

  // The kind that a word denotes, ignoring case; -1 where none does.
  int find(const std::string& word) const;
};

// A built-in style ("classic") or a .toml file. Throws Error(usage) with line and column for an
// invalid style; Error(input) where the file is missing.
LabelStyle load_label_style(const std::string& name_or_file);
LabelStyle parse_label_style(const std::string& text, const std::string& name);

}  // namespace belvedere
