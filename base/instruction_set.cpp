#include "base/instruction_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/error.h"

namespace belvedere {
namespace {

// Index in instruction_sets(); their count for unknown names.
std::size_t rank_of(const std::string& name) {
  const std::vector<std::string>& names = instruction_sets();
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

// The features that Embree checks before it uses each set.
std::size_t rank_of_processor() {
  if (!__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("popcnt")) return 0;
  if (!__builtin_cpu_supports("avx")) return 1;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2"))
    return 2;
  if (!__builtin_cpu_supports("avx512f") || !__builtin_cpu_supports("avx512dq") ||
      !__builtin_cpu_supports("avx512cd") || !__builtin_cpu_supports("avx512bw") ||
      !__builtin_cpu_supports("avx512vl"))
    return 3;
  return 4;
}

std::size_t known_rank(const std::string& name, const std::string& where, const char* or_else) {
  const std::size_t rank = rank_of(name);
  if (rank == instruction_sets().size())
    throw Error(ErrorKind::usage, where, fmt::format("\"{}\"", name),
                fmt::format("{}{}", fmt::join(instruction_sets(), ", "), or_else));
  return rank;
}

}  // namespace

const std::vector<std::string>& instruction_sets() {
  static const std::vector<std::string> names = {"sse2", "sse4.2", "avx", "avx2", "avx512"};
  return names;
}

std::string machine_instruction_set() {
  std::size_t rank = rank_of_processor();
  if (const char* name = std::getenv("BELVEDERE_INSTRUCTION_SET"); name != nullptr && *name != 0)
    rank = std::min(rank, known_rank(name, "BELVEDERE_INSTRUCTION_SET", ""));
  return instruction_sets()[rank];
}

std::string instruction_set_title(const std::string& name) {
  static const std::vector<std::string> titles = {"SSE2", "SSE4.2", "AVX", "AVX2", "AVX-512"};
  return titles[known_rank(name, "instruction set", "")];
}

std::string choose_instruction_set(const std::string& pinned) {
  std::string widest = machine_instruction_set();
  if (pinned == "any") return widest;
  if (known_rank(pinned, "instruction_set", " or any") > rank_of(widest))
    throw Error(ErrorKind::limit, "instruction_set",
                fmt::format("this processor does not support {}", instruction_set_title(pinned)),
                fmt::format("a processor with it, \"{}\" or narrower, or \"any\"", widest));
  return pinned;
}

}  // namespace belvedere
