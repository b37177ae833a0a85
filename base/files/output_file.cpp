#include "base/files/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <system_error>
#include <utility>

#include "base/cache/content_hash.h"
#include "base/error.h"
#include "base/files/file_guard.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

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

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

// An empty file of a name that no file had.
std::string create_temporary(const std::string& stem, const std::string& extension,
                             const std::string& named) {
  std::random_device random;
  for (;;) {
    std::string name = fmt::format("{}-{:08x}.tmp{}", stem, random(), extension);
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0 && errno == EEXIST) continue;
    if (file < 0) throw_system(named, "cannot be created", errno);
    ::close(file);
    return name;
  }
}

// Mode and owner of an older file, as far as the system allows.
void take_over_mode(const std::string& from, const std::string& to) {
  struct ::stat old {};
  if (::stat(from.c_str(), &old) != 0 || !S_ISREG(old.st_mode)) return;
  [[maybe_unused]] const bool owned =
      ::chown(to.c_str(), old.st_uid, old.st_gid) == 0 ||
      ::chown(to.c_str(), static_cast<::uid_t>(-1), old.st_gid) == 0;
  ::chmod(to.c_str(), old.st_mode & 07777U);
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  if (fs::path(path_).filename().empty())
    throw Error(ErrorKind::output, path_, "is a folder", "the name of a file");
  target_ = link_target(path_);
  file_guard().require_replaceable(path_);
  lock();
  try {
    // Checked at once: the reason is then known before an image library hides it.
    temporary_ = create_temporary(lock_path_.substr(0, lock_path_.rfind('.')),
                                  fs::path(target_).extension().string(), path_);
    take_over_mode(target_, temporary_);
    const std::string name = fs::path(temporary_).filename().string();
    if (::ftruncate(lock_, 0) != 0 ||
        ::pwrite(lock_, name.data(), name.size(), 0) != static_cast<::ssize_t>(name.size()))
      throw_system(path_, "cannot be created", errno);
  } catch (...) {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    unlock();
    throw;
  }
}

// A file beside the target, named by a hash of its name; it holds the name of the temporary file,
// so that what a killed run left is removed by the next one. Where a file system has no locks, two
// runs that write one file are not told apart.
void OutputFile::lock() {
  folder_ = folder_of(target_).string();
  const fs::path folder = folder_;
  const std::string stem =
      ".belvedere-" + hash_bytes(fs::path(target_).filename().string()).substr(0, 12);
  lock_path_ = (folder / (stem + ".lock")).string();
  while (lock_ < 0) {
    const int file = ::open(lock_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) throw_system(path_, "cannot be created", errno);
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(file);
      throw Error(ErrorKind::output, path_, "another run is writing this file",
                  "another name, or wait until it has ended");
    }
    // The run that held the lock before may have removed the file since.
    struct ::stat held {};
    struct ::stat named {};
    if (::fstat(file, &held) == 0 && ::stat(lock_path_.c_str(), &named) == 0 &&
        held.st_ino == named.st_ino)
      lock_ = file;
    else
      ::close(file);
  }
  std::ifstream old(lock_path_, std::ios::binary);
  const std::string left{std::istreambuf_iterator<char>(old), {}};
  if (left.starts_with(stem + "-") && left.find('/') == std::string::npos)
    ::unlink((folder / left).c_str());
}

void OutputFile::unlock() {
  if (lock_ < 0) return;
  ::unlink(lock_path_.c_str());
  ::close(lock_);
  lock_ = -1;
}

OutputFile::~OutputFile() {
  if (!committed_) ::unlink(temporary_.c_str());
  unlock();
}

void OutputFile::prepare() {
  synchronize(temporary_, path_, false);
  std::error_code ignored;
  if (fs::is_directory(target_, ignored)) throw_system(path_, "cannot be replaced", EISDIR);
  // Again: some libraries delete the file and create it in their own way.
  take_over_mode(target_, temporary_);
  file_guard().record(target_, temporary_);
  prepared_ = true;
}

// Takes no memory once it is prepared: of several files, none is left behind for want of it.
void OutputFile::commit() {
  if (!prepared_) prepare();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0)
    throw_system(path_, "cannot be replaced", errno);
  committed_ = true;
  unlock();
  synchronize(folder_, path_, true);
}

void OutputFile::fail(const std::string& reason) const {
  std::string text = "cannot be written";
  std::error_code code;
  const fs::space_info space = fs::space(temporary_, code);
  if (!code && space.available < (std::uintmax_t{1} << 20)) text += ": the disk is full";
  if (!reason.empty())
    text += ": " + reason.substr(0, reason.find('\n'));  // some report the same once for each row
  throw Error(ErrorKind::output, path_, text);
}

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) file.fail("writing failed");
  file.commit();
}

ScratchFolder::ScratchFolder() {
  std::error_code problem;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(problem);
  if (problem)
    throw Error(ErrorKind::output, "TMPDIR", "no folder for temporary files: " + problem.message());
  path_ = (folder / "belvedere-XXXXXX").string();
  if (::mkdtemp(path_.data()) == nullptr)
    throw Error(ErrorKind::output, folder.string(),
                "cannot create a folder in it: " + std::generic_category().message(errno),
                "another folder, named by the variable TMPDIR");
}

ScratchFolder::~ScratchFolder() {
  try {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  } catch (const std::bad_alloc&) {  // a folder stays
  }
}

}  // namespace belvedere
