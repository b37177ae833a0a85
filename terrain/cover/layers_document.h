#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/land_cover_class.h"

namespace belvedere {

// Reads files of layers of any kind: class rules (class_rules.h) and surface layers (layers_file.h)
// share a syntax. This reader reads the common parts and rejects everything unknown with its
// position.
struct LayersReader {
  const std::string& where;  // the file, for messages

  // Error(usage) at file:line:column.
  [[noreturn]] void fail(ConfigPosition position, const std::string& found,
                         const std::string& allowed) const;
  // `what` is the kind of word expected.
  [[noreturn]] void fail_unknown(ConfigPosition position, const std::string& what,
                                 const std::string& word,
                                 const std::vector<std::string>& known) const;

  double number(const ConfigValue& value) const;  // finite
  double number_or(const ConfigTable& table, std::string_view key, double otherwise) const;
  std::string text_or(const ConfigTable& table, std::string_view key,
                      const std::string& otherwise) const;
  std::string expression(const ConfigValue& value) const;  // not empty
  const ConfigValue& required(const ConfigTable& table, std::string_view key,
                              ConfigPosition position, const std::string& of) const;
};

// A class of the ground by its name, except the sky.
LandCoverClass as_ground_class(const ConfigValue& value, const std::string& where);

// The common parts of these files.
struct LayersDocument {
  std::string name;
  std::vector<std::pair<std::string, double>>
      parameters;  // named numbers for expressions; a scene may set them
  std::vector<std::pair<std::string, std::string>>
      terms;  // named sub-expressions, evaluated in order
  std::vector<ConfigPosition> term_places;
};

// Version, name, parameters and terms; the table may also have `own_keys`. Names must be unique,
// valid in expressions, and different from variables, classes and the words of expressions.
LayersDocument read_layers_document(const LayersReader& reader, const ConfigValue& document,
                                    const std::vector<std::string>& own_keys);

// The list of layers in the document.
const ConfigArray& layers_of(const LayersReader& reader, const ConfigValue& document);

}  // namespace belvedere
