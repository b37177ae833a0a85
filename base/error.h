#pragma once

#include <stdexcept>
#include <string>

namespace belvedere {

// What kind of thing went wrong. The value is the exit status of the program.
enum class ErrorKind : int {
  usage = 2,         // command line or scene file
  input = 3,         // input data: missing, damaged, not allowed
  output = 4,        // a result could not be written
  limit = 5,         // over a limit: memory, image size, instruction set
  bug = 70,          // a broken promise inside the program
  interrupted = 75,  // stopped by the user; can be resumed
};

// The one error type of the library. Only a program's main catches it; the library never prints or exits.
class Error : public std::runtime_error {
 public:
  // where: a file, `file:line:column` or scene key; found: what is there; allowed: what would be accepted (may be empty).
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
