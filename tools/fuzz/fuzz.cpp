#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/error.h"
#include "base/memory_limit.h"
#include "tools/fuzz/targets.h"

// The driver of libFuzzer: `fuzz TARGET [options of libFuzzer] [CORPUS …]`; `fuzz` alone lists the
// targets with their examples.
namespace {

const belvedere::FuzzTarget* target = nullptr;

void list_targets() {
  for (const belvedere::FuzzTarget& each : belvedere::fuzz_targets())
    std::printf("%s %s\n", std::string(each.name).c_str(), std::string(each.seeds).c_str());
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc > 1)
    for (const belvedere::FuzzTarget& each : belvedere::fuzz_targets())
      if (each.name == (*argv)[1]) target = &each;
  if (target == nullptr) {
    list_targets();
    std::exit(*argc > 1 ? 2 : 0);
  }
  // libFuzzer does not know the name of the target.
  for (int i = 1; i + 1 < *argc; ++i) (*argv)[i] = (*argv)[i + 1];
  --*argc;
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The limit refuses what the program would refuse on a small machine: half of the memory that
  // tools/fuzz/run lets it use.
  static const belvedere::MemoryLimit limit(std::uint64_t{1} << 30);
  try {
    target->read(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const belvedere::Error& error) {
    // A fault of the program itself is one here too.
    if (error.kind() == belvedere::ErrorKind::bug) std::abort();
  }
  return 0;
}
