#include "base/files/file_guard.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "base/cache/content_hash.h"
#include "base/error.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = ".belvedere_results";

// Device and number of a file, else its canonical path. The same for all names of one file: other
// spellings, links, other case where the file system does not tell them apart.
std::string identity_of(const std::string& path) {
  struct ::stat found {};
  if (::stat(path.c_str(), &found) == 0) return fmt::format("{}:{}", found.st_dev, found.st_ino);
  std::error_code ignored;
  const fs::path target(link_target(path));
  return (fs::weakly_canonical(fs::absolute(target, ignored).parent_path(), ignored) /
          target.filename())
      .string();
}

// The files that GDAL and OGR read beside a file.
std::vector<std::string> companions_of(const std::string& path) {
  std::vector<std::string> out;
  for (const char* more : {".aux.xml", ".ovr", ".msk", "-wal", "-shm"}) out.push_back(path + more);
  const auto add = [&](std::initializer_list<const char*> extensions) {
    for (const char* extension : extensions)
      out.push_back(fs::path(path).replace_extension(extension).string());
  };
  add({".prj", ".qpj", ".cpg", ".hdr", ".tfw", ".tifw", ".wld", ".pgw", ".jgw", ".gfs", ".rrd"});
  if (path.ends_with(".shp") || path.ends_with(".dbf"))
    add({".shp", ".shx", ".dbf", ".sbn", ".sbx", ".qix"});
  return out;
}

// One line of a record.
struct Written {
  int run = 0;
  std::string hash;
  std::uintmax_t bytes = 0;
  std::string name;  // relative to the folder
};

std::vector<Written> read_record(const fs::path& folder) {
  std::vector<Written> out;
  std::ifstream file(folder / record_name);
  int run = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    Written one;
    words >> one.hash;
    if (one.hash == "run") ++run;
    one.run = run;
    if (words >> one.bytes && words.get() == ' ' && std::getline(words, one.name) &&
        !one.name.empty())
      out.push_back(one);
  }
  return out;
}

std::string to_line(const Written& one) {
  return fmt::format("{} {} {}\n", one.hash, one.bytes, one.name);
}

// Whether a file is as the program wrote it, in any of its runs: a run that was killed may have
// recorded a file that it did not rename.
bool is_own(const fs::path& folder, const std::string& name, const std::vector<Written>& record) {
  const std::string path = (folder / name).string();
  std::error_code code;
  const std::uintmax_t bytes = fs::file_size(path, code);
  if (code) return false;
  std::string hash;
  return std::any_of(record.begin(), record.end(), [&](const Written& one) {
    if (one.name != name || one.bytes != bytes) return false;
    if (hash.empty()) hash = hash_file(path);
    return one.hash == hash;
  });
}

void require_own(const fs::path& folder, const std::string& name,
                 const std::vector<Written>& record) {
  const fs::path path = folder / name;
  std::error_code ignored;
  if (!fs::exists(path, ignored) || is_own(folder, name, record)) return;
  const bool known = std::any_of(record.begin(), record.end(),
                                 [&](const Written& one) { return one.name == name; });
  throw Error(ErrorKind::output, path.string(),
              known ? "was changed since the program wrote it" : "was not written by this program",
              "another folder, or --force to replace it");
}

// Files that pages are made of: the others are never replaced.
std::vector<std::string> pages_in(const fs::path& folder) {
  constexpr std::array<std::string_view, 13> kinds = {".html", ".htm",     ".json", ".js",  ".css",
                                                      ".png",  ".jpg",     ".tif",  ".exr", ".svg",
                                                      ".csv",  ".geojson", ".toml"};
  std::vector<std::string> out;
  std::error_code ignored;
  for (auto at = fs::recursive_directory_iterator(
           folder, fs::directory_options::skip_permission_denied, ignored);
       at != fs::recursive_directory_iterator(); at.increment(ignored)) {
    const fs::path& path = at->path();
    if (path.filename().string().starts_with('.')) {
      if (at->is_directory(ignored)) at.disable_recursion_pending();
      continue;
    }
    if (at->is_regular_file(ignored) &&
        std::find(kinds.begin(), kinds.end(), path.extension().string()) != kinds.end())
      out.push_back(path.lexically_relative(folder).string());
  }
  std::sort(out.begin(), out.end());
  return out;
}

// The record without what is gone and, of each name, what is outdated; with a line for a new run.
void begin_run(const fs::path& folder, const std::vector<Written>& record) {
  std::string text;
  int run = 0;
  for (auto one = record.begin(); one != record.end(); ++one) {
    std::error_code ignored;
    const bool again = std::any_of(std::next(one), record.end(),
                                   [&](const Written& later) { return later.name == one->name; });
    if ((again && !is_own(folder, one->name, {*one})) || !fs::exists(folder / one->name, ignored))
      continue;
    if (one->run != run) text += "run\n";
    run = one->run;
    text += to_line(*one);
  }
  std::ofstream(folder / record_name, std::ios::binary) << text << "run\n";
}

}  // namespace

void check_output_folder(const std::string& folder) {
  const std::string path = folder.empty() ? "." : folder;
  std::error_code code;
  fs::create_directories(path, code);
  if (code) throw Error(ErrorKind::output, path, "cannot create this folder: " + code.message());
  std::string name = path + "/.belvedere-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0)
    throw Error(ErrorKind::output, path,
                "cannot create a file in this folder: " + std::generic_category().message(errno));
  ::close(file);
  ::unlink(name.c_str());
}

std::string link_target(const std::string& path) {
  constexpr int longest_chain = 40;  // as the system's
  fs::path at(path);
  std::error_code code;
  for (int i = 0; i < longest_chain && fs::is_symlink(at, code); ++i) {
    const fs::path next = fs::read_symlink(at, code);
    if (code) break;
    at = next.is_absolute() ? next : at.parent_path() / next;
  }
  return at.string();
}

void FileGuard::reads(const std::string& path, const std::string& named) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return;
  const std::lock_guard hold(mutex_);
  std::vector<std::string> files = companions_of(path);
  files.insert(files.begin(), path);
  for (const std::string& file : files) {
    if (!fs::is_regular_file(file, ignored)) continue;
    const std::string identity = identity_of(file);
    read_.insert_or_assign(identity, Named{file, named});
    for (const auto& [path_of_result, option] : written_)
      if (identity_of(path_of_result) == identity)
        throw Error(ErrorKind::usage, option,
                    fmt::format("{} is also an input ({})", path_of_result, named),
                    "another file name");
  }
}

std::string FileGuard::input_of(const std::string& identity) const {
  const auto found = read_.find(identity);
  // Numbers of files that are gone are given to others.
  if (found == read_.end() || identity_of(found->second.path) != identity) return {};
  return found->second.named;
}

void FileGuard::writes(const std::string& path, const std::string& named) {
  const std::string identity = identity_of(path);
  {
    const std::lock_guard hold(mutex_);
    if (const std::string input = input_of(identity); !input.empty())
      throw Error(ErrorKind::usage, named, fmt::format("{} is also an input ({})", path, input),
                  "another file name");
    for (const auto& [other, option] : written_)
      if (option != named && identity_of(other) == identity)
        throw Error(ErrorKind::usage, named,
                    fmt::format("{} is also the result of {}", path, option), "another file name");
    written_.emplace(path, named);
  }
  require_replaceable(path);
  if (std::error_code ignored; fs::is_directory(path, ignored))
    throw Error(ErrorKind::output, path, "is a folder", "the name of a file");
  make_folder(fs::path(path).parent_path());
}

void FileGuard::make_folder(const fs::path& folder) {
  std::error_code ignored;
  for (fs::path at = folder; !at.empty() && !fs::exists(at, ignored); at = at.parent_path())
    made_.push_back(at.string());
  check_output_folder(folder.string());
}

void FileGuard::writes_into(const std::string& folder, const std::string& named, bool replace,
                            const std::optional<std::vector<std::string>>& names) {
  const fs::path place(folder.empty() ? "." : folder);
  make_folder(place);
  const std::vector<Written> record = read_record(place);
  for (const std::string& name : names ? *names : pages_in(place)) {
    if (!replace) require_own(place, name, record);
    if (names) writes((place / name).string(), named);
  }
  const std::lock_guard hold(mutex_);
  folders_[fs::canonical(place).string()] = {.replace = replace};
}

FileGuard::Folders::const_iterator FileGuard::folder_of(const fs::path& target) const {
  if (folders_.empty()) return folders_.end();
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(fs::absolute(target), ignored);
  for (fs::path at = canonical.parent_path(); at != at.parent_path(); at = at.parent_path())
    if (const auto found = folders_.find(at.string()); found != folders_.end()) return found;
  return folders_.end();
}

void FileGuard::require_replaceable(const std::string& path) const {
  struct ::stat found {};
  if (::stat(path.c_str(), &found) != 0) return;
  if (S_ISDIR(found.st_mode)) return;  // refused with the system's words
  if (!S_ISREG(found.st_mode))
    throw Error(ErrorKind::output, path, "is a device or pipe", "the name of a file");
  // Also for root, who may write everything: who made it read-only wants it as it is.
  if ((found.st_mode & 0222U) == 0 || ::access(path.c_str(), W_OK) != 0)
    throw Error(ErrorKind::output, path, "is read-only",
                "another name, or chmod u+w to allow its replacement");
  const std::lock_guard hold(mutex_);
  if (const std::string input = input_of(identity_of(path)); !input.empty())
    throw Error(ErrorKind::usage, path, fmt::format("is also an input ({})", input),
                "another file name");
  if (std::any_of(written_.begin(), written_.end(), [&](const auto& result) {
        return identity_of(result.first) == identity_of(path);
      }))
    return;  // seen before the work
  const fs::path target = fs::weakly_canonical(path);
  if (const auto folder = folder_of(target); folder != folders_.end() && !folder->second.replace)
    require_own(folder->first, target.lexically_relative(folder->first).string(),
                read_record(folder->first));
}

void FileGuard::record(const std::string& target, const std::string& temporary) {
  const std::lock_guard hold(mutex_);
  const auto found = folder_of(target);
  if (found == folders_.end()) return;
  const auto folder = folders_.find(found->first);
  // Only now: a run without results leaves nothing.
  if (!folder->second.begun) begin_run(folder->first, read_record(folder->first));
  folder->second.begun = true;
  const Written one{
      .hash = hash_file(temporary),
      .bytes = fs::file_size(temporary),
      .name = fs::weakly_canonical(target).lexically_relative(folder->first).string()};
  std::ofstream(fs::path(folder->first) / record_name, std::ios::binary | std::ios::app)
      << to_line(one);
}

void FileGuard::remove_own(const std::string& folder) const {
  const fs::path canonical = fs::weakly_canonical(folder);
  const std::lock_guard hold(mutex_);
  const auto place = folder_of(canonical / "file");
  if (place == folders_.end()) return;
  const std::vector<Written> record = read_record(place->first);
  for (const Written& one : record) {
    const fs::path path = fs::path(place->first) / one.name;
    std::error_code ignored;
    const bool writable =
        (fs::status(path, ignored).permissions() & fs::perms(0222)) != fs::perms::none;
    if (writable && path.string().starts_with(canonical.string() + "/") &&
        is_own(place->first, one.name, {one}))
      fs::remove(path, ignored);
  }
}

void FileGuard::clear() {
  const std::lock_guard hold(mutex_);
  read_.clear();
  written_.clear();
  folders_.clear();
  made_.clear();
}

void FileGuard::remove_empty_folders() {
  const std::lock_guard hold(mutex_);
  std::error_code ignored;
  for (const std::string& folder : made_) fs::remove(folder, ignored);  // not if it holds anything
  made_.clear();
}

FileGuard& file_guard() {
  static FileGuard guard;
  return guard;
}

std::vector<std::string> newest_results(const std::string& folder,
                                        const std::vector<std::string>& names) {
  std::vector<std::string> there;
  for (const std::string& name : names)
    if (fs::exists(fs::path(folder) / name)) there.push_back(name);
  const auto listed = [&](const Written& one) {
    return std::find(there.begin(), there.end(), one.name) != there.end();
  };
  int newest = -1;
  const std::vector<Written> record = read_record(folder);
  for (const Written& one : record)
    if (listed(one)) newest = std::max(newest, one.run);
  if (newest >= 0)
    std::erase_if(there, [&](const std::string& name) {
      return std::none_of(record.begin(), record.end(), [&](const Written& one) {
        return one.name == name && one.run == newest;
      });
    });
  return there;
}

}  // namespace belvedere
