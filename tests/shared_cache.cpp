#include "tests/shared_cache.h"

#include "tests/files.h"

namespace belvedere::test {

const std::string& shared_cache_folder() {
  static const Folder folder("shared-cache");
  static const std::string path = folder.path();
  return path;
}

const Cache& shared_cache() {
  static const Cache cache({.folder = shared_cache_folder(), .limit_bytes = 0});
  return cache;
}

}  // namespace belvedere::test
