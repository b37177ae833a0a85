#pragma once

#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/cache/bytes.h"
#include "base/cache/cache.h"
#include "base/progress.h"
#include "renderer/scene/scene_file.h"

namespace belvedere {

struct GeoTransform;

// The table of cached products. A product is worth a row if making it takes much longer than
// reading it.
enum class CachedProduct {
  synthetic_terrain,
  elevation,
  land_cover,
  generalized_ground,
  ground_surroundings,
  example_sheet,
  synthesis_plan,
  ground_features,
  river_courses,
  ground_texture
};
struct CachedProductInfo {
  CachedProduct id;
  std::string_view name;  // in `belvedere cache list`
  int format;  // of its bytes and its key's text: increment when either changes its meaning
};
std::span<const CachedProductInfo> cached_products();

// The key of a product made from `made_from`. It includes this program: version, libraries, the
// processor's vector instructions and the hash of its own file, so a changed program does not find
// the products of another. subject: shown to users, the scene.
CacheKey make_cache_key(CachedProduct product, const CacheKeyText& made_from, std::string subject);

// Adds a grid's place to the key of what is made on it.
void add_transform(CacheKeyText& key, const GeoTransform& transform);

// Name of a scene's products in lists of the cache.
std::string subject_of(const LoadedScene& scene);

// Collects the notes of a stage while passing them on, so that a cached product can repeat them.
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

// The result of `make(progress)`, from the cache if it is there. Value: a type that
// base/cache/bytes.h can write. `make_key` is called only if there is a cache.
template <class Value, class MakeKey, class Make>
Value cached(const Cache& cache, MakeKey&& make_key, Progress& progress, Make&& make) {
  if (!cache.is_on()) return make(progress);
  const CacheKey key = make_key();
  {
    std::vector<std::string> notes;
    Value value;
    if (cache.read(
            key, [&](ByteReader& bytes) { bytes(notes, value); }, progress)) {
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
