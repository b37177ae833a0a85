#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "renderer/register/pair_proposals.h"
#include "terrain/io/dem.h"
#include "terrain/register/registration.h"
#include "tools/studio/http_server.h"
#include "tools/web/web_page.h"

namespace belvedere::tools {

struct PickingInput {
  std::string pairs;          // path of the table, made if it is missing
  std::string painting_name;  // for the page
  Grid<glm::vec3> painting;   // encoded RGB
  Dem dem;
  std::vector<NamedPlace> named;
  RegistrationParameters registration;
  std::string next;  // the command to go on with, for the page
  int port = 0;      // 0: any that is free; negative: no server, a room of another page
};

struct PickingState;

// Picks pairs of a painting's pixels and places of a map: answers the requests of
// docs/registration.md, about one table, until it is stopped.
class Picking {
 public:
  // Error as PairsSession, and Error(usage) where the port is in use.
  Picking(PickingInput input, Progress& progress);
  ~Picking();
  Picking(const Picking&) = delete;
  Picking& operator=(const Picking&) = delete;

  std::string address() const;
  // Until stop(), from another thread.
  void run();
  void stop();
  // As Studio::is_left.
  bool is_left(double wait_s = 5.0) const;
  // The answer to one request; for tests. Errors become answers.
  HttpAnswer answer(const HttpRequest& request);

 private:
  std::unique_ptr<PickingState> state_;
};

// A DEM as a relief map for finding places, north up: shaded from two sides and tinted by altitude,
// green in the valleys, pale above; grey without data. A pixel a cell, or the mean of as many as
// bring its longer side to longest_px. Encoded RGB.
struct ReliefMap {
  Grid<glm::vec3> picture;
  int cells_per_px = 1;  // along a side; at the right and lower border fewer
};
ReliefMap relief_map(const Dem& dem, int longest_px = 4096);

// A picture of encoded RGB as a pyramid of tiles in memory, to be served: JPEG by their names
// "LEVEL/COLUMN_ROW.jpg".
struct PictureTiles {
  TilePyramid pyramid;
  std::map<std::string, std::string> files;
};
PictureTiles picture_tiles(const Grid<glm::vec3>& picture, const TileParameters& parameters = {});

}  // namespace belvedere::tools
