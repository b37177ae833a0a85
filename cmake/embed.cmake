# belvedere_embed(target file ...): builds text files into a target, found at run time by embedded_file("palettes/summer.toml").
# Names are relative to data/, or scenes/… for scenes; pages stand beside their servers, tools/studio/page/main.js is "studio/main.js".
function(belvedere_embed target)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/embedded_files.cpp)
  set(body "// Made by cmake/embed.cmake.\n#include \"base/text/embedded.h\"\nnamespace belvedere {\nconst EmbeddedFile embedded_files[] = {\n")
  foreach(file ${ARGN})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
    file(READ ${PROJECT_SOURCE_DIR}/${file} text)
    string(REGEX REPLACE "^data/" "" name ${file})
    string(REGEX REPLACE "^tools/([a-z]+)/page/" "\\1/" name ${name})
    # A raw string literal may hold 64 KiB; our files are far smaller, and a test checks that each parses.
    string(APPEND body "{\"${name}\", R\"~embed~(${text})~embed~\"},\n")
  endforeach()
  string(APPEND body "};\nconst unsigned embedded_file_count = sizeof(embedded_files) / sizeof(embedded_files[0]);\n}  // namespace belvedere\n")
  file(GENERATE OUTPUT ${out} CONTENT "${body}")
  target_sources(${target} PRIVATE ${out})
endfunction()
