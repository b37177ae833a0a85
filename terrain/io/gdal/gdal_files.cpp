#include "terrain/io/gdal/gdal_files.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/memory_limit.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

// GDAL's block cache, which by default is a twentieth of the machine's memory. A row of 256² blocks
// over 40000 columns is 40 MB.
std::uint64_t block_cache_bytes() {
  constexpr std::uint64_t fewest = std::uint64_t{16} << 20;
  constexpr std::uint64_t max = std::uint64_t{1} << 30;
  return std::clamp(memory_budget_bytes() / 16, fewest, max);
}

void limit_block_cache() {
  // A limit set for GDAL itself is respected.
  if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) != nullptr) return;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto bytes = static_cast<GIntBig>(block_cache_bytes());
  if (GDALGetCacheMax64() != bytes) GDALSetCacheMax64(bytes);
}

// Words of GDAL's warnings where it goes on without a part of the data.
constexpr std::string_view loss_words[] = {"premature end", "truncated file",   "corrupt",
                                           "wal-enabled",   "ignoring feature", "feature skipped",
                                           "next feature",  "incomplete",       "geometry may be"};

std::string first_bytes_of(const fs::path& file, std::size_t count) {
  std::string bytes(count, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

// sqlite.org/fileformat2.html, 1.3: the magic string, then from byte 18 the versions of the format
// for writing and reading, 2 in WAL mode.
constexpr std::size_t database_header = 20;
bool is_database(std::string_view header) {
  return header.size() == database_header &&
         header.starts_with(std::string_view("SQLite format 3\0", 16));
}

// As it is now: whether a program changes it while it is copied.
using FileState = std::pair<std::uintmax_t, fs::file_time_type>;
FileState state_of(const fs::path& file) {
  std::error_code ignored;
  const std::uintmax_t bytes = fs::file_size(file, ignored);
  return {bytes, fs::last_write_time(file, ignored)};
}

// A copy of a database, with its changes, in a folder of its own.
std::shared_ptr<const ScratchFolder> copy_database(const std::string& path,
                                                   const std::vector<std::string>& changes) {
  auto folder = std::make_shared<const ScratchFolder>();
  const fs::path file = fs::canonical(path);
  const std::string copy = (fs::path(folder->path()) / fs::path(path).filename()).string();
  std::vector<std::pair<fs::path, std::string>> all = {{file, copy}};
  for (const std::string& change : changes)
    all.emplace_back(change, copy + change.substr(file.string().size()));
  std::error_code ignored;
  if (fs::exists(path + ".aux.xml", ignored))
    all.emplace_back(path + ".aux.xml", copy + ".aux.xml");
  std::vector<FileState> before;
  for (const auto& [from, to] : all) before.push_back(state_of(from));
  for (const auto& [from, to] : all) {
    std::error_code fault;
    fs::copy_file(from, to, fault);
    if (fault)
      throw Error(ErrorKind::input, path,
                  fmt::format("is read from a copy with its -wal or -journal; {} cannot be copied "
                              "to {}: {}",
                              from.filename().string(), folder->path(), fault.message()),
                  "permission to read it, and a folder with enough space, named by the variable "
                  "TMPDIR");
    fs::permissions(to, fs::perms::owner_read | fs::perms::owner_write, fault);
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    if (state_of(all[i].first) != before[i])
      throw Error(ErrorKind::input, path, "is being changed by another program",
                  "the file closed there, or a copy saved by that program");
  return folder;
}

}  // namespace

bool GdalErrors::is_loss(const char* warning) {
  const std::string text = CPLString(warning).tolower();
  return std::any_of(std::begin(loss_words), std::end(loss_words),
                     [&](std::string_view words) { return text.find(words) != std::string::npos; });
}

void register_gdal() {
  static std::once_flag registered;
  std::call_once(registered, [] {
    GDALAllRegister();
    // GDAL puts large indices (of OpenStreetMap files) into the current folder otherwise.
    std::error_code problem;
    const fs::path folder = fs::temp_directory_path(problem);
    if (!problem && CPLGetConfigOption("CPL_TMPDIR", nullptr) == nullptr)
      CPLSetConfigOption("CPL_TMPDIR", folder.c_str());
  });
  limit_block_cache();
}

std::vector<std::string> database_changes(const std::string& path) {
  std::vector<std::string> changes;
  std::error_code fault;
  const fs::path file = fs::canonical(path, fault);
  if (fault || !is_database(first_bytes_of(file, database_header))) return changes;
  for (const std::string_view ending : {"-wal", "-journal"}) {
    const std::string change = file.string() + std::string(ending);
    std::error_code none;
    const std::uintmax_t bytes = fs::file_size(change, none);
    if (none || bytes == 0) continue;
    // A journal that was finished has a header of zeros. One that cannot be read is a change.
    const std::string head = first_bytes_of(change, 1);
    if (ending == "-wal" || head != std::string_view("\0", 1)) changes.push_back(change);
  }
  return changes;
}

bool is_database_in_use(const std::string& path) {
  const std::string header = first_bytes_of(path, database_header);
  return is_database(header) &&
         (header[18] == 2 || header[19] == 2 || !database_changes(path).empty());
}

Dataset open_to_read(const std::string& name, const std::string& path, unsigned kind,
                     const char* const* drivers, const GdalErrors& errors,
                     const char* const* options, const Dataset& whole) {
  register_gdal();
  std::string from = name;
  CPLStringList settings(CSLDuplicate(const_cast<char**>(options)));
  CloseDataset close = whole.get_deleter();
  unsigned access = GDAL_OF_READONLY;
  if (is_database_in_use(path) && close.copy == nullptr) {
    const std::vector<std::string> changes = database_changes(path);
    std::error_code ignored;
    // GDAL removes a -wal, an empty one too, when it closes a database it has read.
    if (changes.empty() && !fs::exists(fs::canonical(path).string() + "-wal", ignored)) {
      settings.SetNameValue("IMMUTABLE", "YES");
    } else {
      close.copy = copy_database(path, changes);
      from = (fs::path(close.copy->path()) / fs::path(path).filename()).string();
      // An unfinished change is undone only by who may write.
      if (!changes.empty() && changes.back().ends_with("-journal")) access = GDAL_OF_UPDATE;
    }
  }
  Dataset dataset(GDALOpenEx(from.c_str(), kind | access, drivers, settings.List(), nullptr),
                  close);
  if (dataset && errors.lost())
    throw Error(ErrorKind::input, path, errors.say("is not read completely"));
  return dataset;
}

}  // namespace belvedere
