#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "renderer/world/valley_view.h"

namespace belvedere::tools {

// What `deform --locate` was asked: places as "E,N", and files of points.
struct LocateQuestions {
  std::vector<std::string> places;
  std::vector<std::string> files;
};
// "681500,5237300" is a place; what ends as a file of points does is a file. Throws Error(usage) for anything else.
LocateQuestions sort_questions(const std::vector<std::string>& asked);

// A table of all points of the files, for spreadsheets, and the same for machines.
struct LocatedTable {
  std::string csv;
  Json json = Json::array();
};
LocatedTable locate_files(const BareView& bare, const std::vector<std::string>& files, Progress& progress);
// A place as it is told to machines: [x, y].
Json pair_json(glm::dvec2 p);

}  // namespace belvedere::tools
