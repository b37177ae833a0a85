#include "renderer/scene/edit/edited_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "renderer/scene/scene_schema.h"

// Removal of parts of a text, with their commas, comments and blank lines.

namespace belvedere {
namespace {

std::string dotted(const TomlPath& names, std::size_t from = 0) {
  std::string out;
  for (std::size_t n = from; n < names.size(); ++n)
    out += (n > from ? "." : "") + toml_key(names[n]);
  return out;
}

bool is_list(const ConfigValue& document, const TomlPath& path) {
  const ConfigValue* node = node_at(document, path);
  return node != nullptr && node->is_array();
}

// "deform.handles" of {"deform", "handles", "0"}.
std::string header_name(const TomlPath& path, const ConfigValue& document) {
  TomlPath names;
  for (std::size_t n = 0; n < path.size(); ++n)
    if (!is_list(document, first_of(path, n))) names.push_back(path[n]);
  return dotted(names);
}

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
  }));
}

}  // namespace

const ConfigValue* node_at(const ConfigValue& root, const TomlPath& path) {
  const ConfigValue* node = &root;
  for (const std::string& part : path) {
    if (const auto* table = std::get_if<ConfigTable>(&node->value)) {
      node = find(*table, part);
    } else if (const auto* list = std::get_if<ConfigArray>(&node->value)) {
      std::size_t i = 0;
      while (i < list->size() && std::to_string(i) != part) ++i;
      node = i < list->size() ? &(*list)[i] : nullptr;
    } else {
      node = nullptr;
    }
    if (node == nullptr) return nullptr;
  }
  return node;
}

EditedText::EditedText(std::string text) : text_(std::move(text)) {
  const std::size_t first = text_.find('\n');
  line_break_ = first != std::string::npos && first > 0 && text_[first - 1] == '\r' ? "\r\n" : "\n";
  ends_in_line_ = !text_.empty() && text_.back() != '\n';
  if (ends_in_line_) text_ += line_break_;
  parts_ = toml_layout(text_);
}

std::string EditedText::text() const {
  if (!ends_in_line_ || !text_.ends_with(line_break_)) return text_;
  return text_.substr(0, text_.size() - line_break_.size());
}

bool EditedText::exists(const TomlPath& path) const {
  return std::any_of(parts_.begin(), parts_.end(), [&](const TomlPart& part) {
    return part.kind != Kind::blank && part.kind != Kind::comment && lies_in(part.path, path);
  });
}

const TomlPart* EditedText::written(const TomlPath& path) const {
  for (const TomlPart& part : parts_)
    if ((part.kind == Kind::value || part.kind == Kind::item) && part.path == path) return &part;
  return nullptr;
}

std::optional<std::string> EditedText::value_at(const TomlPath& path) const {
  const TomlPart* part = written(path);
  if (part == nullptr) return std::nullopt;
  return text_.substr(part->value.begin, part->value.end - part->value.begin);
}

void EditedText::replace(TextSpan span, const std::string& text) {
  text_.replace(span.begin, span.end - span.begin, text);
  parts_ = toml_layout(text_);
}

void EditedText::set(const TomlPath& path, const std::string& value, const ConfigValue& document) {
  if (const TomlPart* part = written(path))
    replace_value(*part, value);
  else if (exists(path))
    merge(path, value, document);
  else
    add(path, value, document);
}

void EditedText::rename(const TomlPath& path, const std::string& name) {
  const TomlPart* part = written(path);
  if (part == nullptr || !std::string_view(text_).substr(0, part->key.end).ends_with(path.back()))
    return;
  replace({part->key.end - path.back().size(), part->key.end}, name);
}

// Comments at the ends of neighbouring lines that were padded to one column. The column of a
// comment is kept if it is that of its neighbours, or was pushed out by a long value.
std::optional<std::size_t> EditedText::column_of_neighbours(std::size_t index) const {
  const auto column = [&](std::size_t i) -> std::optional<std::size_t> {
    const TomlPart& part = parts_[i];
    if (part.kind != Kind::value || !part.has_comment) return std::nullopt;
    const std::string_view line =
        std::string_view(text_).substr(part.whole.begin, part.whole.end - part.whole.begin);
    const std::size_t end = part.value.end - part.whole.begin;
    const std::size_t mark = line.find('#', end);
    if (mark < end + 2 || line.find('\n') + 1 != line.size()) return std::nullopt;
    return letters(line.substr(0, mark));
  };
  std::size_t next = index + 1;
  while (next < parts_.size() && parts_[next].kind == Kind::item) ++next;
  if (next < parts_.size())
    if (const auto found = column(next)) return found;
  std::size_t before = index;
  while (before > 0 && parts_[before - 1].kind == Kind::item) --before;
  return before > 0 ? column(before - 1) : std::nullopt;
}

void EditedText::replace_value(const TomlPart& part, const std::string& value) {
  TextSpan span = part.value;
  std::string text = value;
  const std::string_view whole = text_;
  const std::string_view line = whole.substr(part.whole.begin, part.whole.end - part.whole.begin);
  const bool is_line = part.kind == Kind::value && part.has_comment &&
                       line.find('\n') + 1 == line.size() && value.find('\n') == std::string::npos;
  const auto column = is_line
                          ? column_of_neighbours(static_cast<std::size_t>(&part - parts_.data()))
                          : std::nullopt;
  if (column) {
    const std::size_t mark = whole.find('#', span.end);
    const auto at = [&](std::size_t end) { return std::max(*column, end + 1); };
    const std::size_t old_end =
        letters(whole.substr(part.whole.begin, span.end - part.whole.begin));
    if (letters(whole.substr(part.whole.begin, mark - part.whole.begin)) == at(old_end)) {
      const std::size_t new_end =
          letters(whole.substr(part.whole.begin, span.begin - part.whole.begin)) + letters(value);
      text += std::string(at(new_end) - new_end, ' ');
      span.end = mark;
    }
  }
  replace(span, text);
}

// A table or a list with headers gets the members of `value`, one by one.
void EditedText::merge(const TomlPath& path, const std::string& value,
                       const ConfigValue& document) {
  const std::string line = "v = " + value;
  const std::vector<TomlPart> layout = toml_layout(line);
  if (!value.starts_with('{') && !value.starts_with('[')) {
    remove(path);
    return add(path, value, document);
  }
  for (const TomlPart& part : layout) {
    if (part.kind != Kind::item || part.holder != 0) continue;
    TomlPath member = path;
    member.insert(member.end(), part.path.begin() + 1, part.path.end());
    set(member, line.substr(part.value.begin, part.value.end - part.value.begin), document);
  }
  const auto is_meant = [&](const std::string& name) {
    return std::any_of(layout.begin(), layout.end(), [&](const TomlPart& part) {
      return part.kind == Kind::item && part.path[1] == name;
    });
  };
  std::vector<TomlPath> extra;
  for (const TomlPart& part : parts_)
    if (lies_in(part.path, path) && part.path.size() > path.size() &&
        !is_meant(part.path[path.size()]))
      extra.push_back(first_of(part.path, path.size() + 1));
  extra.erase(std::unique(extra.begin(), extra.end()), extra.end());
  for (auto member = extra.rbegin(); member != extra.rend(); ++member) remove(*member);
}

void EditedText::add(const TomlPath& path, const std::string& value, const ConfigValue& document) {
  for (std::size_t n = path.size() - 1; n > 0; --n)
    if (const TomlPart* holder = written(first_of(path, n)))
      return add_item(*holder, path, value, document);
  const TomlPath table = above(path);
  if (is_list(document, table)) {
    if (value.starts_with('{')) return add_element(table, value, document);
    return add(table, toml_text(*node_at(document, table)), document);
  }
  for (std::size_t n = 1; n <= table.size(); ++n)
    if (is_list(document, first_of(table, n - 1)) && !exists(first_of(table, n)))
      add_element(first_of(table, n - 1), "{}", document);
  add_line(path, value, document);
}

void EditedText::add_line(const TomlPath& path, const std::string& value,
                          const ConfigValue& document) {
  const TomlPath table = above(path);
  std::optional<std::size_t> header, last, last_dotted, first_child;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const TomlPart& part = parts_[i];
    if (is_header(i) && part.path == table) header = i;
    if (part.kind == Kind::value && part.table == table) last = i;
    if (part.kind == Kind::value && part.table.size() < table.size() && lies_in(part.path, table))
      last_dotted = i;
    if (is_header(i) && !first_child && lies_in(part.path, table)) first_child = i;
  }
  const auto line = [&](const TomlPath& names, std::size_t from) {
    return dotted(names, from) + " = " + value + line_break_;
  };
  if (!last && !header) last = last_dotted;
  if (last) {
    const TomlPart& part = parts_[*last];
    const std::string indent = text_.substr(part.whole.begin, part.key.begin - part.whole.begin);
    return replace({part.whole.end, part.whole.end}, indent + line(path, part.table.size()));
  }
  const std::string own = line(path, path.size() - 1);
  if (header || table.empty()) {
    const std::size_t at = header           ? end_of_content(*header)
                           : parts_.empty() ? 0
                                            : parts_.front().whole.begin;
    return replace({at, at}, own);
  }
  const std::string block = fmt::format("[{}]{}", header_name(table, document), line_break_) + own;
  if (!first_child) return add_block(block, table, false);
  // The table is known from its children only: it comes before them.
  const std::size_t before = first_comment(*first_child);
  const bool compact = before > 0 && parts_[before - 1].kind != Kind::blank;
  const std::size_t at = parts_[before].whole.begin;
  replace({at, at}, block + (compact ? "" : line_break_));
}

// After the last block of the family: of the table around it, or of the file.
void EditedText::add_block(const std::string& lines, const TomlPath& family, bool compact) {
  std::size_t at = 0;
  for (TomlPath head = family; at == 0; head.pop_back()) {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const TomlPart& part = parts_[i];
      if (head.empty() ? part.kind != Kind::blank && part.kind != Kind::item
                       : (is_header(i) || part.kind == Kind::value) && lies_in(part.path, head))
        at = head.empty() ? part.whole.end : end_of_content(end_of_block(i));
    }
    if (head.empty()) break;
  }
  const auto next = std::find_if(parts_.begin(), parts_.end(), [&](const TomlPart& part) {
    return part.kind != Kind::item && part.whole.begin == at;
  });
  const bool spaced = !compact && at > 0 && (next == parts_.end() || next->kind == Kind::blank);
  replace({at, at}, (spaced ? line_break_ : "") + lines);
}

void EditedText::add_element(const TomlPath& list, const std::string& value,
                             const ConfigValue& document) {
  std::string lines = fmt::format("[[{}]]{}", header_name(list, document), line_break_);
  const std::string line = "v = " + value;
  for (const TomlPart& part : toml_layout(line))
    if (part.kind == Kind::item && part.holder == 0)
      lines += fmt::format("{} = {}{}", dotted(part.path, 1),
                           line.substr(part.value.begin, part.value.end - part.value.begin),
                           line_break_);
  // As close as the last two elements.
  bool compact = false;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (parts_[i].kind == Kind::element && above(parts_[i].path) == list &&
        parts_[i].path.back() != "0") {
      const std::size_t first = first_comment(i);
      compact = first > 0 && parts_[first - 1].kind != Kind::blank;
    }
  add_block(lines, list, compact);
}

// Into an array or an inline table.
void EditedText::add_item(const TomlPart& holder, const TomlPath& path, const std::string& value,
                          const ConfigValue& document) {
  const std::size_t depth = holder.path.size();
  const TextSpan span = holder.value;
  const bool array = text_[span.begin] == '[';
  const TomlPath member = first_of(path, depth + 1);
  std::string item = value;
  if (!array && exists(member))  // { a.b = 1 } gets a.c
    item = dotted(path, depth) + " = " + value;
  else if (path.size() > depth + 1)
    item = toml_text(*node_at(document, member));
  if (!array && !exists(member)) item = toml_key(member.back()) + " = " + item;

  const auto index = static_cast<std::size_t>(&holder - parts_.data());
  const TomlPart* last = nullptr;
  for (const TomlPart& part : parts_)
    if (part.kind == Kind::item && part.holder == index) last = &part;
  if (last == nullptr) {
    const std::size_t at = span.begin + 1;
    if (text_.find('#', at) < span.end) return replace({at, at}, " " + item + ",");
    return replace({at, span.end - 1}, array ? item : " " + item + " ");
  }
  const std::size_t end = last->whole.end;
  const std::size_t begin_of_line = text_.rfind('\n', last->whole.begin) + 1;
  const std::string indent = text_.substr(begin_of_line, last->whole.begin - begin_of_line);
  const bool own_line =
      begin_of_line > span.begin && indent.find_first_not_of(" \t") == std::string::npos;
  const std::size_t mark = text_.find_first_not_of(" \t\r\n", end);
  const bool has_comma = text_[mark] == ',';
  if (!own_line) return replace({end, end}, ", " + item);
  const std::size_t next_line = text_.find('\n', end) + 1;
  if (next_line >= span.end) return replace({end, end}, "," + line_break_ + indent + item);
  replace({next_line, next_line}, indent + item + (has_comma ? "," : "") + line_break_);
  if (!has_comma) replace({end, end}, ",");
}

// The first of the comment lines directly above a header. The heading of the file is none of them.
std::size_t EditedText::first_comment(std::size_t header) const {
  std::size_t first = header;
  while (first > 0 && parts_[first - 1].kind == Kind::comment) --first;
  return first == 0 ? header : first;
}

// The last line with a value, or the header, of the block around.
std::size_t EditedText::end_of_block(std::size_t index) const {
  std::size_t last = index;
  for (std::size_t i = index + 1; i < parts_.size() && !is_header(i); ++i)
    if (parts_[i].kind == Kind::value) last = i;
  return last;
}

// Behind a line and the comments directly below it, unless they belong to the next header.
std::size_t EditedText::end_of_content(std::size_t index) const {
  std::size_t next = index + 1;
  while (next < parts_.size() && parts_[next].kind == Kind::item) ++next;
  std::size_t end = parts_[index].whole.end;
  for (; next < parts_.size() && parts_[next].kind == Kind::comment; ++next)
    end = parts_[next].whole.end;
  return next < parts_.size() && is_header(next) ? parts_[index].whole.end : end;
}

namespace {

// Sections whose presence has a meaning stay when they are empty.
bool stays_empty(const TomlPath& path) {
  std::string name;
  for (const std::string& part : path)
    if (!std::all_of(part.begin(), part.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; }))
      name = join_key(name, part);
  const SceneSection* section = find_section(name);
  return section != nullptr && section->kind == SectionKind::optional;
}

}  // namespace

void EditedText::remove_item(std::size_t index) {
  const TomlPart item = parts_[index];
  const TextSpan holder = parts_[item.holder].value;
  const TomlPart* before = nullptr;
  const TomlPart* after = nullptr;
  for (const TomlPart& part : parts_) {
    if (part.kind != Kind::item || part.holder != item.holder) continue;
    if (part.whole.begin < item.whole.begin) before = &part;
    if (part.whole.begin > item.whole.begin && after == nullptr) after = &part;
  }
  const std::size_t mark = text_.find_first_not_of(" \t\r\n", item.whole.end);
  const bool has_comma = text_[mark] == ',';
  const std::size_t begin_of_line = text_.rfind('\n', item.whole.begin) + 1;
  const std::size_t behind = text_.find_first_not_of(" \t", has_comma ? mark + 1 : item.whole.end);
  const bool own_lines = begin_of_line > holder.begin &&
                         text_.find_first_not_of(" \t", begin_of_line) == item.whole.begin &&
                         (text_[behind] == '\r' || text_[behind] == '\n' || text_[behind] == '#');
  if (own_lines) {
    const TextSpan comma = before == nullptr || has_comma
                               ? TextSpan{}
                               : TextSpan{before->whole.end, before->whole.end + 1};
    replace({begin_of_line, text_.find('\n', behind) + 1}, "");
    // The element before is the last one now, and the last one had no comma.
    if (comma.end > 0 && text_[comma.begin] == ',') replace(comma, "");
  } else if (before != nullptr) {
    replace({before->whole.end, item.whole.end}, "");
  } else if (after != nullptr) {
    replace({item.whole.begin, after->whole.begin}, "");
  } else {
    replace({item.whole.begin, has_comma ? mark + 1 : item.whole.end}, "");
  }
}

void EditedText::remove(const TomlPath& path) {
  if (const TomlPart* part = written(path)) {
    if (part->kind == Kind::value) {
      const TomlPath table = part->table;
      replace(part->whole, "");
      return remove_vacant_header(table);
    }
    const TomlPart& around = parts_[part->holder];
    const TomlPath holder = around.path;
    const bool is_element = around.key.end == 0;
    remove_item(static_cast<std::size_t>(part - parts_.data()));
    const std::string rest = value_at(holder).value_or("");
    if (!is_element && !stays_empty(holder) &&
        rest.find_first_not_of(" \t\r\n", 1) == rest.size() - 1)
      remove(holder);
    return;
  }
  std::vector<std::size_t> found;  // what goes: blocks, and dotted keys in blocks that stay
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const TomlPart& part = parts_[i];
    if (lies_in(part.path, path) &&
        (is_header(i) || (part.kind == Kind::value && part.table.size() < path.size()) ||
         (part.kind == Kind::item && parts_[part.holder].path.size() < path.size())))
      found.push_back(i);
  }
  for (auto i = found.rbegin(); i != found.rend(); ++i) {
    if (is_header(*i))
      remove_block(*i);
    else if (parts_[*i].kind == Kind::value)
      replace(parts_[*i].whole, "");
    else
      remove_item(*i);
  }
  if (!found.empty()) remove_vacant_header(above(path));
}

// A header with its keys, and the comments above it.
void EditedText::remove_block(std::size_t header) {
  const TomlPath& path = parts_[header].path;
  std::size_t first = first_comment(header);
  if (parts_[header].kind == Kind::element && path.back() == "0") {
    // Above the first element of several may stand a comment on all of them.
    bool others = false;
    bool others_have_comments = false;
    for (std::size_t i = header + 1; i < parts_.size(); ++i)
      if (parts_[i].kind == Kind::element && above(parts_[i].path) == above(path)) {
        others = true;
        others_have_comments |= first_comment(i) < i;
      }
    if (others && !others_have_comments) first = header;
  }
  TextSpan span = {parts_[first].whole.begin, end_of_content(end_of_block(header))};
  // Removes one group of the blank lines around it.
  const auto blank_at = [&](std::size_t at) {
    return std::find_if(parts_.begin(), parts_.end(), [&](const TomlPart& part) {
      return part.kind == Kind::blank && part.whole.begin == at;
    });
  };
  const bool last = span.end == text_.size();
  const auto kind_before = first == 0 ? Kind::comment : parts_[first - 1].kind;
  if (kind_before == Kind::blank && (last || blank_at(span.end) != parts_.end())) {
    while (first > 0 && parts_[first - 1].kind == Kind::blank)
      span.begin = parts_[--first].whole.begin;
  } else if (kind_before == Kind::comment) {  // one that stays, above the next element
    for (auto next = blank_at(span.end); next != parts_.end(); next = blank_at(span.end))
      span.end = next->whole.end;
  }
  replace(span, "");
}

void EditedText::remove_vacant_header(const TomlPath& table) {
  if (table.empty() || stays_empty(table)) return;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].kind == Kind::value && parts_[i].table == table) return;
    if (!is_header(i) || parts_[i].path != table) continue;
    if (parts_[i].kind == Kind::element || parts_[i].has_comment || first_comment(i) < i) return;
    std::size_t next = i + 1;
    while (next < parts_.size() && !is_header(next)) ++next;
    const std::size_t end = next < parts_.size() ? first_comment(next) : next;
    for (std::size_t j = i + 1; j < end; ++j)
      if (parts_[j].kind != Kind::blank) return;
    remove_block(i);
    break;
  }
  remove_vacant_header(above(table));
}

}  // namespace belvedere
