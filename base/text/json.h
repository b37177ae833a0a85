#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace belvedere {

// Builds a JSON text. Members stay in the order they were added.
class Json {
 public:
  static Json object() { return Json("{}"); }
  static Json array(std::vector<Json> elements = {});
  static Json text(std::string_view text);
  // Shortest form that reads back the same. JSON has no infinities and no NaN: those become the
  // strings "inf", "-inf", "nan".
  static Json number(double value);
  static Json boolean(bool value) { return Json(value ? "true" : "false"); }
  // Text that is already JSON.
  static Json raw(std::string json) { return Json(std::move(json)); }
  static Json texts(const std::vector<std::string>& texts);
  // An array of them on one line.
  template <class Values>
  static Json numbers(const Values& values) {
    std::string list;
    for (const auto value : values)
      list += (list.empty() ? "" : ", ") + number(static_cast<double>(value)).scalar_;
    return Json("[" + list + "]");
  }

  // Adds a member to an object, an element to an array.
  Json& add(std::string_view key, Json value);
  Json& add(Json value);

  // Whether nothing was added to it.
  bool empty() const { return members_.empty(); }

  // Indented by two spaces a level, no line break at the end.
  std::string str(int depth = 0) const;

 private:
  explicit Json(std::string scalar) : scalar_(std::move(scalar)) {}

  std::string scalar_;  // a value, or "{}" and "[]" with members
  std::vector<std::pair<std::string, Json>> members_;
};

// In quotation marks, with the escapes that JSON and TOML share.
std::string json_quoted(std::string_view text);

}  // namespace belvedere
