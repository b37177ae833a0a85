# `cpack -G DEB` in a build folder: the program, its manual page, completion and scenes as one Debian package. See tools/package.
set(CPACK_PACKAGE_NAME belvedere)
set(CPACK_PACKAGE_VENDOR "Belvedere")
set(CPACK_PACKAGE_CONTACT "The authors of Belvedere <belvedere@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "renders panorama maps in the look of a painting")
set(CPACK_PACKAGE_DESCRIPTION "Belvedere paints panorama maps: from an elevation model, a land-cover map and a painting\nit makes the panorama of a region in the hand of that painting, at print size.\n`belvedere render` renders a demo that needs no data.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# What the program links, by name and version, is asked of the machine it was built on.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# It is loaded at its first call.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libopenimageio2.4")
include(CPack)
