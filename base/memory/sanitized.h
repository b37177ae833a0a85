#pragma once

// Which sanitizer this is compiled for. Sanitizers keep freed memory, need much address space, are
// slow, and do not see how libraries without them hand data from thread to thread. GCC and Clang
// tell it in different ways.
#ifdef __has_feature
#if __has_feature(address_sanitizer)
#define BELVEDERE_ADDRESS_SANITIZER
#elif __has_feature(thread_sanitizer)
#define BELVEDERE_THREAD_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define BELVEDERE_ADDRESS_SANITIZER
#elif defined(__SANITIZE_THREAD__)
#define BELVEDERE_THREAD_SANITIZER
#endif
#if defined(BELVEDERE_ADDRESS_SANITIZER) || defined(BELVEDERE_THREAD_SANITIZER)
#define BELVEDERE_SANITIZED
#endif
