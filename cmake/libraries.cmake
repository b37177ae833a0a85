# Foreign libraries, each as a target. OpenImageIO's own CMake files name OpenCV's folder and fail, and OpenColorIO has only a
# .pc file, so both come through pkg-config. Headers are SYSTEM: their warnings are not ours.
# The installed package reads this list too, with CMake's find_dependency; within the project everything must be there.
if(NOT COMMAND find_dependency)
  macro(find_dependency)
    find_package(${ARGN} REQUIRED)
  endmacro()
endif()
find_dependency(PkgConfig)
find_dependency(embree 3.13)
find_dependency(TBB)
find_dependency(GDAL)
find_dependency(fmt)
find_dependency(glm)
pkg_check_modules(oiio REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(openexr REQUIRED IMPORTED_TARGET OpenEXR)
pkg_check_modules(tiff REQUIRED IMPORTED_TARGET libtiff-4)
pkg_check_modules(png REQUIRED IMPORTED_TARGET libpng)
pkg_check_modules(deflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(ocio REQUIRED IMPORTED_TARGET OpenColorIO)
pkg_check_modules(lcms REQUIRED IMPORTED_TARGET lcms2)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
# Vector code for several instruction sets, chosen when the program starts.
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
