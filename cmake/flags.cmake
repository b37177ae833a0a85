# How everything of ours is compiled: an interface target that each of our targets links privately; nobody else is compiled so.
add_library(belvedere_flags INTERFACE)
target_compile_options(belvedere_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wnull-dereference -Werror
  # GCC 12 sees overlapping copies in the string concatenations of its own library at -O3 (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # The same bits everywhere: no fused multiply-add unless written, no fast-math; a plain x86-64-v2 machine is enough.
  -ffp-contract=off -march=x86-64-v2 -mtune=generic)
if(BELVEDERE_SANITIZE)
  target_compile_options(belvedere_flags INTERFACE -fsanitize=${BELVEDERE_SANITIZE} -fno-omit-frame-pointer -Wno-error=null-dereference $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>)
  target_link_options(belvedere_flags INTERFACE -fsanitize=${BELVEDERE_SANITIZE})
endif()
