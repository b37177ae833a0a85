#pragma once

#include <string>

#include "base/cache/cache.h"

// A cache that all tests of one process share, so that each terrain, land cover and example sheet
// is made only once. It is empty when the process starts and is deleted when it ends. A test that
// compares runs (threads, tiles, locales, instruction sets) must not use it for both of them: the
// second run would only read what the first one made.
namespace belvedere::test {

const Cache& shared_cache();
const std::string& shared_cache_folder();

}  // namespace belvedere::test
