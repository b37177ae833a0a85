#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/config.h"
#include "renderer/scene/edit/toml_layout.h"

namespace belvedere {

// The value at a path of a document, or null.
const ConfigValue* node_at(const ConfigValue& root, const TomlPath& path);

// A TOML text in which values are replaced, added and removed, while everything else keeps its
// bytes. Whether the result says what was meant is for the caller to check.
class EditedText {
 public:
  explicit EditedText(std::string text);

  std::string text() const;
  bool exists(const TomlPath& path) const;
  // The written value of a key or an element; nothing for tables with headers.
  std::optional<std::string> value_at(const TomlPath& path) const;
  // `document` has the value already: it tells lists from tables.
  void set(const TomlPath& path, const std::string& value, const ConfigValue& document);
  void remove(const TomlPath& path);
  // The last name of a key; nothing where it is missing.
  void rename(const TomlPath& path, const std::string& name);

 private:
  using Kind = TomlPart::Kind;

  const TomlPart* written(const TomlPath& path) const;
  void replace(TextSpan span, const std::string& text);
  void replace_value(const TomlPart& part, const std::string& value);
  void merge(const TomlPath& path, const std::string& value, const ConfigValue& document);
  void add(const TomlPath& path, const std::string& value, const ConfigValue& document);
  void add_line(const TomlPath& path, const std::string& value, const ConfigValue& document);
  void add_block(const std::string& lines, const TomlPath& family, bool compact);
  void add_element(const TomlPath& list, const std::string& value, const ConfigValue& document);
  void add_item(const TomlPart& holder, const TomlPath& path, const std::string& value,
                const ConfigValue& document);
  void remove_item(std::size_t index);
  void remove_block(std::size_t header);
  void remove_vacant_header(const TomlPath& table);

  std::size_t first_comment(std::size_t header) const;
  std::size_t end_of_block(std::size_t index) const;
  std::size_t end_of_content(std::size_t index) const;
  std::optional<std::size_t> column_of_neighbours(std::size_t index) const;
  bool is_header(std::size_t index) const {
    return parts_[index].kind == Kind::header || parts_[index].kind == Kind::element;
  }

  std::string text_;
  std::string line_break_;
  bool ends_in_line_ = false;  // no line break at the end of the file
  std::vector<TomlPart> parts_;
};

}  // namespace belvedere
