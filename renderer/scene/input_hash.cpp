#include "renderer/scene/input_hash.h"

#include <filesystem>
#include <map>
#include <mutex>

#include "base/error.h"
#include "renderer/image/provenance.h"
#include "terrain/io/http_access.h"

namespace belvedere {
namespace {

InputHash hash_address(const std::string& address) {
  static std::mutex mutex;
  static std::map<std::string, InputHash> known;
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(address); found != known.end()) return found->second;
  ContentHash hash;
  const std::uint64_t bytes =
      read_address(address, [&](std::string_view piece) { hash.add(piece); });
  return known[address] = {bytes, hash.digits()};
}

}  // namespace

InputHash hash_input(const std::string& path) {
  if (is_address(path)) return hash_address(path);
  InputHash out{.bytes = 0, .hash = hash_file(path)};
  std::error_code problem;
  out.bytes = std::filesystem::file_size(path, problem);
  if (problem) throw Error(ErrorKind::input, path, "the file has no size: " + problem.message());
  return out;
}

}  // namespace belvedere
