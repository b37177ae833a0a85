# Quick builds: foreign headers are parsed once (a precompiled header), and the .cpp files of a room are compiled some at a time, as one
# unit (CMake's unity builds). A room is the folder below a layer, terrain/climate say, with the folders in it.
#
# Batches ask one thing of the code: what an anonymous namespace names is named once in its room (tools/check).
# Each file compiles alone all the same: -DBELVEDERE_BATCHES=OFF, and tools/check_all alone.
option(BELVEDERE_BATCHES "Compile files of a room together, with precompiled headers" ON)
set(BELVEDERE_BATCH_SIZE 14 CACHE STRING "Files that are compiled as one, at most")

# Folders whose code does not run once per pixel. Compiling them with -O1 instead of -O2 saves a third of the compiler's time and costs no
# measurable run time; the whole program at -O1 renders the demo in 1.5 times the time.
set(belvedere_o1_folders renderer_labels_ renderer_live_ renderer_pipeline_ renderer_press_ renderer_scene_ terrain_fetch_ tools_cli_ tools_report_
  tools_pick_ tools_studio_ tools_web_)

# belvedere_precompiled(NAME headers … [LINK libraries …]): headers that many targets read, compiled once for all of them. What defines
# macros or changes code (belvedere_flags) must be the same here and there, else the compiler says so.
function(belvedere_precompiled name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LINK")
  if(NOT BELVEDERE_BATCHES)
    return()
  endif()
  set(file ${CMAKE_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${file} CONTENT "// Only what this file includes matters: see cmake/batches.cmake.\n")
  add_library(${name} OBJECT ${file})
  target_link_libraries(${name} PRIVATE belvedere_flags ${arg_LINK})
  target_precompile_headers(${name} PRIVATE ${arg_UNPARSED_ARGUMENTS})
endfunction()

# belvedere_batches(target NAME): batches for the target's sources, which read the headers of belvedere_precompiled(NAME …).
# Highway compiles its files several times over by including them again, so they stand alone.
function(belvedere_batches target precompiled)
  if(NOT BELVEDERE_BATCHES)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${precompiled})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  set(rooms "")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} OUTPUT_VARIABLE path)
    cmake_path(IS_PREFIX PROJECT_SOURCE_DIR "${path}" ours)
    if(NOT ours OR NOT EXISTS "${path}")
      continue()
    endif()
    cmake_path(RELATIVE_PATH path BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE name)
    # base/…, terrain/climate/…, tests/terrain/climate/…
    string(REGEX MATCH "^(tests/)?[a-z]+(/[a-z_]+/)?" room "${name}")
    string(MAKE_C_IDENTIFIER "${room}" room)
    file(STRINGS "${path}" alone REGEX "hwy/foreach_target.h" LIMIT_COUNT 1)
    if(alone)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      continue()
    endif()
    list(APPEND rooms ${room})
    list(APPEND ${room} ${source})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    # Batches of one room are of like size, and a file stays in its batch when another room gains one.
    list(SORT ${room})
    list(LENGTH ${room} count)
    math(EXPR batches "(${count} + ${BELVEDERE_BATCH_SIZE} - 1) / ${BELVEDERE_BATCH_SIZE}")
    if(CMAKE_BUILD_TYPE STREQUAL "Release" AND room IN_LIST belvedere_o1_folders)
      math(EXPR last "${batches} - 1")
      foreach(batch RANGE ${last})
        set(unit ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.dir/Unity/unity_${room}_${batch}_cxx.cxx)
        set_source_files_properties(${unit} PROPERTIES COMPILE_OPTIONS -O1)
      endforeach()
    endif()
    set(at 0)
    foreach(source IN LISTS ${room})
      math(EXPR batch "${at} * ${batches} / ${count}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${batch})
      math(EXPR at "${at} + 1")
    endforeach()
  endforeach()
endfunction()
