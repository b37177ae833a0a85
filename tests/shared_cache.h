#pragma once

#include <string>

#include "base/cache/cache.h"

// A cache that the tests of one process share, so that each terrain, each map of classes and each example sheet is made once. It is empty
// when the process begins and gone when it ends. Tests of what is the same for any threads or tiles use it only where they are about what
// comes after these.
namespace belvedere::test {

const Cache& shared_cache();
const std::string& shared_cache_folder();

}  // namespace belvedere::test
