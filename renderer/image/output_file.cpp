#include "renderer/image/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/error.h"

namespace belvedere {
namespace {

[[noreturn]] void throw_system(const std::string& path, const std::string& what, int code) {
  throw Error(ErrorKind::output, path, what + ": " + std::generic_category().message(code));
}

// Flushes a file or folder to disk. Some file systems cannot do that for a folder, which is not an
// error.
void synchronize(const std::string& path, const std::string& named, bool folder) {
  const int file = ::open(path.c_str(), folder ? O_RDONLY | O_DIRECTORY : O_RDWR);
  if (file < 0) {
    if (folder) return;
    throw_system(named, "cannot be reopened", errno);
  }
  const int code = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (code != 0 && !folder) throw_system(named, "cannot be flushed to disk", code);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  std::filesystem::path name(path_);
  if (name.filename().empty())
    throw Error(ErrorKind::output, path_, "is a folder", "the name of a file");
  std::filesystem::path extension = name.extension();
  temporary_ = name.replace_extension().string() + ".tmp" + extension.string();
  // Checked at once: the reason is then known before an image library hides it.
  while (lock_ < 0) {
    const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) throw_system(path_, "cannot be created", errno);
    // Where a file system has no locks, two runs that write one file are not told apart.
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file);
      throw Error(ErrorKind::output, path_, "another run is writing this file",
                  "another name, or wait until it has ended");
    }
    // The run that held the lock before may have renamed or removed the file since.
    struct ::stat held {};
    struct ::stat named {};
    if (::fstat(file, &held) == 0 && ::stat(temporary_.c_str(), &named) == 0 &&
        held.st_ino == named.st_ino)
      lock_ = file;
    else
      ::close(file);
  }
  if (::ftruncate(lock_, 0) != 0) {
    const int code = errno;
    ::close(lock_);
    throw_system(path_, "cannot be created", code);
  }
}

OutputFile::~OutputFile() {
  if (!committed_) ::unlink(temporary_.c_str());
  ::close(lock_);
}

void OutputFile::prepare() {
  synchronize(temporary_, path_, false);
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored))
    throw_system(path_, "cannot be replaced", EISDIR);
  prepared_ = true;
}

void OutputFile::commit() {
  if (!prepared_) prepare();
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw_system(path_, "cannot be replaced", errno);
  committed_ = true;
  const std::string folder = std::filesystem::path(path_).parent_path().string();
  synchronize(folder.empty() ? "." : folder, path_, true);
}

void OutputFile::fail(const std::string& reason) const {
  std::string text = "cannot be written";
  std::error_code code;
  const std::filesystem::space_info space = std::filesystem::space(temporary_, code);
  if (!code && space.available < (std::uintmax_t{1} << 20)) text += ": the disk is full";
  if (!reason.empty())
    text += ": " + reason.substr(0, reason.find('\n'));  // some report the same once for each row
  throw Error(ErrorKind::output, path_, text);
}

void check_output_folder(const std::string& folder) {
  const std::string position = folder.empty() ? "." : folder;
  std::error_code code;
  std::filesystem::create_directories(position, code);
  if (code) throw_system(position, "cannot create this folder", code.value());
  std::string name = position + "/.belvedere-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) throw_system(position, "cannot create a file in this folder", errno);
  ::close(file);
  ::unlink(name.c_str());
}

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) file.fail("writing failed");
  file.commit();
}

}  // namespace belvedere
