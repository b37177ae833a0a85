# What `cmake --install` puts where: the program with manual page and completion (component "program"), the libraries, their headers and
# the package that find_package(belvedere) reads ("development").
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# ---- the program

set(share ${CMAKE_BINARY_DIR}/share)
set(made man.1 completion.bash completion.fish completion.zsh)
list(TRANSFORM made PREPEND ${share}/)
add_custom_command(
  OUTPUT ${made}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${share}
  COMMAND belvedere man > ${share}/man.1
  COMMAND belvedere completion bash > ${share}/completion.bash
  COMMAND belvedere completion fish > ${share}/completion.fish
  COMMAND belvedere completion zsh > ${share}/completion.zsh
  DEPENDS belvedere
  COMMENT "Writing the manual page and completion")
add_custom_target(belvedere_share ALL DEPENDS ${made})

install(TARGETS belvedere RUNTIME COMPONENT program)
install(FILES ${share}/man.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME belvedere.1 COMPONENT program)
install(FILES ${share}/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME belvedere COMPONENT program)
install(FILES ${share}/completion.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME belvedere.fish COMPONENT program)
install(FILES ${share}/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions RENAME _belvedere COMPONENT program)
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/belvedere COMPONENT program FILES_MATCHING PATTERN "*.toml" PATTERN "*.csv" PATTERN "*.geojson" REGEX "/masks/[^/]*[.]png$")
install(FILES docs/scene.md docs/scene.schema.json README.md CHANGELOG.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright COMPONENT program)
# The fonts of the built-in style of names, with their licences (SIL Open Font License): found beside the program on any machine.
set(garamond 08-Regular 08-Italic 12-Regular 12-Italic)
list(TRANSFORM garamond REPLACE "(.+)" "/usr/share/fonts/opentype/ebgaramond/EBGaramond\\1.otf")
set(lato Regular Italic Medium Semibold Bold)
list(TRANSFORM lato REPLACE "(.+)" "/usr/share/fonts/truetype/lato/Lato-\\1.ttf")
set(fonts_folder ${CMAKE_INSTALL_DATADIR}/belvedere/fonts)
install(FILES ${garamond} ${lato} DESTINATION ${fonts_folder} COMPONENT program)
install(FILES /usr/share/doc/fonts-ebgaramond/copyright DESTINATION ${fonts_folder} RENAME LICENCE-EBGaramond COMPONENT program)
install(FILES /usr/share/doc/fonts-lato/copyright DESTINATION ${fonts_folder} RENAME LICENCE-Lato COMPONENT program)

# ---- the libraries

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/belvedere)
install(TARGETS belvedere_base belvedere_terrain belvedere_texture belvedere_renderer EXPORT belvedere ARCHIVE COMPONENT development)
install(EXPORT belvedere NAMESPACE belvedere:: FILE belvedereTargets.cmake DESTINATION ${package_folder} COMPONENT development)
# As in the project: #include "terrain/io/dem.h". A folder's headers for itself alone are not among them.
install(DIRECTORY base terrain texture renderer DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/belvedere COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN gdal_files.h EXCLUDE PATTERN embree.h EXCLUDE PATTERN raster_open.h EXCLUDE PATTERN vector_layers.h EXCLUDE PATTERN lcms.h EXCLUDE)
configure_package_config_file(cmake/belvedereConfig.cmake.in belvedereConfig.cmake INSTALL_DESTINATION ${package_folder})
# Until 1.0 every minor version may change interfaces.
write_basic_package_version_file(belvedereConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/belvedere-dev RENAME copyright COMPONENT development)
install(FILES ${CMAKE_BINARY_DIR}/belvedereConfig.cmake ${CMAKE_BINARY_DIR}/belvedereConfigVersion.cmake cmake/libraries.cmake
  DESTINATION ${package_folder} COMPONENT development)
