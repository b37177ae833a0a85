#pragma once

#include <string>

namespace belvedere {

// A file that appears complete or not at all: written under a temporary name in the same folder
// (`x.tif` as `x.tmp.tif`, because image libraries go by the extension), then renamed. Until
// commit() an older file of that name is unchanged; without it the temporary file is removed.
// While it lives, another run that writes the same file is refused. Throws Error(output) with the
// system's reason.
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
  std::string path_;
  std::string temporary_;
  int lock_ = -1;  // the temporary file, locked
  bool prepared_ = false;
  bool committed_ = false;
};

// Writes a text, complete or not at all. Error(output).
void write_text_file(const std::string& path, const std::string& text);

// Error(output) unless a file can be created in the folder (which is created if missing).
void check_output_folder(const std::string& folder);

}  // namespace belvedere
