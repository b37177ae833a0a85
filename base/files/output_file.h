#pragma once

#include <string>

namespace belvedere {

// A file that appears complete or not at all: written under a temporary name in the same folder
// that no file has (hidden, of the same extension, by which image libraries go), then renamed.
// Until commit() an older file of that name is unchanged; without it the temporary file is removed.
// A symbolic link is followed, an older file's mode and owner are kept; a read-only file, an input
// of the run and what file_guard() protects are refused. While it lives, another run that writes
// the same file is refused. Throws Error(output) with the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& temporary() const { return temporary_; }
  // Flushes the temporary file to disk. For several files that belong together, all are prepared
  // before the first is renamed.
  void prepare();
  // prepare(), if not done yet, and the rename.
  void commit();
  // Throws Error(output) for a library's `reason`, and reports a full disk, which most libraries do
  // not.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  void lock();
  void unlock();

  std::string path_;       // as named, for messages
  std::string target_;     // where its links lead
  std::string folder_;     // of the target
  std::string temporary_;  // beside the target
  std::string lock_path_;  // holds the name of the temporary file
  int lock_ = -1;
  bool prepared_ = false;
  bool committed_ = false;
};

// Writes a text, complete or not at all. Error(output).
void write_text_file(const std::string& path, const std::string& text);

// A temporary folder of the run in the system's usual location ($TMPDIR), removed with the object.
class ScratchFolder {
 public:
  // Error(output) where it cannot be created.
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace belvedere
