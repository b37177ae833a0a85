# Installs what is built into a scratch folder, builds this folder's program against that, runs it, and looks at what it wrote.
# cmake -D BUILD=… -D SOURCE=… -D COMPILER=… -D BUILD_TYPE=… -D FLAGS=… -P check.cmake. Nothing of the project is built again.
set(scratch ${BUILD}/consumer)
file(REMOVE_RECURSE ${scratch})
file(MAKE_DIRECTORY ${scratch}/out)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${out}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${scratch}/prefix)

# Of foreign libraries, headers for others may name this one alone.
file(GLOB_RECURSE headers ${scratch}/prefix/include/belvedere/*.h)
foreach(header ${headers})
  file(STRINGS ${header} includes REGEX "^ *# *include <.*[./]")
  foreach(include ${includes})
    if(NOT include MATCHES "<glm/")
      message(FATAL_ERROR "${header}: ${include}: a consumer need not have that library")
    endif()
  endforeach()
endforeach()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${scratch}/build -G Ninja -D CMAKE_PREFIX_PATH=${scratch}/prefix -D CMAKE_CXX_COMPILER=${COMPILER}
    -D CMAKE_BUILD_TYPE=${BUILD_TYPE} -D "CMAKE_CXX_FLAGS=${FLAGS}" -D CMAKE_EXPORT_COMPILE_COMMANDS=ON)
run(${CMAKE_COMMAND} --build ${scratch}/build)

# How the library itself is compiled is nobody else's affair.
file(READ ${scratch}/build/compile_commands.json commands)
foreach(flag -Werror -Wall -march -ffp-contract ${CMAKE_CURRENT_LIST_DIR}/../../base)
  string(FIND "${commands}" "${flag}" at)
  if(NOT at EQUAL -1)
    message(FATAL_ERROR "a consumer is compiled with ${flag}:\n${commands}")
  endif()
endforeach()

run(${scratch}/build/consumer ${scratch}/out)
run(${scratch}/prefix/bin/belvedere info ${scratch}/out/guidance.exr)
foreach(said "96 × 64 pixels" "landcover.id (uint)" "Z (float)" "made_by: consumer")
  string(FIND "${out}" "${said}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "belvedere info does not say \"${said}\":\n${out}")
  endif()
endforeach()
message("${out}")
