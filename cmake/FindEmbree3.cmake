# Embree3::Embree3, from its header and library. Debian's own CMake package asks for TBB's, which only a static Embree needs.
find_path(Embree3_INCLUDE_DIR embree3/rtcore.h)
find_library(Embree3_LIBRARY embree3)
mark_as_advanced(Embree3_INCLUDE_DIR Embree3_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Embree3 REQUIRED_VARS Embree3_LIBRARY Embree3_INCLUDE_DIR)

if(Embree3_FOUND AND NOT TARGET Embree3::Embree3)
  add_library(Embree3::Embree3 UNKNOWN IMPORTED)
  set_target_properties(Embree3::Embree3 PROPERTIES
    IMPORTED_LOCATION ${Embree3_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Embree3_INCLUDE_DIR})
endif()
