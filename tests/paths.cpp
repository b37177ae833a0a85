#include "tests/paths.h"

#include <cstdlib>

namespace belvedere::test {

// The only file that knows absolute paths, so that all others compile to the same objects in any
// checkout.
std::string source_folder() { return BELVEDERE_SOURCE_DIR; }
std::string build_folder() { return BELVEDERE_BINARY_DIR; }

std::string data_folder() {
  const char* named = std::getenv("BELVEDERE_DATA");
  return named != nullptr ? named : source_folder() + "/../shared/data";
}

}  // namespace belvedere::test
