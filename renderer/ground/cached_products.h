#pragma once

#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/cache/bytes.h"
#include "base/cache/cache.h"
#include "base/cache/cache_key.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

// The one table of what the cache keeps. A product is worth a row where making it takes much longer than reading it.
enum class CachedProduct {
  synthetic_terrain,
  land_cover,
  generalized_ground,
  ground_surroundings,
  example_sheet,
  synthesis_plan,
  ground_features,
  river_courses
};
struct CachedProductInfo {
  CachedProduct id;
  std::string_view name;  // in `belvedere cache list`
  int format;             // of its bytes and of its key's text: one more whenever either changes its meaning
};
std::span<const CachedProductInfo> cached_products();

// The key of a product made from `made_from`. This program goes in as well, by version, libraries, the processor's vector instructions and
// the hash of its own file: a changed program finds nothing of what another made. subject: for people, of what scene.
CacheKey make_cache_key(CachedProduct product, const CacheKeyText& made_from, std::string subject);

// What a scene's products are called in lists of the cache.
std::string subject_of(const LoadedScene& scene);

// Collects the remarks of a stage on their way, so that a product of the cache brings them along. Of the stage itself nothing is hidden.
class KeptNotes : public Progress {
 public:
  explicit KeptNotes(Progress& watcher) : watcher_(watcher) {}
  void begin(std::string_view stage, double total) override { watcher_.begin(stage, total); }
  void advance(double amount) override { watcher_.advance(amount); }
  void note(std::string_view text) override {
    watcher_.note(text);
    const std::lock_guard lock(mutex_);
    notes_.emplace_back(text);
  }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  Progress& watcher_;
  std::mutex mutex_;
  std::vector<std::string> notes_;
};

// What `make(progress)` gives, from the cache where it is kept there. Value: one that base/cache/bytes.h can write. `make_key` is asked
// only where there is a cache.
template <class Value, class MakeKey, class Make>
Value cached(const Cache& cache, MakeKey&& make_key, Progress& progress, Make&& make) {
  if (!cache.is_on()) return make(progress);
  const CacheKey key = make_key();
  if (const std::optional<Bytes> bytes = cache.find(key, progress)) {
    std::vector<std::string> notes;
    Value value;
    ByteReader reader(*bytes);
    reader(notes, value);
    if (reader.is_done()) {
      for (const std::string& note : notes) progress.note(note);
      return value;
    }
  }
  KeptNotes kept(progress);
  Value value = make(kept);
  ByteWriter writer;
  writer(kept.notes(), value);
  cache.store(key, writer.parts(), progress);
  return value;
}

}  // namespace belvedere
