# SPDX-License-Identifier: Apache-2.0
# obvid-studio: serves the page of web/studio and the engine to a browser on this machine. It talks
# to the engine through the C interface alone. The launcher has it built when it is first needed.

# What the program and its studio agree on, as of the helper for CAD files.
file(GLOB obvid_studio_agreed CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/studio/*")
obvid_digest(obvid_studio_digest ${obvid_studio_agreed} "${PROJECT_SOURCE_DIR}/include/obvid/obvid.h"
             "${PROJECT_SOURCE_DIR}/apps/cli/studio.cpp")
configure_file(cmake/studio_build_mark.h.in "${PROJECT_BINARY_DIR}/generated-private/studio_build_mark.h"
               @ONLY)

find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(httplib QUIET IMPORTED_TARGET cpp-httplib)
endif()
if(NOT TARGET obvid_c OR NOT TARGET PkgConfig::httplib)
  message(STATUS "no studio: cpp-httplib, pkg-config or the C interface is missing")
  return()
endif()
find_package(Threads REQUIRED)
file(GLOB studio_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/studio/*.cpp")
obvid_unity(studio_units obvid_studio ${OBVID_BATCH} ${studio_sources})
add_executable(obvid_studio ${studio_units})
set_target_properties(obvid_studio PROPERTIES
  OUTPUT_NAME obvid-studio RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
  BUILD_RPATH "$ORIGIN" INSTALL_RPATH "$ORIGIN/../../${CMAKE_INSTALL_LIBDIR}")
target_include_directories(obvid_studio PRIVATE "${PROJECT_SOURCE_DIR}/apps/studio" "${PROJECT_SOURCE_DIR}/apps"
                           "${PROJECT_BINARY_DIR}/generated-private")
target_link_libraries(obvid_studio PRIVATE obvid_flags obvid_c fmt::fmt CLI11::CLI11
                      nlohmann_json::nlohmann_json PkgConfig::httplib Threads::Threads)
obvid_for_words(obvid_studio)
install(TARGETS obvid_studio RUNTIME DESTINATION libexec/obvid OPTIONAL)
