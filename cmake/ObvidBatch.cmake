# SPDX-License-Identifier: Apache-2.0
# obvid-batch: one job for many inputs, on all processors. It talks to the engine through the C
# interface. The launcher has it built when it is first needed: the program itself knows neither HDF5
# nor SQLite.

# What the program and its batches agree on, as of the helper for CAD files.
file(GLOB obvid_batch_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/batch/*.cpp")
file(GLOB obvid_batch_agreed CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/batch/*"
     "${PROJECT_SOURCE_DIR}/src/batch/*")
obvid_digest(obvid_batch_digest ${obvid_batch_agreed} "${PROJECT_SOURCE_DIR}/include/obvid/obvid.h"
             "${PROJECT_SOURCE_DIR}/apps/cli/batch.cpp")
configure_file(cmake/batch_build_mark.h.in "${PROJECT_BINARY_DIR}/generated-private/batch_build_mark.h"
               @ONLY)

find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(obvid_batch_needs QUIET IMPORTED_TARGET hdf5 libzip sqlite3)
endif()
if(NOT TARGET obvid_c OR NOT TARGET PkgConfig::obvid_batch_needs)
  message(STATUS "no batches: HDF5, libzip, SQLite, pkg-config or the C interface is missing")
  return()
endif()
find_package(Threads REQUIRED)
obvid_unity(obvid_batch_units obvid_batch_parts ${OBVID_BATCH} ${obvid_batch_sources})
add_library(obvid_batch_parts STATIC ${obvid_batch_units})
target_include_directories(obvid_batch_parts PUBLIC "${PROJECT_SOURCE_DIR}/src/batch")
target_link_libraries(obvid_batch_parts PRIVATE obvid_flags fmt::fmt nlohmann_json::nlohmann_json
                      PUBLIC obvid::exchange obvid_c PkgConfig::obvid_batch_needs Threads::Threads)
obvid_for_words(obvid_batch_parts)

file(GLOB batch_app_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/batch/*.cpp")
obvid_unity(batch_app_units obvid_batch ${OBVID_BATCH} ${batch_app_sources})
add_executable(obvid_batch ${batch_app_units})
set_target_properties(obvid_batch PROPERTIES
  OUTPUT_NAME obvid-batch RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
  BUILD_RPATH "$ORIGIN" INSTALL_RPATH "$ORIGIN/../../${CMAKE_INSTALL_LIBDIR}")
target_include_directories(obvid_batch PRIVATE "${PROJECT_SOURCE_DIR}/apps/batch" "${PROJECT_SOURCE_DIR}/apps"
                           "${PROJECT_BINARY_DIR}/generated-private")
target_link_libraries(obvid_batch PRIVATE obvid_flags obvid_batch_parts fmt::fmt CLI11::CLI11
                      nlohmann_json::nlohmann_json)
obvid_for_words(obvid_batch)
install(TARGETS obvid_batch RUNTIME DESTINATION libexec/obvid OPTIONAL)
