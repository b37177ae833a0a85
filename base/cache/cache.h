#pragma once

#include <array>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/cache/bytes.h"
#include "base/cache/content_hash.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace belvedere {

// The identity of a kept product. `text` is the key (base/cache/cache.h): a request with the
// same text gets the bytes stored with it.
struct CacheKey {
  std::string product;  // for messages: "land cover"
  std::string subject;  // for messages: the scene
  std::string text;
};

struct CacheParameters {
  std::string folder;  // created if it is missing; empty: nothing is kept
  std::uint64_t limit_bytes =
      0;  // of all entries; 0: the smaller of 20 GiB and a tenth of the free disk space
};

// Keeps the bytes of products that are slow to make and depend on inputs alone, one file each, from
// one run to the next. Results never depend on it. Files are written atomically and checked by
// their hash when read. When the cache is too large, the least recently used entries are removed.
// Any number of programs may share a folder. A cache that cannot be read or written is not used,
// with one note. Thread-safe.
class Cache {
 public:
  Cache() = default;  // keeps nothing
  explicit Cache(CacheParameters parameters);
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;

  bool is_on() const { return !parameters_.folder.empty(); }
  // Returns the entry stored under this key, or nothing. A damaged entry is noted and removed.
  std::optional<Bytes> find(const CacheKey& key, Progress& progress) const;
  // The same for values that `read` takes straight from the file. False if there is no such entry
  // or it is damaged; discard what was read then.
  bool read(const CacheKey& key, FunctionRef<void(ByteReader&)> read, Progress& progress) const;
  // Parts are concatenated.
  void store(const CacheKey& key, std::span<const std::span<const std::byte>> parts,
             Progress& progress) const;
  void store(const CacheKey& key, std::span<const std::byte> bytes, Progress& progress) const {
    store(key, std::span(&bytes, 1), progress);
  }

 private:
  // `take` gets the payload and its size, and says whether it read to the end.
  bool open(const CacheKey& key, FunctionRef<bool(const ByteReader::Source&, std::uint64_t)> take,
            Progress& progress) const;
  void note_once(const std::string& reason, Progress& progress) const;

  CacheParameters parameters_;
  mutable std::atomic<bool> noted_ = false;
};

// For callers that keep nothing.
const Cache& no_cache();

// The user's cache folder: $BELVEDERE_CACHE (empty: no cache), else belvedere/ in $XDG_CACHE_HOME
// or ~/.cache. An empty result: no cache.
std::string user_cache_folder();

// An entry, for listings.
struct CacheEntry {
  std::string path;
  std::string product;
  std::string subject;
  std::uint64_t bytes = 0;  // of the file
  std::int64_t age_s = 0;   // since it was used
};
// Most recently used first; none if the folder does not exist. Files that are not entries are
// skipped. Error(input) if the folder cannot be read.
std::vector<CacheEntry> cache_entries(const std::string& folder);
// Removes entries that were not used for this long, and the temporary files of interrupted
// programs; other files stay. Returns what it removed. Error(output) if an entry cannot be removed.
std::vector<CacheEntry> clear_cache(const std::string& folder, std::int64_t older_than_s = 0);
// The default of CacheParameters::limit_bytes.
std::uint64_t default_cache_limit(const std::string& folder);

// The inputs of a cached product as a text that is equal if and only if the values are: numbers to
// the last bit (hexadecimal floating point), texts with their length, grids by their size and the
// hash of their cells. Every input must be included, or the cache would change pixels. Take
// parameters apart by structured bindings, which name all fields or do not compile.
class CacheKeyText {
 public:
  template <class T>
  CacheKeyText& add(std::string_view name, const T& value) {
    text_ += name;
    text_ += '=';
    put(value);
    text_ += '\n';
    return *this;
  }
  const std::string& str() const { return text_; }

 private:
  void put(double number);
  void put(float number) { put(static_cast<double>(number)); }
  void put(bool is) { text_ += is ? "yes" : "no"; }
  void put(std::string_view text);
  void put(const std::string& text) { put(std::string_view(text)); }
  void put(const char* text) { put(std::string_view(text)); }
  template <std::integral T>
  void put(T number) {
    text_ += std::to_string(number);
  }
  template <class T>
  requires std::is_enum_v<T>
  void put(T value) { put(static_cast<std::int64_t>(value)); }
  template <glm::length_t size, class T, glm::qualifier q>
  void put(const glm::vec<size, T, q>& vector) {
    for (glm::length_t i = 0; i < size; ++i) put(vector[i]), text_ += ' ';
  }
  template <class A, class B>
  void put(const std::pair<A, B>& pair) {
    put(pair.first);
    text_ += ':';
    put(pair.second);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    if (value)
      put(*value);
    else
      text_ += "none";
  }
  template <class T, std::size_t size>
  void put(const std::array<T, size>& values) {
    put_list(values);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put_list(values);
  }
  template <class T>
  void put(const Grid<T>& grid) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>,
                  "equal cells must be equal bytes");
    put_grid(grid.width(), grid.height(),
             {reinterpret_cast<const char*>(grid.data()), grid.size() * sizeof(T)});
  }
  template <class List>
  void put_list(const List& values) {
    text_ += '[';
    for (const auto& value : values) put(value), text_ += ',';
    text_ += ']';
  }
  void put_grid(int width, int height, std::string_view cells);

  std::string text_;
};

}  // namespace belvedere
