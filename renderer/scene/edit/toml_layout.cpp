#include "renderer/scene/edit/toml_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "base/text/json.h"

namespace belvedere {
namespace {

class LayoutScan {
 public:
  explicit LayoutScan(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) i_ = 3;  // a byte order mark
  }

  std::vector<TomlPart> run() {
    while (i_ < text_.size()) line();
    return std::move(parts_);
  }

 private:
  using Kind = TomlPart::Kind;

  char peek() const { return i_ < text_.size() ? text_[i_] : '\n'; }

  void line() {
    const std::size_t index = parts_.size();
    parts_.emplace_back().whole.begin = i_;
    skip_blanks();
    if (peek() == '[') {
      header(parts_[index]);
    } else if (peek() != '#' && peek() != '\r' && peek() != '\n') {
      parts_[index].kind = Kind::value;
      parts_[index].table = table_;
      named_value(index, table_);
    }
    skip_blanks();
    TomlPart& part = parts_[index];
    if (peek() == '#') {
      if (part.kind == Kind::blank) part.kind = Kind::comment;
      part.has_comment = true;
    }
    i_ = std::min(text_.find('\n', i_), text_.size() - 1) + 1;
    part.whole.end = i_;
  }

  void header(TomlPart& part) {
    const bool list = text_.substr(i_, 2) == "[[";
    part.kind = list ? Kind::element : Kind::header;
    i_ += list ? 2 : 1;
    const TomlPath names = key();
    i_ += list ? 2 : 1;
    table_.clear();
    for (std::size_t n = 0; n < names.size(); ++n) {
      table_.push_back(names[n]);
      std::size_t* count = nullptr;
      if (list && n + 1 == names.size())
        count = &lists_.try_emplace(table_, 0).first->second, ++*count;
      else if (const auto found = lists_.find(table_); found != lists_.end())
        count = &found->second;
      if (count != nullptr) table_.push_back(std::to_string(*count - 1));
    }
    part.path = table_;
  }

  // Up to the sign that ends it: "]", "=".
  TomlPath key() {
    TomlPath names;
    while (i_ < text_.size()) {
      skip_blanks();
      const std::size_t begin = i_;
      if (peek() == '"' || peek() == '\'') {
        skip_string();
        const ConfigValue name = parse_config_value(text_.substr(begin, i_ - begin), "");
        names.push_back(std::get<std::string>(name.value));
      } else {
        i_ = std::min(text_.find_first_of(" \t.=]\n", i_), text_.size());
        names.emplace_back(text_.substr(begin, i_ - begin));
      }
      key_end_ = i_;
      skip_blanks();
      if (peek() != '.') break;
      ++i_;
    }
    return names;
  }

  void named_value(std::size_t index, const TomlPath& above) {
    const std::size_t begin = i_;
    TomlPath path = above;
    for (std::string& name : key()) path.push_back(std::move(name));
    parts_[index].key = {begin, key_end_};
    parts_[index].path = std::move(path);
    ++i_;  // "="
    skip_blanks();
    value(index);
  }

  void value(std::size_t index) {
    const std::size_t begin = i_;
    const char first = peek();
    if (first == '"' || first == '\'') {
      skip_string();
    } else if (first == '[' || first == '{') {
      items(index, first == '[');
    } else {
      i_ = std::min(text_.find_first_of(",]}#\r\n", i_), text_.size());
      while (i_ > begin && (text_[i_ - 1] == ' ' || text_[i_ - 1] == '\t')) --i_;
    }
    parts_[index].value = {begin, i_};
  }

  void items(std::size_t holder, bool array) {
    ++i_;
    const TomlPath around = parts_[holder].path;
    for (std::size_t n = 0; i_ < text_.size();) {
      const char c = text_[i_];
      if (c == ']' || c == '}') {
        ++i_;
        return;
      }
      if (c == '#') {
        i_ = std::min(text_.find('\n', i_), text_.size());
      } else if (c == ',' || c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        ++i_;
      } else {
        const std::size_t index = parts_.size();
        const std::size_t begin = i_;
        parts_.emplace_back().kind = Kind::item;
        parts_[index].holder = holder;
        if (array) {
          parts_[index].path = around;
          parts_[index].path.push_back(std::to_string(n++));
          value(index);
        } else {
          named_value(index, around);
        }
        parts_[index].whole = {begin, i_};
      }
    }
  }

  void skip_blanks() { i_ = std::min(text_.find_first_not_of(" \t", i_), text_.size()); }

  void skip_string() {
    const char quote = text_[i_];
    const std::string fence(3, quote);
    const bool many_lines = text_.substr(i_, 3) == fence;
    i_ += many_lines ? 3 : 1;
    while (i_ < text_.size() &&
           text_.substr(i_, many_lines ? 3 : 1) != fence.substr(many_lines ? 0 : 2))
      i_ += quote == '"' && text_[i_] == '\\' ? 2 : 1;
    i_ = std::min(i_ + (many_lines ? 3 : 1), text_.size());
    // Up to two quotation marks before the fence belong to the text.
    for (int n = 0; many_lines && n < 2 && i_ < text_.size() && text_[i_] == quote; ++n) ++i_;
  }

  std::string_view text_;
  std::size_t i_ = 0;
  std::size_t key_end_ = 0;
  std::vector<TomlPart> parts_;
  TomlPath table_;                         // of the last header
  std::map<TomlPath, std::size_t> lists_;  // elements so far
};

}  // namespace

std::vector<TomlPart> toml_layout(std::string_view text) { return LayoutScan(text).run(); }

bool lies_in(const TomlPath& path, const TomlPath& above) {
  return path.size() >= above.size() && std::equal(above.begin(), above.end(), path.begin());
}

TomlPath first_of(const TomlPath& path, std::size_t count) {
  return {path.begin(), path.begin() + static_cast<std::ptrdiff_t>(count)};
}

TomlPath above(const TomlPath& path) { return first_of(path, path.size() - 1); }

std::string toml_key(std::string_view name) {
  const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  return bare ? std::string(name) : json_quoted(name);
}

std::string toml_text(const ConfigValue& value) {
  struct Writer {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::string& text) const { return json_quoted(text); }
    std::string operator()(const ConfigArray& list) const {
      std::vector<std::string> elements;
      for (const ConfigValue& element : list) elements.push_back(toml_text(element));
      return fmt::format("[{}]", fmt::join(elements, ", "));
    }
    std::string operator()(const ConfigTable& table) const {
      std::vector<std::string> members;
      for (const ConfigEntry& entry : table)
        members.push_back(toml_key(entry.key) + " = " + toml_text(entry.value));
      return members.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(members, ", "));
    }
  };
  return std::visit(Writer{}, value.value);
}

}  // namespace belvedere
