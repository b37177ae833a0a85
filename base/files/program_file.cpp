#include "base/files/program_file.h"

#include <utility>

namespace belvedere {
namespace {

std::string& named_program() {
  static std::string path = "/proc/self/exe";
  return path;
}

}  // namespace

std::string program_file() { return named_program(); }

void set_program_file(std::string path) { named_program() = std::move(path); }

}  // namespace belvedere
