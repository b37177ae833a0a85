# `cpack -G DEB` in a build folder: Debian packages of the program, of the libraries with their headers, and, where it is built, of the Python
# module. See tools/package.
set(CPACK_PACKAGE_NAME belvedere)
set(CPACK_PACKAGE_VENDOR "Belvedere")
set(CPACK_PACKAGE_CONTACT "The authors of Belvedere <belvedere@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "renders panorama maps in the look of a painting")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
if(BELVEDERE_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Not those of the person who packages.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
# What the program links, by name and version, is asked of the machine it was built on.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME belvedere)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Belvedere paints panorama maps: from an elevation model, a land-cover map and a painting\nit makes the panorama of a region in the hand of that painting, at print size.\n`belvedere render` renders a demo that needs no data.")
# Of this version it is loaded at its first call, not linked: renderer/CMakeLists.txt.
if(oiio_VERSION MATCHES "^2\\.4\\.")
  set(late libopenimageio2.4)
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS ${late})

# Programs that link the static libraries need what these were built with.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/setup)
file(READ tools/setup setup)
string(REGEX MATCH "\nrun=\\([^)]*\\)" setup "${setup}")
string(REGEX MATCHALL "lib[a-z0-9.+-]+-dev" built_with "${setup}")
list(JOIN built_with ", " built_with)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME belvedere-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "Headers, static libraries and the CMake package, for programs: find_package(belvedere).")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "pkg-config, ${built_with}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-belvedere)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "The same renderer as a module for scripts: import belvedere.")
# A module is for one version of Python.
if(BELVEDERE_PYTHON)
  execute_process(COMMAND /usr/bin/python3 -c "import sys; print('python3 (>= %d.%d), python3 (<< %d.%d)' % (*sys.version_info[:2], sys.version_info[0], sys.version_info[1] + 1))"
    OUTPUT_VARIABLE of_python OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${of_python}, python3-numpy, fonts-ebgaramond, fonts-lato")
  if(late)
    string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", ${late}")
  endif()
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-tqdm)
endif()
include(CPack)
