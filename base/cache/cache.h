#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/cache/bytes.h"
#include "base/progress.h"

namespace belvedere {

// What a kept product is. `text` decides (base/cache/cache_key.h): who asks with the same text gets the bytes that were stored with it.
struct CacheKey {
  std::string product;  // for people: "land cover"
  std::string subject;  // for people: of what scene
  std::string text;
};

struct CacheParameters {
  std::string folder;             // made where it is missing; empty: nothing is kept
  std::uint64_t limit_bytes = 0;  // of all entries; 0: 20 GiB or a tenth of the disk that is free for it, whichever is less
};

// Keeps the bytes of products that are slow and made from inputs alone, one file each, from one run to the next; never changes what is
// made. Files appear whole or not at all, are trusted only as far as their hash, and go when the cache is too large, those first that were
// not used for longest. Any number of programs may share a folder. A cache that cannot be read or written is none, which is noted once.
// For any thread.
class Cache {
 public:
  Cache() = default;  // keeps nothing
  explicit Cache(CacheParameters parameters);
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;

  bool is_on() const { return !parameters_.folder.empty(); }
  // What was stored with this key, or nothing. A damaged entry is noted and removed.
  std::optional<Bytes> find(const CacheKey& key, Progress& progress) const;
  // Parts are written one behind the other.
  void store(const CacheKey& key, std::span<const std::span<const std::byte>> parts, Progress& progress) const;
  void store(const CacheKey& key, std::span<const std::byte> bytes, Progress& progress) const {
    store(key, std::span(&bytes, 1), progress);
  }

 private:
  void note_once(const std::string& reason, Progress& progress) const;

  CacheParameters parameters_;
  mutable std::atomic<bool> noted_ = false;
};

// For callers that keep nothing.
const Cache& no_cache();

// The user's cache folder: $BELVEDERE_CACHE, where it is set to nothing none; else belvedere in $XDG_CACHE_HOME or ~/.cache. Empty: none.
std::string user_cache_folder();

// An entry as people may look at it.
struct CacheEntry {
  std::string path;
  std::string product;
  std::string subject;
  std::uint64_t bytes = 0;  // of the file
  std::int64_t age_s = 0;   // since it was used
};
// The last used first; none where there is no such folder. What is no entry is passed over. Error(input) where the folder cannot be read.
std::vector<CacheEntry> cache_entries(const std::string& folder);
// Removes the entries that were not used for so long, and what interrupted programs left; what else lies in the folder stays.
// Returns what it removed. Error(output) where an entry cannot be removed.
std::vector<CacheEntry> clear_cache(const std::string& folder, std::int64_t older_than_s = 0);
// What the cache may grow to where nothing is said: CacheParameters::limit_bytes.
std::uint64_t default_cache_limit(const std::string& folder);

}  // namespace belvedere
