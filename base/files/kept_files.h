#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace belvedere {

// Keeps values read from files, so that each file is read once; copies of a scene share one store.
// Thread-safe; two threads that miss the same value both read it, and the first one stays.
class KeptFiles {
 public:
  // Returns the T that `read` makes, or the kept one of the same key (which names the content and
  // how it is read) while none of the files has changed in size or time.
  template <class T, class Read>
  std::shared_ptr<const T> get(const std::string& key, const std::vector<std::string>& files,
                               const Read& read) {
    const std::vector<Stamp> stamps = stamps_of(files);
    if (std::shared_ptr<const void> kept = find(key, stamps))
      return std::static_pointer_cast<const T>(std::move(kept));
    return std::static_pointer_cast<const T>(keep(key, stamps, std::make_shared<const T>(read())));
  }

 private:
  using Stamp = std::pair<std::uint64_t, std::int64_t>;  // bytes, time
  struct Entry {
    std::vector<Stamp> stamps;
    std::shared_ptr<const void> value;
  };
  static std::vector<Stamp> stamps_of(const std::vector<std::string>& files);
  std::shared_ptr<const void> find(const std::string& key, const std::vector<Stamp>& stamps);
  std::shared_ptr<const void> keep(const std::string& key, const std::vector<Stamp>& stamps,
                                   std::shared_ptr<const void> value);

  std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};
std::shared_ptr<KeptFiles> make_kept_files();

}  // namespace belvedere
