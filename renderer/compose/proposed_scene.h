#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/compose/view_candidates.h"

namespace belvedere {

// Parameters of a scene besides its view.
struct ProposedFile {
  std::string file;                     // as the scene names it
  std::string crs = {};                 // if the file does not state it; empty: it does
  std::optional<double> lowest_m = {};  // values below it are invalid
  // As the scene's keys; empty: not known.
  std::string origin = {};
  std::string licence = {};
  std::string get_from = {};
  int band = 1;               // of the file
  std::string variable = {};  // of a file of several rasters
  std::string encoding = {};  // of colours that hold heights
};
struct ProposedScene {
  std::string title;
  std::vector<ProposedFile> sources;  // of the terrain
  std::string crs;                    // of the scene; empty: the program's default
  std::optional<ProposedFile> land_cover;
  std::string legend;
  std::string unknown;  // class of codes that the legend lacks; empty: they are errors
  std::string palette;  // empty: the default
  std::string palette_why;
  std::string style;  // built-in name or file; empty: the program's own look
  std::string rock;   // kind of rock; empty: the default
  std::string rock_why;
  int width_px = 2400;
  double sheet_width_mm = 1200.0;
  std::string number;  // "1 of 5"; empty: the only one
};

// The scene as TOML, with the reason of each value as a comment.
std::string proposed_scene_text(const ViewSearch& search, const Candidate& candidate,
                                const ProposedScene& about);
// The view in words.
struct ViewWords {
  std::string view;     // "looks south (179°), 27 to 65 km, 40° wide"
  std::string subject;  // "a summit of 3314 m, 2265 m above its valleys left of the centre"
};
ViewWords view_words(const ViewSearch& search, const Candidate& candidate);
// A line that describes the view: both, and its merit.
std::string describe_view(const ViewSearch& search, const Candidate& candidate);

struct ProposalParameters {
  int max = 6;  // 1…12
};

// The best views of a region that differ, best first: in their subject, or by 25° of azimuth and a
// quarter of the region's side in the viewer's position. Error(input), with what to do, for regions
// that are too small or mostly without data, and where no view fits the data or the request. Same
// result for any number of threads.
std::vector<Candidate> propose_views(const ViewSearch& search,
                                     const ProposalParameters& parameters = {});

// Errors for regions that are unsuitable for a picture, before any search. `name`: of the DEM, for
// messages.
void require_region(const CoarseGround& ground, const Massifs& massifs, const std::string& name);

}  // namespace belvedere
