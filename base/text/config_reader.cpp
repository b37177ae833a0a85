#include "base/text/config_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "base/text/embedded.h"
#include "base/text/hex_colour.h"

namespace belvedere {

NamedConfig read_named_config(const std::string& folder, const std::string& name_or_path,
                              const std::string& what) {
  const std::vector<std::string> known = embedded_names(folder);
  if (std::find(known.begin(), known.end(), name_or_path) != known.end()) {
    const std::string name = folder + "/" + name_or_path + ".toml";
    return {parse_config(embedded_file(name), name), name};
  }
  if (name_or_path.find('/') == std::string::npos && lower_extension(name_or_path) != ".toml")
    throw Error(ErrorKind::usage, what,
                fmt::format("unknown {} \"{}\"{}", what, name_or_path,
                            nearest_word_hint(name_or_path, known)),
                fmt::format("{}, or a .toml file", fmt::join(known, ", ")));
  return {read_config(name_or_path), name_or_path};
}

glm::vec3 as_colour(const ConfigValue& value, const std::string& name) {
  const std::optional<glm::vec3> colour = colour_of_hex(as_string(value, name));
  if (!colour)
    refuse_value(value, name, describe(value), "\"#rrggbb\" in encoded sRGB, such as \"#7aa3cc\"");
  return *colour;
}

const ConfigValue* ConfigReader::known(const char* key) {
  keys_.emplace_back(key);
  return find(table_, key);
}

void ConfigReader::pair(const char* key, glm::dvec2& to, double min, double max) {
  const ConfigValue* value = known(key);
  if (value == nullptr) return;
  const std::vector<double> both = as_numbers(*value, name_, 2, min, max);
  to = {both[0], both[1]};
}

void ConfigReader::flag(const char* key, bool& to) {
  if (const ConfigValue* value = known(key)) to = as_bool(*value, name_);
}

void ConfigReader::text(const char* key, std::string& to) {
  if (const ConfigValue* value = known(key)) to = as_string(*value, name_);
}

void ConfigReader::texts(const char* key, std::vector<std::string>& to) {
  if (const ConfigValue* value = known(key)) to = as_strings(*value, name_);
}

void ConfigReader::colour(const char* key, std::string& to) {
  const ConfigValue* value = known(key);
  if (value == nullptr) return;
  as_colour(*value, name_);
  to = as_string(*value, name_);
}

void ConfigReader::colour(const char* key, glm::vec3& to) {
  if (const ConfigValue* value = known(key)) to = as_colour(*value, name_);
}

}  // namespace belvedere
