#pragma once

#include <string>

namespace belvedere {

// The file that holds the code of the library: the running program, or the module that a host such
// as Python loaded. Its folder has the fonts of an installation, its bytes tell one build from
// another in the cache.
std::string program_file();
// For modules, before anything else is called.
void set_program_file(std::string path);

}  // namespace belvedere
