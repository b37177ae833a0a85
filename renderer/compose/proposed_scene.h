#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/compose/view_candidates.h"

namespace belvedere {

// What goes into a scene besides its view.
struct ProposedFile {
  std::string file;                     // as the scene names it
  std::string crs = {};                 // that the file does not say; empty: it does
  std::optional<double> lowest_m = {};  // below it the file's values are wrong
  // As the scene's keys; empty: not known.
  std::string origin = {};
  std::string licence = {};
  std::string get_from = {};
  int band = 1;  // of the file
};
struct ProposedScene {
  std::string title;
  std::vector<ProposedFile> sources;  // of the terrain
  std::string crs;                    // of the scene; empty: chosen as the program does
  std::optional<ProposedFile> land_cover;
  std::string legend;
  std::string unknown;  // class of codes that the legend lacks; empty: they are faults
  std::string palette;  // empty: the usual one
  std::string palette_why;
  std::string rock;  // kind of rock; empty: the usual one
  std::string rock_why;
  int width_px = 2400;
  double sheet_width_mm = 1200.0;
  std::string number;  // "1 of 5"; empty: the only one
};

// The scene as TOML, with a comment at each value that says why it is so.
std::string proposed_scene_text(const ViewSearch& search, const Candidate& candidate, const ProposedScene& about);
// A line for people: what the view shows.
std::string describe_view(const ViewSearch& search, const Candidate& candidate);

}  // namespace belvedere
