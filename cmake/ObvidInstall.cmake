# SPDX-License-Identifier: Apache-2.0
# What `find_package(obvid)` finds: obvid::<module> for each module, obvid::obvid for all.
include(CMakePackageConfigHelpers)

get_property(obvid_modules GLOBAL PROPERTY OBVID_MODULES)
list(TRANSFORM obvid_modules PREPEND obvid_ OUTPUT_VARIABLE obvid_targets)
install(TARGETS ${obvid_targets} obvid_all EXPORT obvidTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

set(obvid_config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/obvid")
install(EXPORT obvidTargets NAMESPACE obvid:: DESTINATION ${obvid_config_dir})
# Public are the headers that do not lie below internal/ (and the families of contours, which carry
# what pipeline forms). What they include is installed with them and promises nothing; no other
# header of internal/ is, the proofs' least of all: a copy compiled with other options must not exist.
file(GLOB_RECURSE headers_left CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include"
     "${PROJECT_SOURCE_DIR}/include/obvid/*.h")
list(FILTER headers_left EXCLUDE REGEX "/internal/|^obvid/contour/")
set(headers_installed)
while(headers_left)
  list(POP_FRONT headers_left header)
  list(APPEND headers_installed ${header})
  file(STRINGS "include/${header}" includes REGEX "^#include \"obvid/")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" include "${include}")
    if(EXISTS "${PROJECT_SOURCE_DIR}/include/${include}" AND NOT include IN_LIST headers_left
       AND NOT include IN_LIST headers_installed)
      list(APPEND headers_left ${include})
    endif()
  endforeach()
endwhile()
foreach(header IN LISTS headers_installed)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES "include/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}")
endforeach()
install(DIRECTORY "${PROJECT_BINARY_DIR}/generated/obvid" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

install(FILES LICENSE NOTICE SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/obvidConfig.cmake.in "${PROJECT_BINARY_DIR}/obvidConfig.cmake"
                              INSTALL_DESTINATION ${obvid_config_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/obvidConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/obvidConfig.cmake"
              "${PROJECT_BINARY_DIR}/obvidConfigVersion.cmake"
        DESTINATION ${obvid_config_dir})
