#pragma once

#include <string>

namespace belvedere {

// A file that appears whole or not at all: written under a temporary name in the same folder (`x.tif` as `x.tmp.tif`, because image
// libraries go by the ending), then renamed. Until commit() an older file of that name stays as it is; without it the temporary
// file is removed. Throws Error(output) with the system's reason.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }
  const std::string& temporary() const { return temporary_; }
  // Brings the temporary file to disk. Who writes several files that belong together prepares all before the first is renamed.
  void prepare();
  // prepare(), where that was not done, and the rename.
  void commit();
  // Throws Error(output) for a library's `reason`, and says so where the disk is full: most libraries do not.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::string path_;
  std::string temporary_;
  bool prepared_ = false;
  bool committed_ = false;
};

// Writes a text, whole or not at all. Error(output).
void write_text_file(const std::string& path, const std::string& text);

// Error(output) unless a file could be created in the folder (made where it is missing).
void check_output_folder(const std::string& folder);

}  // namespace belvedere
