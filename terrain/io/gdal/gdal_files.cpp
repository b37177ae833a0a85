#include "terrain/io/gdal/gdal_files.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "base/memory_limit.h"

namespace belvedere {
namespace {

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

}  // namespace

void register_gdal() {
  static std::once_flag registered;
  std::call_once(registered, [] { GDALAllRegister(); });
  limit_block_cache();
}

}  // namespace belvedere
