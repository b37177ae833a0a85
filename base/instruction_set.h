#pragma once

#include <string>
#include <vector>

namespace belvedere {

// The vector instructions that tracing can be pinned to, narrowest first, by the names that scenes use: "sse2", "sse4.2", "avx", "avx2" and
// "avx512". Each holds those before it.
const std::vector<std::string>& instruction_sets();

// The widest that this machine has. $BELVEDERE_INSTRUCTION_SET, one of these names, makes it count as a machine that has no wider ones: to
// see what a scene does on an older one. Error(usage) where it is set to anything else.
std::string machine_instruction_set();

// As its makers write it: "AVX-512" for "avx512".
std::string instruction_set_title(const std::string& name);

// What is traced with: `pinned`, or for "any" the widest of this machine. Error(limit) where this machine lacks it, Error(usage) where
// there is none of that name.
std::string choose_instruction_set(const std::string& pinned);

}  // namespace belvedere
