#pragma once

#include <string>

namespace belvedere::tools {

// Held while a page has a file open, so that a second one is refused; the system drops it whatever
// ends the program.
class FileOwner {
 public:
  // page: what it is, for messages: "studio". Error(usage) where another page has the file open,
  // Error(input) where it cannot be read.
  FileOwner(const std::string& path, const std::string& page);
  ~FileOwner();
  FileOwner(const FileOwner&) = delete;
  FileOwner& operator=(const FileOwner&) = delete;
  // Saving puts another file in the place of the one that is held.
  void renew();

 private:
  std::string path_;
  std::string page_;
  int descriptor_;
};

}  // namespace belvedere::tools
