#include <algorithm>
#include <cctype>

#include "renderer/scene/edit/edited_text.h"
#include "renderer/scene/scene_schema.h"

// What goes from a text, with its commas, comments and blank lines.
namespace belvedere {
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
  // Of the blank lines before and after, one group goes with it.
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
