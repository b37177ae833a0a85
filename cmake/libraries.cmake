# Foreign libraries, each as a target. OpenImageIO's own CMake files name OpenCV's folder and fail, and OpenColorIO has only a
# .pc file, so both come through pkg-config. Headers are SYSTEM: their warnings are not ours.
# The installed package reads this list too, with CMake's find_dependency; within the project everything must be there.
if(NOT COMMAND find_dependency)
  macro(find_dependency)
    find_package(${ARGN} REQUIRED)
  endmacro()
endif()
find_dependency(PkgConfig)
# Of Debian 13, else of Debian 12.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_dependency(embree 3.13)
endif()
find_dependency(TBB)
find_dependency(GDAL)
find_dependency(fmt)
find_dependency(glm)
pkg_check_modules(oiio REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(tiff REQUIRED IMPORTED_TARGET libtiff-4)
pkg_check_modules(png REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(deflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(jxl REQUIRED IMPORTED_TARGET libjxl)
pkg_check_modules(ocio REQUIRED IMPORTED_TARGET OpenColorIO)
pkg_check_modules(lcms REQUIRED IMPORTED_TARGET lcms2)
pkg_check_modules(pango REQUIRED IMPORTED_TARGET pangocairo fontconfig)
pkg_check_modules(glib REQUIRED IMPORTED_TARGET glib-2.0) # below Pango; forms of letters
pkg_check_modules(qpdf REQUIRED IMPORTED_TARGET libqpdf)
pkg_check_modules(rsvg REQUIRED IMPORTED_TARGET librsvg-2.0 cairo-pdf)
pkg_check_modules(lbfgs REQUIRED IMPORTED_TARGET liblbfgs)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
# Vector code for several instruction sets, chosen when the program starts.
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
