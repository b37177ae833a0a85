#include "base/text/config_reader.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "base/text/hex_colour.h"

namespace belvedere {

void ConfigReader::fail(const ConfigValue& value, const std::string& allowed) const {
  throw Error(ErrorKind::usage, config_where(name_, value.position), describe(value), allowed);
}

const ConfigValue* ConfigReader::known(const char* key) {
  keys_.emplace_back(key);
  return find(table_, key);
}

void ConfigReader::number(const char* key, double& to, double min, double max) {
  const ConfigValue* value = known(key);
  if (value == nullptr) return;
  to = as_number(*value, name_);
  if (!(to >= min && to <= max)) fail(*value, fmt::format("{:g} … {:g}", min, max));
}

void ConfigReader::pair(const char* key, glm::dvec2& to, double min, double max) {
  const ConfigValue* value = known(key);
  if (value == nullptr) return;
  const ConfigArray& array = as_array(*value, name_);
  const auto allowed = [&] { return fmt::format("two numbers, {:g} … {:g}", min, max); };
  if (array.size() != 2) fail(*value, allowed());
  to = {as_number(array[0], name_), as_number(array[1], name_)};
  for (int i = 0; i < 2; ++i)
    if (!(to[i] >= min && to[i] <= max)) fail(array[static_cast<std::size_t>(i)], allowed());
}

void ConfigReader::flag(const char* key, bool& to) {
  if (const ConfigValue* value = known(key)) to = as_bool(*value, name_);
}

void ConfigReader::text(const char* key, std::string& to) {
  if (const ConfigValue* value = known(key)) to = as_string(*value, name_);
}

void ConfigReader::texts(const char* key, std::vector<std::string>& to) {
  const ConfigValue* value = known(key);
  if (value == nullptr) return;
  to.clear();
  for (const ConfigValue& element : as_array(*value, name_))
    to.push_back(as_string(element, name_));
}

void ConfigReader::colour(const char* key, std::string& to) {
  const ConfigValue* value = known(key);
  if (value == nullptr) return;
  to = as_string(*value, name_);
  if (!colour_of_hex(to)) fail(*value, "\"#rrggbb\"");
}

void ConfigReader::colour(const char* key, glm::vec3& to) {
  std::string text;
  colour(key, text);
  if (!text.empty()) to = *colour_of_hex(text);
}

}  // namespace belvedere
