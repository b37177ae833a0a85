#include "tools/studio/request_body.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text/json.h"

namespace belvedere::tools {
namespace {

using Value = nlohmann::ordered_json;  // as it was written

Error not_understood(const std::string& found) {
  return {ErrorKind::usage, "request", found, "JSON as in the documentation of the page"};
}

Value parse_body(const std::string& body) {
  if (body.empty()) return Value::object();
  Value value = Value::parse(body, nullptr, false);
  if (!value.is_object()) throw not_understood("the body is not a JSON object");
  return value;
}

constexpr int max_depth = 16;  // of lists in lists; scenes need 4

// JSON as TOML: only objects are written differently.
std::string toml_of(const Value& value, int depth = 0) {
  if (depth > max_depth) throw not_understood("a value is nested too deeply");
  if (value.is_null()) throw not_understood("null is no value of a scene");
  if (value.is_array()) {
    std::string list;
    for (const Value& element : value)
      list += (list.empty() ? "" : ", ") + toml_of(element, depth + 1);
    return "[" + list + "]";
  }
  if (value.is_object()) {
    std::string list;
    for (const auto& [name, member] : value.items())
      list += fmt::format("{}{} = {}", list.empty() ? "" : ", ", json_quoted(name),
                          toml_of(member, depth + 1));
    return "{ " + list + " }";
  }
  if (value.is_string()) return json_quoted(value.get<std::string>());
  return value.dump();
}

}  // namespace

SetBody read_set_body(const std::string& body) {
  const Value read = parse_body(body);
  const auto changes = read.find("changes");
  if (changes == read.end() || !changes->is_array()) throw not_understood("no list of changes");
  SetBody out;
  out.step = read_text_member(body, "step");
  for (const Value& change : *changes) {
    if (!change.is_object() || !change.contains("key") || !change["key"].is_string())
      throw not_understood("a change without a key");
    SceneEdit& edit = out.edits.emplace_back();
    edit.key = change["key"].get<std::string>();
    edit.append = change.contains("append");
    if (edit.append)
      edit.value = toml_of(change["append"]);
    else if (change.contains("value"))
      edit.value = toml_of(change["value"]);
    else if (change.value("remove", Value()) != true)
      throw not_understood(edit.key + " has neither value nor append nor remove");
  }
  return out;
}

std::string read_text_member(const std::string& body, const std::string& name,
                             const std::string& otherwise) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return otherwise;
  if (!member->is_string()) throw not_understood(name + " is not a text");
  return member->get<std::string>();
}

int read_number_member(const std::string& body, const std::string& name, int otherwise) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return otherwise;
  if (!member->is_number_integer() || *member < std::numeric_limits<int>::min() ||
      *member > std::numeric_limits<int>::max())
    throw not_understood(name + " is not a whole number");
  return member->get<int>();
}

std::optional<glm::dvec2> read_point_member(const std::string& body, const std::string& name) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return std::nullopt;
  if (!member->is_array() || member->size() != 2 || !(*member)[0].is_number() ||
      !(*member)[1].is_number())
    throw not_understood(name + " is not a list of two numbers");
  return glm::dvec2((*member)[0].get<double>(), (*member)[1].get<double>());
}

std::optional<bool> read_flag_member(const std::string& body, const std::string& name) {
  const Value read = parse_body(body);
  const auto member = read.find(name);
  if (member == read.end()) return std::nullopt;
  if (!member->is_boolean()) throw not_understood(name + " is neither true nor false");
  return member->get<bool>();
}

}  // namespace belvedere::tools
