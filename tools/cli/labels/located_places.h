#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/text/json.h"
#include "renderer/world/valley_view.h"

namespace belvedere::tools {

// Arguments of `deform --locate`: positions as "E,N", and files of points.
struct LocateQuestions {
  std::vector<std::string> positions;
  std::vector<std::string> files;
};
// "681500,5237300" is a position; a name with the extension of a file of points is a file. Throws
// Error(usage) for anything else.
LocateQuestions sort_questions(const std::vector<std::string>& asked);

// A table of all points of the files, for spreadsheets, and the same as JSON.
struct LocatedTable {
  std::string csv;
  Json json = Json::array();
};
LocatedTable locate_files(const BareView& bare, const std::vector<std::string>& files,
                          Progress& progress);
// A position in JSON: [x, y].
Json pair_json(glm::dvec2 p);

}  // namespace belvedere::tools
