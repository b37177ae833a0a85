#pragma once

#include <string>
#include <vector>

namespace belvedere {

// Where a name stands by its mark.
enum class LabelPlace : int {
  above,   // over the mark, higher up with a leader where that is taken; on the skyline in rows
  beside,  // on any side of the mark
  over     // in the middle of the place itself
};

enum class LabelMarkShape : int { none, dot, ring, triangle, square };

// How the names of one kind are set. Lengths in mm of the sheet; colours "#rrggbb".
struct LabelKindStyle {
  std::string name;               // as files say it: "summit"
  std::vector<std::string> also;  // other words for it
  LabelPlace place = LabelPlace::beside;
  std::string family = "serif";  // as fontconfig knows them, several parted by commas: the first that is installed
  double size_mm = 3.5;          // of the type, 0.5…100
  bool bold = false;
  bool italic = false;
  double lift = -0.3;    // how high the baseline of a bent name lies over its line, of the type's size, -3…3
  double aside = 0.0;    // how far below or above that it may lie where others are in the way, of the type's size, 0…5
  double spacing = 0.0;  // between letters, of the type's size, 0…2
  std::string colour = "#202020";
  std::string halo = "#ffffff";  // around the letters
  double halo_mm = 0.4;          // 0…10
  LabelMarkShape mark = LabelMarkShape::dot;
  double mark_mm = 1.0;   // across, 0…20
  bool altitude = false;  // said behind the name
  double climb_m = 0.0;   // the mark goes to the drawn summit that far away at most, 0…5000
};

// How ways are drawn.
struct TrackStyle {
  std::string colour = "#c1272d";
  double width_mm = 0.8;  // 0.05…20
  std::string halo = "#ffffff";
  double halo_mm = 0.25;  // 0…10
};

// The paper around a picture.
struct MarginStyle {
  std::string family = "serif";
  std::string paper = "#fdfaf2";
  std::string ink = "#1f2634";
  std::string sun = "#f2c33d";
  double title_mm = 14.0;  // 1…200
  double text_mm = 4.0;    // 0.5…50
};

struct LabelStyle {
  std::string name;  // of the file, for messages
  double least_px = 11.0;
  double gap_mm = 0.9;
  double row_mm = 6.5;
  double longest_leader_mm = 75.0;
  double clearance_mm = 0.7;
  double margin_mm = 3.0;
  std::string leader = "#404040";
  double leader_mm = 0.22;
  TrackStyle track;
  MarginStyle margin;
  std::vector<LabelKindStyle> kinds;  // in the order of the file; the first is that of points that say no kind

  // The kind that a word means, small and capital letters alike; -1 where none does.
  int find(const std::string& word) const;
};

// A built-in style ("classic") or a .toml file. Throws Error(usage) at line and column for what is no style; Error(input) where the file is
// missing.
LabelStyle load_label_style(const std::string& name_or_file);
LabelStyle parse_label_style(const std::string& text, const std::string& name);

}  // namespace belvedere
