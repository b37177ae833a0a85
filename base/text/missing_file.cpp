#include "base/text/missing_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <string_view>

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

std::string archive_kind(const std::string& path) {
  std::array<char, 264> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string_view head(bytes.data(), static_cast<std::size_t>(file.gcount()));
  using namespace std::string_view_literals;
  if (head.starts_with("PK\x03\x04"sv) || head.starts_with("PK\x05\x06"sv)) return "a zip archive";
  if (head.starts_with("\x1f\x8b"sv)) return "a gzip archive";
  if (head.starts_with("7z\xbc\xaf\x27\x1c"sv)) return "a 7-Zip archive";
  if (head.starts_with("Rar!\x1a\x07"sv)) return "a RAR archive";
  if (head.starts_with("BZh"sv)) return "a bzip2 archive";
  if (head.starts_with("\xfd"
                       "7zXZ"sv))
    return "an xz archive";
  constexpr std::size_t tar_mark = 257;
  if (head.size() > tar_mark && head.substr(tar_mark).starts_with("ustar"sv))
    return "a tar archive";
  return {};
}

}  // namespace belvedere
