#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace belvedere {

// Protects files that a run must not replace: its inputs, read-only files, and files in folders of
// results that the program did not write or that were changed since. Commands declare what they
// read and write before their work; OutputFile asks again for every file. One per process,
// thread-safe.
//
// A folder of results keeps a record of what was written there, `.belvedere_results`: a line "run"
// for each run and one for each file, with hash, bytes and name.
class FileGuard {
 public:
  // A file that the run reads, and its companions (`.prj`, `.aux.xml`, `.dbf`, …). `named`: by
  // which option or key. Files that do not exist are ignored.
  void reads(const std::string& path, const std::string& named);
  // A file that the run will write. Error(usage) where it is also read or named twice, by whatever
  // path; Error(output) where it is read-only or no file.
  void writes(const std::string& path, const std::string& named);
  // A folder of results; created if missing. Error(output) where
  // `names` (all pages and pictures of the folder, if none are given) has a file that the program
  // did not write or that was changed since, unless `replace`.
  void writes_into(const std::string& folder, const std::string& named, bool replace,
                   const std::optional<std::vector<std::string>>& names = {});

  // For OutputFile: the refusals above, for one file.
  void require_replaceable(const std::string& path) const;
  // For OutputFile: adds the finished file to the record of its folder, before it is renamed.
  void record(const std::string& target, const std::string& temporary);
  // Removes the files of a folder that the program wrote and nobody changed.
  void remove_own(const std::string& folder) const;
  // Removes the empty ones of the folders that were made before the work; for runs that failed.
  void remove_empty_folders();
  // Forgets everything, for the next run in one process.
  void clear();

 private:
  struct Named {
    std::string path;
    std::string named;
  };
  struct Folder {
    bool replace = false;  // also files of others
    bool begun = false;    // its record has this run
  };
  using Folders = std::map<std::string, Folder>;  // by canonical path
  // The folder of results that a file is in or below; end() if none.
  Folders::const_iterator folder_of(const std::filesystem::path& target) const;

  void make_folder(const std::filesystem::path& folder);
  // By which option or key a file is read; empty if it is not.
  std::string input_of(const std::string& identity) const;

  mutable std::mutex mutex_;
  std::map<std::string, Named> read_;           // by identity
  std::map<std::string, std::string> written_;  // path, option
  Folders folders_;
  std::vector<std::string> made_;  // folders, the innermost first
};

FileGuard& file_guard();

// Error(output) unless a file can be created in the folder (which is created if missing).
void check_output_folder(const std::string& folder);
// Where the symbolic links of a path's last name lead, also to a file that does not exist yet.
std::string link_target(const std::string& path);

// The files of `names` in a folder that its newest run wrote; without a record, all that exist.
std::vector<std::string> newest_results(const std::string& folder,
                                        const std::vector<std::string>& names);

}  // namespace belvedere
