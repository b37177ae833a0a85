#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/text/text_encoding.h"

namespace belvedere {

// A document and its name for messages.
struct NamedConfig {
  ConfigValue root;
  std::string name;
};
// The built-in document of that name in `folder`, or that of a .toml file. Error(usage) for `what`
// ("palette") if it is neither.
NamedConfig read_named_config(const std::string& folder, const std::string& name_or_path,
                              const std::string& what);

// "#rrggbb" as encoded sRGB 0…1.
glm::vec3 as_colour(const ConfigValue& value, const std::string& name);

// Reads values of one table into members, each with its range, so that a style file's keys take one
// line each. All throw Error(usage) at the value's line and column.
class ConfigReader {
 public:
  // Both must outlive it.
  ConfigReader(const ConfigValue& value, const std::string& name)
      : table_(as_table(value, name)), name_(name) {}

  // Each leaves `to` unchanged if the key is absent.
  template <class T>
  void number(const char* key, T& to, double min, double max) {
    if (const ConfigValue* value = known(key))
      to = static_cast<T>(as_number(*value, name_, min, max));
  }
  void pair(const char* key, glm::dvec2& to, double min, double max);
  void flag(const char* key, bool& to);
  void text(const char* key, std::string& to);
  void texts(const char* key, std::vector<std::string>& to);
  void colour(const char* key, glm::vec3& to);
  // "#rrggbb" as text.
  void colour(const char* key, std::string& to);
  template <class T>
  void word(const char* key, T& to, const std::vector<std::pair<std::string, T>>& words) {
    const ConfigValue* value = known(key);
    if (value == nullptr) return;
    const std::string& text = as_string(*value, name_);
    std::string all;
    for (const auto& [word, meaning] : words) {
      if (text == word) {
        to = meaning;
        return;
      }
      all += (all.empty() ? "\"" : ", \"") + word + '"';
    }
    refuse_value(*value, name_, describe(*value), all);
  }
  // The value of a key, which is then known; null if it is absent.
  const ConfigValue* known(const char* key);
  // Error(usage) for every key that was not read.
  void end() const { allow_only(table_, keys_, name_); }

 private:
  const ConfigTable& table_;
  const std::string& name_;
  std::vector<std::string> keys_;
};

// The index of the kind of a style that a word means, by its name or one of `also`, in any case;
// -1: none.
template <class Kind>
int find_kind(const std::vector<Kind>& kinds, const std::string& word) {
  const std::string wanted = lower_case(word);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (lower_case(kinds[k].name) == wanted) return static_cast<int>(k);
    for (const std::string& other : kinds[k].also)
      if (lower_case(other) == wanted) return static_cast<int>(k);
  }
  return -1;
}

}  // namespace belvedere
