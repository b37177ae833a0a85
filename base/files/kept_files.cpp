#include "base/files/kept_files.h"

#include <filesystem>

namespace belvedere {

std::shared_ptr<KeptFiles> make_kept_files() { return std::make_shared<KeptFiles>(); }

std::vector<KeptFiles::Stamp> KeptFiles::stamps_of(const std::vector<std::string>& files) {
  std::vector<Stamp> stamps;
  for (const std::string& file : files) {
    std::error_code none;
    stamps.emplace_back(std::filesystem::file_size(file, none),
                        std::filesystem::last_write_time(file, none).time_since_epoch().count());
  }
  return stamps;
}

std::shared_ptr<const void> KeptFiles::find(const std::string& key,
                                            const std::vector<Stamp>& stamps) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(key);
  return found != entries_.end() && found->second.stamps == stamps ? found->second.value : nullptr;
}

std::shared_ptr<const void> KeptFiles::keep(const std::string& key,
                                            const std::vector<Stamp>& stamps,
                                            std::shared_ptr<const void> value) {
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[key];
  if (entry.value == nullptr || entry.stamps != stamps) entry = {stamps, std::move(value)};
  return entry.value;
}

}  // namespace belvedere
