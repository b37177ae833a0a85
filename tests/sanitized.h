#pragma once

// Defined where tests run under sanitizers, which keep freed memory, need much address space, and
// are slow. The presets asan and tsan are Clang's.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define BELVEDERE_SANITIZED
#endif
#endif
