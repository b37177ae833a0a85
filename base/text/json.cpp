#include "base/text/json.h"

#include <fmt/core.h>

#include <cmath>

namespace belvedere {

std::string json_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      out += c;
    }
  }
  return out + "\"";
}

Json Json::array(std::vector<Json> elements) {
  Json out("[]");
  for (Json& element : elements) out.add(std::move(element));
  return out;
}

Json Json::text(std::string_view text) { return Json(json_quoted(text)); }

Json Json::number(double value) {
  return std::isfinite(value) ? Json(fmt::format("{}", value)) : text(fmt::format("{}", value));
}

Json Json::texts(const std::vector<std::string>& texts) {
  Json out("[]");
  for (const std::string& element : texts) out.add(text(element));
  return out;
}

Json& Json::add(std::string_view key, Json value) {
  members_.emplace_back(key, std::move(value));
  return *this;
}

Json& Json::add(Json value) { return add("", std::move(value)); }

std::string Json::str(int depth) const {
  if (members_.empty()) return scalar_;
  const std::string indent(static_cast<std::size_t>(2 * depth + 2), ' ');
  const bool is_array = scalar_ == "[]";
  std::string out;
  for (const auto& [key, value] : members_)
    out += (out.empty() ? "\n" : ",\n") + indent + (is_array ? "" : json_quoted(key) + ": ") +
           value.str(depth + 1);
  out += "\n" + indent.substr(2);
  return is_array ? "[" + out + "]" : "{" + out + "}";
}

}  // namespace belvedere
