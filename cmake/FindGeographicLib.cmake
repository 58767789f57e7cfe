# GeographicLib 2 as Debian packages it: a shared library and headers, and a find module of its own that CMake does not
# look for. Provides GeographicLib::GeographicLib.
find_path(GeographicLib_INCLUDE_DIR NAMES GeographicLib/Geodesic.hpp)
find_library(GeographicLib_LIBRARY NAMES GeographicLib)
if(GeographicLib_INCLUDE_DIR)
  file(STRINGS "${GeographicLib_INCLUDE_DIR}/GeographicLib/Config.h" geographiclib_version_line
       REGEX "#define GEOGRAPHICLIB_VERSION_STRING ")
  string(REGEX MATCH "[0-9.]+" GeographicLib_VERSION "${geographiclib_version_line}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(GeographicLib REQUIRED_VARS GeographicLib_LIBRARY GeographicLib_INCLUDE_DIR
                                  VERSION_VAR GeographicLib_VERSION)
if(GeographicLib_FOUND AND NOT TARGET GeographicLib::GeographicLib)
  add_library(GeographicLib::GeographicLib UNKNOWN IMPORTED)
  set_target_properties(GeographicLib::GeographicLib PROPERTIES IMPORTED_LOCATION "${GeographicLib_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${GeographicLib_INCLUDE_DIR}")
endif()
