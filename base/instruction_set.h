#pragma once

#include <string>
#include <vector>

namespace belvedere {

// The vector instruction sets that tracing can be pinned to, narrowest first, by their names in
// scenes: "sse2", "sse4.2", "avx", "avx2" and "avx512". Each includes those before it.
const std::vector<std::string>& instruction_sets();

// The widest set that this machine supports. $BELVEDERE_INSTRUCTION_SET, one of these names, limits
// it, to reproduce a scene as an older machine renders it. Error(usage) for any other value.
std::string machine_instruction_set();

// The vendor's spelling: "AVX-512" for "avx512".
std::string instruction_set_title(const std::string& name);

// The set used for tracing: `pinned`, or for "any" the widest of this machine. Error(limit) if this
// machine lacks it, Error(usage) for an unknown name.
std::string choose_instruction_set(const std::string& pinned);

}  // namespace belvedere
