#include "tools/studio/file_owner.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

#include "base/error.h"

namespace belvedere::tools {

FileOwner::FileOwner(const std::string& path, const std::string& page)
    : path_(path), page_(page), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw Error(ErrorKind::input, path, "cannot be read", "a file that you may read");
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  close(descriptor_);
  throw Error(ErrorKind::usage, path, "is open in another " + page,
              "close that one, or work on a copy of the file");
}

FileOwner::~FileOwner() { close(descriptor_); }

void FileOwner::renew() {
  struct stat held {};
  struct stat there {};
  if (fstat(descriptor_, &held) == 0 && stat(path_.c_str(), &there) == 0 &&
      held.st_dev == there.st_dev && held.st_ino == there.st_ino)
    return;
  FileOwner next(path_, page_);
  std::swap(descriptor_, next.descriptor_);
}

}  // namespace belvedere::tools
