#pragma once

#include <cstddef>

namespace belvedere {

// Copies and fills of large blocks by all threads: the first write to a page of new memory waits
// until the system has cleared it, which takes longer than the copy. The caller does small blocks
// alone. The caller's threads take up no other work meanwhile, so a lock may be held.

// The two blocks must not overlap.
void copy_in_parallel(void* to, const void* from, std::size_t bytes);
// `count` values of `value_bytes` each, one after the other.
void fill_in_parallel(void* to, const void* value, std::size_t value_bytes, std::size_t count);

}  // namespace belvedere
