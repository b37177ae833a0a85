#include "base/text/archive_kind.h"

#include <array>
#include <fstream>
#include <string_view>

namespace belvedere {

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
