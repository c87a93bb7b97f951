# OpenImageIO::OpenImageIO, from its headers and libraries. Debian's own CMake package refuses to load without
# OpenImageIO's programs, which bring Qt, and names headers of OpenCV's that need not be there.
find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_path(OpenImageIO_IMATH_INCLUDE_DIR ImathConfig.h PATH_SUFFIXES Imath)  # OpenImageIO's headers include Imath's.
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_UTIL_LIBRARY OpenImageIO_Util)
mark_as_advanced(OpenImageIO_INCLUDE_DIR OpenImageIO_IMATH_INCLUDE_DIR OpenImageIO_LIBRARY OpenImageIO_UTIL_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenImageIO
  REQUIRED_VARS OpenImageIO_LIBRARY OpenImageIO_UTIL_LIBRARY OpenImageIO_INCLUDE_DIR OpenImageIO_IMATH_INCLUDE_DIR)

if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
    IMPORTED_LOCATION ${OpenImageIO_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR};${OpenImageIO_IMATH_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES ${OpenImageIO_UTIL_LIBRARY})
endif()
