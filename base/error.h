#pragma once

#include <stdexcept>
#include <string>

namespace belvedere {

// Kind of error. The value is the exit status of the program.
enum class ErrorKind : int {
  usage = 2,         // command line or scene file
  input = 3,         // input data: missing, damaged, not allowed
  output = 4,        // a result could not be written
  limit = 5,         // over a limit: memory, image size, instruction set
  bug = 70,          // a violated invariant inside the program
  interrupted = 75,  // stopped by the user; can be resumed
};

// The only error type of the library. Only a program's main catches it; the library never prints or
// exits.
class Error : public std::runtime_error {
 public:
  // where: a file, `file:line:column`, scene key or option; found: what is wrong there; allowed:
  // what is accepted or what to do (may be empty). what() is "where: found", then on a second line
  // "allowed: …".
  Error(ErrorKind kind, std::string where, std::string found, std::string allowed = {});

  ErrorKind kind() const { return kind_; }
  int exit_status() const { return static_cast<int>(kind_); }
  const std::string& where() const { return where_; }
  const std::string& found() const { return found_; }
  const std::string& allowed() const { return allowed_; }

 private:
  ErrorKind kind_;
  std::string where_;
  std::string found_;
  std::string allowed_;
};

}  // namespace belvedere
