#pragma once

#include <cstddef>

namespace belvedere {

// Copies and fills of large blocks by all threads: whoever writes a page of new memory first waits until the system has cleared it, and
// that takes longer than the copy. Small blocks are done by the caller. Other work of the caller's threads does not begin meanwhile, so
// that this may be called with a lock held.

// The two blocks do not overlap.
void copy_in_parallel(void* to, const void* from, std::size_t bytes);
// `count` values of `value_bytes` each, one after the other.
void fill_in_parallel(void* to, const void* value, std::size_t value_bytes, std::size_t count);

}  // namespace belvedere
