#include "base/text/missing_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/text/text_encoding.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// The entry of a folder that has nearly that name, the one with its case before others; empty if
// there is none.
std::string similar_entry(const fs::path& folder, const std::string& name) {
  constexpr int max_entries = 100000;
  const std::string folded = folded_letters(name);
  if (folded.empty()) return {};
  std::set<std::string> similar;  // in a certain order: that of a folder is not the same everywhere
  std::error_code problem;
  int read = 0;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, problem), end;
       !problem && at != end && ++read <= max_entries; at.increment(problem)) {
    std::string entry = at->path().filename().string();
    if (folded_letters(entry) == folded) similar.insert(std::move(entry));
  }
  const auto same = std::find_if(similar.begin(), similar.end(), [&](const std::string& entry) {
    return same_letters(entry, name);
  });
  if (same != similar.end()) return *same;
  return similar.empty() ? std::string() : *similar.begin();
}

}  // namespace

std::string similar_path(const std::string& path) {
  std::error_code ignored;
  fs::path at;
  for (const fs::path& part : fs::path(path)) {
    fs::path next = at / part;
    if (!fs::exists(next, ignored)) {
      const std::string entry = similar_entry(at, part.string());
      if (entry.empty()) return {};
      next = at / entry;
    }
    at = std::move(next);
  }
  return at == path ? std::string() : at.string();
}

std::string similar_path_hint(const std::string& path) {
  const std::string near = similar_path(path);
  if (near.empty()) return {};
  if (!same_letters(near, path))
    return fmt::format("; there is \"{}\": upper and lower case differ", near);
  return fmt::format(
      "; there is a file whose name looks the same, but {}: rename the file (convmv -f utf8 -t "
      "utf8 {} --notest FILE), or copy its name as the folder lists it",
      is_composed(path)   ? "its letters with accents are two characters each (decomposed, NFD)"
      : is_composed(near) ? "its letters with accents are one character each (composed, NFC)"
                          : "its letters with accents are stored in another form",
      is_composed(path) ? "--nfc" : "--nfd");
}

Error missing_file(const std::string& path, const std::string& allowed, const std::string& found) {
  return {ErrorKind::input, path, found + similar_path_hint(path), allowed};
}

void require_file(const std::string& path, const std::string& allowed) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) throw missing_file(path, allowed);
  if (fs::is_directory(path, ignored)) throw Error(ErrorKind::input, path, "is a folder", allowed);
}

}  // namespace belvedere
