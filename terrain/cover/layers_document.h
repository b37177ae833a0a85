#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/land_cover_class.h"

namespace belvedere {

// Reading of files of layers, whatever the layers are: class rules (class_rules.h) and surface layers (layers_file.h) are written in one
// language and read by this one reader, which knows their common parts and refuses everything else with its place.
struct LayersReader {
  const std::string& where;  // the file, for messages

  // Error(usage) at file:line:column.
  [[noreturn]] void fail(ConfigPlace place, const std::string& found, const std::string& allowed) const;
  // `what` is what the word should be one of.
  [[noreturn]] void fail_unknown(ConfigPlace place, const std::string& what, const std::string& word,
                                 const std::vector<std::string>& known) const;

  double number(const ConfigValue& value) const;  // finite
  double number_or(const ConfigTable& table, std::string_view key, double otherwise) const;
  std::string text_or(const ConfigTable& table, std::string_view key, const std::string& otherwise) const;
  std::string expression(const ConfigValue& value) const;  // not empty
  const ConfigValue& required(const ConfigTable& table, std::string_view key, ConfigPlace place, const std::string& of) const;
};

// A class of the ground by its name, not the sky.
LandCoverClass as_ground_class(const ConfigValue& value, const std::string& where);

// What all such files have.
struct LayersDocument {
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  // named numbers that expressions may use and a scene may set
  std::vector<std::pair<std::string, std::string>> terms;  // named sub-expressions, evaluated in order
  std::vector<ConfigPlace> term_places;
};

// Version, name, parameters and terms; the table may have `own_keys` as well. Names are new, can be written in
// expressions and are no variable, class or word of these.
LayersDocument read_layers_document(const LayersReader& reader, const ConfigValue& document, const std::vector<std::string>& own_keys);

// The list of layers, as it stands in the document.
const ConfigArray& layers_of(const LayersReader& reader, const ConfigValue& document);

}  // namespace belvedere
