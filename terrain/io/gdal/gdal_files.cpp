#include "terrain/io/gdal/gdal_files.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "base/memory_limit.h"

namespace belvedere {
namespace {

// Blocks of files that GDAL keeps, by itself a twentieth of the machine whatever the program may take. A row of 256² blocks over 40000
// columns is 40 MB.
std::uint64_t block_cache_bytes() {
  constexpr std::uint64_t fewest = std::uint64_t{16} << 20;
  constexpr std::uint64_t most = std::uint64_t{1} << 30;
  return std::clamp(memory_budget_bytes() / 16, fewest, most);
}

void limit_block_cache() {
  // Whoever says it to GDAL itself is heard.
  if (CPLGetConfigOption("GDAL_CACHEMAX", nullptr) != nullptr) return;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const auto bytes = static_cast<GIntBig>(block_cache_bytes());
  if (GDALGetCacheMax64() != bytes) GDALSetCacheMax64(bytes);
}

}  // namespace

void register_gdal() {
  static std::once_flag registered;
  std::call_once(registered, [] { GDALAllRegister(); });
  limit_block_cache();
}

}  // namespace belvedere
