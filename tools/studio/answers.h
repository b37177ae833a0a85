#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/grid.h"
#include "base/text/json.h"
#include "renderer/live/live_view.h"
#include "tools/studio/scene_session.h"

namespace belvedere {
struct ViewEvaluation;
}

namespace belvedere::tools {

// Answers of the studio as JSON: docs/studio.md describes the members.

// {"error": …}, with line, column and key where the message has them.
Json error_json(const Error& error);
Json scene_json(const SceneSession& session, const std::vector<DerivedValue>& derived,
                const std::vector<std::string>& notes);
// Rungs, the size of each picture, and what it lacks.
Json rungs_json(const LoadedScene& scene, const std::vector<Rung>& rungs);
// Names, tracks and margin over a picture: sizes in px of the print, drawings as elements of SVG.
Json sheet_json(const LivePicture& picture);
// The ground seen, on a grid of at most 360 columns, for what the page draws under the hand.
std::string seen_bytes(const LivePicture& picture);
// The ground under a pixel, by its shares of the picture.
// The place of the map at a position of a DEM, m in its CRS, as api/pointer tells it; `sky` outside
// of the data.
Json place_json(const Dem& dem, glm::dvec2 position);
Json pointer_json(const LivePicture& picture, glm::dvec2 share);

// The map beside the picture: its frame and size, and what is drawn on it.
struct MapSize {
  int step = 1;  // cells of the ground to a pixel
  int width = 0;
  int height = 0;
};
MapSize map_size(const Dem& dem);
Json map_json(const LiveView::Ground& ground, const LoadedScene& scene);
// Shaded generalized relief, north up, in the colours of its classes; ground without data is grey.
Grid<glm::vec3> map_picture(const LiveView::Ground& ground);

Json check_json(const ViewEvaluation& evaluation);
// Views of the region as `new` proposes them, each as changes of the scene.
struct Proposal {
  std::string name;
  std::string why;
  std::vector<SceneEdit> edits;
};
std::vector<Proposal> find_proposals(const LiveView::Ground& ground);
Json proposals_json(const std::vector<Proposal>& proposals);
Json choices_json();

}  // namespace belvedere::tools
