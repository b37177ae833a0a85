#include "base/cache/cache.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/error.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view magic = "Belvedere cache 1\n";
constexpr std::string_view extension = ".cache";
constexpr std::string_view temporary_extension = ".cache-tmp";
constexpr std::size_t digits = 32;  // of a hash
constexpr std::uint64_t max_header_bytes = std::uint64_t{1} << 24;
constexpr auto forgotten = std::chrono::hours(24);  // no write takes this long: its program ended

// A file that closes itself.
class Descriptor {
 public:
  Descriptor(const std::string& path, int flags)
      : file_(::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0600)) {}
  ~Descriptor() {
    if (file_ >= 0) ::close(file_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool is_open() const { return file_ >= 0; }
  // The size of a regular file; nothing for anything else of that name.
  std::optional<std::uint64_t> size() const {
    struct stat status {};
    if (file_ < 0 || ::fstat(file_, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
    return static_cast<std::uint64_t>(status.st_size);
  }
  bool read(void* to, std::size_t count) const {
    auto* at = static_cast<char*>(to);
    while (count > 0) {
      const ssize_t got = ::read(file_, at, count);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got;
      count -= static_cast<std::size_t>(got);
    }
    return true;
  }
  bool write(const void* from, std::size_t count) const {
    const auto* at = static_cast<const char*>(from);
    while (count > 0) {
      const ssize_t put = ::write(file_, at, count);
      if (put < 0 && errno == EINTR) continue;
      if (put <= 0) return false;
      at += put;
      count -= static_cast<std::size_t>(put);
    }
    return true;
  }

 private:
  int file_;
};

// The header before the payload: the magic, the sizes of four parts as 64-bit numbers, and the
// first three parts.
struct Header {
  std::string product;
  std::string subject;
  std::string text;
  std::uint64_t payload_bytes = 0;
};

std::string written(const Header& header) {
  std::string out(magic);
  for (const std::uint64_t size :
       {static_cast<std::uint64_t>(header.product.size()),
        static_cast<std::uint64_t>(header.subject.size()),
        static_cast<std::uint64_t>(header.text.size()), header.payload_bytes})
    out.append(reinterpret_cast<const char*>(&size), sizeof size);
  return out + header.product + header.subject + header.text;
}

// Nothing if the entry is incomplete: the sizes must match the file's.
std::optional<Header> read_header(const Descriptor& file) {
  const std::optional<std::uint64_t> size = file.size();
  std::array<char, magic.size()> begin{};
  std::array<std::uint64_t, 4> sizes{};
  if (!size || !file.read(begin.data(), begin.size()) ||
      std::string_view(begin.data(), begin.size()) != magic ||
      !file.read(sizes.data(), sizeof sizes))
    return std::nullopt;
  const auto [product, subject, text, payload] = sizes;
  if (product > max_header_bytes || subject > max_header_bytes || text > max_header_bytes ||
      payload > *size ||
      begin.size() + sizeof sizes + product + subject + text + payload + digits != *size)
    return std::nullopt;
  Header header{std::string(product, '\0'), std::string(subject, '\0'), std::string(text, '\0'),
                payload};
  for (std::string* part : {&header.product, &header.subject, &header.text})
    if (!file.read(part->data(), part->size())) return std::nullopt;
  return header;
}

// The bytes between header and hash, hashed as they are read.
class Payload {
 public:
  Payload(const Descriptor& file, std::uint64_t bytes) : file_(file), left_(bytes) {}

  bool read(void* to, std::size_t count) {
    auto* at = static_cast<char*>(to);
    while (count > 0) {
      if (used_ < buffer_.size()) {
        const std::size_t part = std::min(count, buffer_.size() - used_);
        std::memcpy(at, buffer_.data() + used_, part);
        used_ += part;
        at += part;
        count -= part;
      } else if (count >= block_bytes) {  // straight to its place
        if (!take(at, block_bytes)) return false;
        at += block_bytes;
        count -= block_bytes;
      } else {
        buffer_.resize(std::min<std::uint64_t>(block_bytes, left_));
        used_ = 0;
        if (buffer_.empty() || !take(buffer_.data(), buffer_.size())) return false;
      }
    }
    return true;
  }
  // Once everything was read.
  bool is_whole() const {
    std::string expected(digits, '\0');
    return left_ == 0 && used_ == buffer_.size() && file_.read(expected.data(), digits) &&
           expected == hash_.digits();
  }

 private:
  static constexpr std::size_t block_bytes = 1 << 18;  // is still near the processor when hashed

  bool take(char* to, std::size_t count) {
    if (count > left_ || !file_.read(to, count)) return false;
    left_ -= count;
    hash_.add(to, count);
    return true;
  }

  const Descriptor& file_;
  std::uint64_t left_;  // in the file
  std::vector<char> buffer_;
  std::size_t used_ = 0;  // of the buffer
  ContentHash hash_;
};

bool is_hexadecimal(std::string_view text) {
  return text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_entry_name(const std::string& name) {
  return name.size() == digits + extension.size() && name.ends_with(extension) &&
         is_hexadecimal(std::string_view(name).substr(0, digits));
}

bool is_temporary_name(const std::string& name) {
  return name.size() > digits && name.ends_with(temporary_extension) &&
         is_hexadecimal(std::string_view(name).substr(0, digits));
}

struct Found {
  fs::path path;
  std::uint64_t bytes = 0;
  fs::file_time_type used;
};

// Entries, or their temporary files, in no order. Files may disappear during the search.
std::vector<Found> files_in(const std::string& folder, bool (*wanted)(const std::string&),
                            std::error_code& problem) {
  std::vector<Found> found;
  for (fs::directory_iterator at(folder, problem), end; !problem && at != end;
       at.increment(problem)) {
    if (!wanted(at->path().filename().string())) continue;
    std::error_code gone;
    const bool plain = fs::is_regular_file(at->symlink_status(gone));
    const std::uint64_t bytes = plain && !gone ? fs::file_size(at->path(), gone) : 0;
    const fs::file_time_type used =
        plain && !gone ? fs::last_write_time(at->path(), gone) : fs::file_time_type();
    if (plain && !gone) found.push_back({at->path(), bytes, used});
  }
  return found;
}

// Removes the least recently used entries until the limit is met. Other programs may do the same at
// the same time; files already removed are no error.
void trim(const std::string& folder, std::uint64_t limit_bytes) {
  std::error_code ignored;
  for (const Found& file : files_in(folder, is_temporary_name, ignored))
    if (fs::file_time_type::clock::now() - file.used > forgotten) fs::remove(file.path, ignored);
  std::vector<Found> entries = files_in(folder, is_entry_name, ignored);
  std::uint64_t sum = 0;
  for (const Found& entry : entries) sum += entry.bytes;
  if (sum <= limit_bytes) return;
  std::sort(entries.begin(), entries.end(), [](const Found& a, const Found& b) {
    return std::pair(a.used, a.path) < std::pair(b.used, b.path);
  });
  for (const Found& entry : entries) {
    if (sum <= limit_bytes) return;
    fs::remove(entry.path, ignored);
    sum -= entry.bytes;
  }
}

std::string entry_path(const std::string& folder, const CacheKey& key) {
  return (fs::path(folder) / (hash_bytes(key.product + '\n' + key.text) + std::string(extension)))
      .string();
}

std::string reason_of(int code) { return std::generic_category().message(code); }

}  // namespace

Cache::Cache(CacheParameters parameters) : parameters_(std::move(parameters)) {}

void Cache::note_once(const std::string& reason, Progress& progress) const {
  if (!noted_.exchange(true))
    progress.note(fmt::format("cache {} is not used: {}", parameters_.folder, reason));
}

bool Cache::open(const CacheKey& key,
                 FunctionRef<bool(const ByteReader::Source&, std::uint64_t)> take,
                 Progress& progress) const {
  if (!is_on()) return false;
  const std::string path = entry_path(parameters_.folder, key);
  const Descriptor file(path, O_RDONLY);
  if (!file.is_open()) {
    const int code = errno;
    if (code != ENOENT) note_once(reason_of(code), progress);
    return false;
  }
  const std::optional<Header> header = read_header(file);
  bool whole = header && header->product == key.product && header->text == key.text;
  if (whole) {
    Payload payload(file, header->payload_bytes);
    const auto source = [&](void* to, std::size_t count) { return payload.read(to, count); };
    whole = take(source, header->payload_bytes) && payload.is_whole();
  }
  std::error_code ignored;
  if (!whole) {
    fs::remove(path, ignored);
    progress.note(
        fmt::format("damaged cache entry is recomputed: {} of {}", key.product, key.subject));
    return false;
  }
  fs::last_write_time(path, fs::file_time_type::clock::now(),
                      ignored);  // the modification time is the time of the last use
  return true;
}

std::optional<Bytes> Cache::find(const CacheKey& key, Progress& progress) const {
  Bytes bytes;
  const auto take = [&](const ByteReader::Source& source, std::uint64_t size) {
    bytes.resize(size);
    return source(bytes.data(), bytes.size());
  };
  if (!open(key, take, progress)) return std::nullopt;
  return bytes;
}

bool Cache::read(const CacheKey& key, FunctionRef<void(ByteReader&)> read,
                 Progress& progress) const {
  const auto take = [&](const ByteReader::Source& source, std::uint64_t size) {
    ByteReader reader(source, size);
    read(reader);
    return reader.is_done();
  };
  return open(key, take, progress);
}

void Cache::store(const CacheKey& key, std::span<const std::span<const std::byte>> parts,
                  Progress& progress) const {
  if (!is_on()) return;
  std::error_code problem;
  fs::create_directories(parameters_.folder, problem);
  if (problem) return note_once(problem.message(), progress);
  Header header{key.product, key.subject, key.text};
  ContentHash hash;
  for (const std::span<const std::byte> part : parts) {
    header.payload_bytes += part.size();
    hash.add(part.data(), part.size());
  }
  const std::string begin = written(header);
  const std::string end = hash.digits();
  const std::uint64_t limit = parameters_.limit_bytes > 0 ? parameters_.limit_bytes
                                                          : default_cache_limit(parameters_.folder);
  if (begin.size() + header.payload_bytes + end.size() > limit) return;

  // A name that no other thread or process uses.
  static std::atomic<std::uint64_t> number = 0;
  const std::string path = entry_path(parameters_.folder, key);
  const std::string temporary =
      fmt::format("{}-{}-{}{}", path.substr(0, path.size() - extension.size()), ::getpid(),
                  number.fetch_add(1), temporary_extension);
  int code = 0;
  {
    const Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    bool done = file.is_open() && file.write(begin.data(), begin.size());
    for (const std::span<const std::byte> part : parts)
      done = done && file.write(part.data(), part.size());
    done = done && file.write(end.data(), end.size());
    if (!done) code = errno;
  }
  if (code == 0 && std::rename(temporary.c_str(), path.c_str()) != 0) code = errno;
  if (code != 0) {
    ::unlink(temporary.c_str());
    return note_once(reason_of(code), progress);
  }
  trim(parameters_.folder, limit);
}

const Cache& no_cache() {
  static const Cache none;
  return none;
}

std::string user_cache_folder() {
  if (const char* own = std::getenv("BELVEDERE_CACHE")) return own;
  // The standard requires that relative paths be ignored.
  if (const char* xdg = std::getenv("XDG_CACHE_HOME"); xdg != nullptr && *xdg == '/')
    return (fs::path(xdg) / "belvedere").string();
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/')
    return (fs::path(home) / ".cache" / "belvedere").string();
  return {};
}

std::vector<CacheEntry> cache_entries(const std::string& folder) {
  std::error_code problem;
  std::vector<Found> files = files_in(folder, is_entry_name, problem);
  if (problem && problem != std::errc::no_such_file_or_directory)
    throw Error(ErrorKind::input, folder, problem.message());
  std::sort(files.begin(), files.end(), [](const Found& a, const Found& b) {
    return std::pair(b.used, b.path) < std::pair(a.used, a.path);
  });
  const auto now = fs::file_time_type::clock::now();
  std::vector<CacheEntry> entries;
  for (const Found& file : files) {
    const std::optional<Header> header = read_header(Descriptor(file.path.string(), O_RDONLY));
    const auto age = std::chrono::duration_cast<std::chrono::seconds>(now - file.used);
    entries.push_back({file.path.string(), header ? header->product : "damaged",
                       header ? header->subject : "", file.bytes,
                       std::max<std::int64_t>(age.count(), 0)});
  }
  return entries;
}

std::vector<CacheEntry> clear_cache(const std::string& folder, std::int64_t older_than_s) {
  std::vector<CacheEntry> removed;
  for (CacheEntry& entry : cache_entries(folder)) {
    if (entry.age_s < older_than_s) continue;
    std::error_code problem;
    fs::remove(entry.path, problem);
    if (problem)
      throw Error(ErrorKind::output, entry.path,
                  "cannot remove the cache entry: " + problem.message());
    removed.push_back(std::move(entry));
  }
  std::error_code ignored;
  for (const Found& file : files_in(folder, is_temporary_name, ignored))
    if (fs::file_time_type::clock::now() - file.used > forgotten) fs::remove(file.path, ignored);
  return removed;
}

std::uint64_t default_cache_limit(const std::string& folder) {
  constexpr std::uint64_t max = std::uint64_t{20} << 30;
  std::error_code problem;
  const fs::space_info space = fs::space(folder, problem);
  if (problem) return max;
  std::uint64_t own = 0;  // its space counts as free for the cache
  for (const Found& entry : files_in(folder, is_entry_name, problem)) own += entry.bytes;
  return std::min(max, (static_cast<std::uint64_t>(space.available) + own) / 10);
}

void CacheKeyText::put(double number) { text_ += fmt::format("{:a}", number); }

// Prefixes a text with its length, so that one text cannot be read as two values.
void CacheKeyText::put(std::string_view text) {
  text_ += fmt::format("{}\"{}\"", text.size(), text);
}

void CacheKeyText::put_grid(int width, int height, std::string_view cells) {
  text_ += fmt::format("{}x{} {}", width, height, hash_bytes(cells));
}

}  // namespace belvedere
