# Foreign libraries, each as a target. OpenImageIO's own CMake files name OpenCV's folder and fail, and OpenColorIO has only a
# .pc file, so both come through pkg-config. Headers are SYSTEM: their warnings are not ours.
find_package(PkgConfig REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(TBB REQUIRED)
find_package(GDAL REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
pkg_check_modules(oiio REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(ocio REQUIRED IMPORTED_TARGET OpenColorIO)
pkg_check_modules(lcms REQUIRED IMPORTED_TARGET lcms2)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
find_package(CLI11 REQUIRED)
