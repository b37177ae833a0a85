#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/scene/edit/scene_edit.h"

namespace belvedere::tools {

// Bodies of requests, which are JSON. The only code that reads it with nlohmann-json. Error(usage)
// for what is not JSON or lacks a member.

struct SetBody {
  std::vector<SceneEdit> edits;
  std::string step;
};
SetBody read_set_body(const std::string& body);
// A member that is a text, or a whole number; `otherwise` where there is none.
std::string read_text_member(const std::string& body, const std::string& name,
                             const std::string& otherwise = {});
int read_number_member(const std::string& body, const std::string& name, int otherwise);
// A member that is a list of two numbers, or true or false; nothing where there is none.
std::optional<glm::dvec2> read_point_member(const std::string& body, const std::string& name);
std::optional<bool> read_flag_member(const std::string& body, const std::string& name);

}  // namespace belvedere::tools
