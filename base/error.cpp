#include "base/error.h"

#include <utility>

namespace belvedere {
namespace {

std::string make_message(const std::string& where, const std::string& found,
                         const std::string& allowed) {
  std::string message = where.empty() ? found : where + ": " + found;
  if (!allowed.empty()) message += "\n  allowed: " + allowed;
  return message;
}

}  // namespace

Error::Error(ErrorKind kind, std::string where, std::string found, std::string allowed)
    : std::runtime_error(make_message(where, found, allowed)),
      kind_(kind),
      where_(std::move(where)),
      found_(std::move(found)),
      allowed_(std::move(allowed)) {}

}  // namespace belvedere
