# How everything of ours is compiled: an interface target that each of our targets links privately; nobody else is compiled so.
add_library(belvedere_flags INTERFACE)
target_compile_options(belvedere_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wnon-virtual-dtor -Woverloaded-virtual
  # Warnings are errors to the compilers of Debian 12, by which it is developed; later ones warn of more, and users have to build.
  $<$<OR:$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>,$<AND:$<CXX_COMPILER_ID:Clang>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,15>>>:-Werror>
  # In a batch the anonymous namespaces of other files count as outer scopes; Clang cannot tell these from local ones.
  $<IF:$<BOOL:${BELVEDERE_BATCHES}>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>
  # GCC takes the batch for the main file, and warns of types of the files in it that hold something of an anonymous namespace.
  $<$<AND:$<BOOL:${BELVEDERE_BATCHES}>,$<CXX_COMPILER_ID:GNU>>:-Wno-subobject-linkage>
  # GCC 12 sees copies that overlap or overflow in its own std::string once it is inlined (GCC bugs 105329, 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-stringop-overflow>
  # The same bits everywhere: no fused multiply-add unless written, no fast-math; a plain x86-64-v2 machine is enough.
  -ffp-contract=off -march=x86-64-v2 -mtune=generic -pthread
  # The same bytes wherever it is built: no names of folders of this machine.
  -ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
if(BELVEDERE_SANITIZE)
  target_compile_options(belvedere_flags INTERFACE -fsanitize=${BELVEDERE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(belvedere_flags INTERFACE -fsanitize=${BELVEDERE_SANITIZE})
endif()
