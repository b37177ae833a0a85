#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "renderer/labels/label_style.h"

namespace belvedere {

// A box of the picture, px.
struct LabelBox {
  double left = 0.0;
  double top = 0.0;
  double right = 0.0;
  double bottom = 0.0;

  bool overlaps(const LabelBox& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

// A curved line that a name could be set on, with the boxes of its letters.
struct BentRoom {
  std::vector<glm::dvec2> baseline;
  std::vector<LabelBox> letters;
};

// A name to be placed.
struct LabelRequest {
  glm::dvec2 mark{0.0};    // px
  double mark_px = 0.0;    // across, 0 without a mark
  double width_px = 0.0;   // of the text
  double height_px = 0.0;  // of the text
  LabelPlace position = LabelPlace::above;
  bool on_skyline = false;  // only sky above the mark: the name goes to a row of the sky
  double rank = 5.0;        // small ranks are placed first; equal ones in their order
  std::vector<BentRoom> bent =
      {};  // for a name that follows a shape, best first; position and mark are then ignored
  std::vector<glm::dvec2> along = {};  // of LabelPlace::on: the line that it is centred on
  double area_px = 0.0;  // of LabelPlace::beside: width of the area that the name stands beside
  // Set by hand: from the mark to the centre of the text's lower edge, px. The name stands there
  // whatever is below it, and the others make room. For a name on a line its own shift.
  std::optional<glm::dvec2> by_hand_px = {};
};

struct LabelLayoutParameters {
  int width_px = 0;
  int height_px = 0;
  double margin_px = 6.0;            // from the picture's edge
  double clearance_px = 2.0;         // between names
  double gap_px = 2.0;               // between mark and name
  double row_px = 14.0;              // between rows
  double longest_leader_px = 160.0;  // in front of the sky
  double ground_leader_px = 30.0;    // in front of ground
  // Names of the same or better rank within a radius of a name, which is left out where there are
  // as many already; radius 0: any number. Names along lines do not count and are not left out.
  double crowd = 0.0;
  double crowd_radius_px = 0.0;
};

// Position of a name.
struct LabelSpot {
  bool placed = false;
  bool crowded = false;                   // not placed because there are enough names around
  LabelBox text;                          // for a curved name around all its letters
  std::vector<LabelBox> letters = {};     // of a curved name
  std::vector<glm::dvec2> baseline = {};  // of a curved name; empty: level
  bool has_leader = false;                // a line from the mark to leader_end, px; vertical
  glm::dvec2 leader_end{0.0};             // unless the name was placed by hand
};

// Finds positions for names so that no text overlaps another, a mark or a leader, and no leader a
// text or a mark. Ranks decide: a placed name keeps its position or moves to another free one, but
// is never dropped for one of lower rank. Names that do not fit are not placed. `skyline_px`: for
// each column of the picture the row above which there is sky (0 where there is none): names of the
// skyline are above it, in shared rows. Names placed by hand come first, and all of them are
// placed. Names beside their marks stay on the same side of
// `barriers` (rivers, shores) as these where they can. Deterministic.
std::vector<LabelSpot> place_labels(const std::vector<LabelRequest>& requests,
                                    const std::vector<double>& skyline_px,
                                    const LabelLayoutParameters& parameters,
                                    const std::vector<std::vector<glm::dvec2>>& barriers = {});

}  // namespace belvedere
