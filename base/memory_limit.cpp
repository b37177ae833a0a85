#include "base/memory_limit.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>

#include "base/error.h"
#include "base/text/parse_number.h"

namespace belvedere {
namespace {

constexpr double mib = 1024.0 * 1024.0;

// The limit of the container's control group, or the largest number.
std::uint64_t control_group_bytes() {
  std::ifstream file("/sys/fs/cgroup/memory.max");
  std::uint64_t bytes = 0;
  return file >> bytes && bytes > 0 ? bytes : UINT64_MAX;
}

// Limits in effect; few, and read once per file.
std::mutex limits_mutex;
std::multiset<std::uint64_t> limits;

}  // namespace

MemoryLimit::MemoryLimit(std::uint64_t bytes) : bytes_(bytes) {
  if (bytes_ == 0) return;
  const std::lock_guard lock(limits_mutex);
  limits.insert(bytes_);
}

MemoryLimit::~MemoryLimit() {
  if (bytes_ == 0) return;
  const std::lock_guard lock(limits_mutex);
  limits.erase(limits.find(bytes_));
}

std::uint64_t memory_budget_bytes() {
  {
    const std::lock_guard lock(limits_mutex);
    if (!limits.empty()) return *limits.begin();
  }
  if (const char* text = std::getenv("BELVEDERE_MEMORY_MIB"); text != nullptr && *text != 0) {
    const std::uint64_t value = parse_number<std::uint64_t>(text).value_or(0);
    if (value > 0 && value < (std::uint64_t{1} << 40)) return value << 20;
    throw Error(ErrorKind::usage, "BELVEDERE_MEMORY_MIB", fmt::format("\"{}\"", text),
                "a whole number of MiB above 0");
  }
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long page = sysconf(_SC_PAGE_SIZE);
  const std::uint64_t machine =
      pages > 0 && page > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page)
                            : std::uint64_t{4} << 30;
  return std::min(machine, control_group_bytes()) / 4 * 3;
}

void check_memory(const std::string& where, double bytes) {
  const auto limit = static_cast<double>(memory_budget_bytes());
  if (bytes <= limit) return;
  throw Error(ErrorKind::limit, where, fmt::format("needs {:.0f} MiB of memory", bytes / mib),
              fmt::format("at most {:.0f} MiB; use a smaller extent, larger cells or more memory "
                          "(--memory, BELVEDERE_MEMORY_MIB)",
                          limit / mib));
}

}  // namespace belvedere
