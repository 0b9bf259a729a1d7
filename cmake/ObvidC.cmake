# SPDX-License-Identifier: Apache-2.0
# libobvid_c.so, the C interface (include/obvid/obvid.h, docs/c.md): one file that needs the C
# library and nothing else.
option(OBVID_C "build the C interface libobvid_c" ON)
if(NOT OBVID_C OR MSVC OR OBVID_SANITIZE)
  return() # a file that needs the C library alone cannot carry a sanitizer's runtime
endif()
file(GLOB obvid_c_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/capi/*.cpp")
list(REMOVE_ITEM obvid_c_sources "${PROJECT_SOURCE_DIR}/src/capi/fmt_parts.cpp")
obvid_unity(obvid_c_units obvid_c ${OBVID_BATCH} ${obvid_c_sources})
add_library(obvid_c SHARED ${obvid_c_units} "${PROJECT_SOURCE_DIR}/src/capi/fmt_parts.cpp")
target_compile_definitions(obvid_c PRIVATE OBVID_BUILDING)
target_compile_options(obvid_c PRIVATE -fvisibility=hidden)
target_include_directories(obvid_c PRIVATE "${PROJECT_SOURCE_DIR}/src/capi"
                           INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                     $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(obvid_c PRIVATE obvid_flags nlohmann_json::nlohmann_json)
obvid_for_words(obvid_c)
if(TARGET pugixml::static)  # before the shared one, which then is not needed
  target_link_libraries(obvid_c PRIVATE pugixml::static)
endif()
target_link_libraries(obvid_c PRIVATE obvid::pipeline)
# The linker leaves out what nothing refers to: fmt is compiled in, the kernel is not linked, and inline functions
# that no exported one reaches are a twentieth of the file.
target_link_options(obvid_c PRIVATE -static-libstdc++ -static-libgcc -Wl,--as-needed -Wl,--gc-sections
  "-Wl,--version-script=${PROJECT_SOURCE_DIR}/src/capi/exports.map" -Wl,--no-undefined)
set_target_properties(obvid_c PROPERTIES
  LINK_DEPENDS "${PROJECT_SOURCE_DIR}/src/capi/exports.map"
  EXPORT_NAME c  # obvid::c
  LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}" VERSION ${PROJECT_VERSION} SOVERSION 1)
# Where it was built: who builds the program alone installs that.
install(TARGETS obvid_c EXPORT obvidCTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} OPTIONAL)
install(EXPORT obvidCTargets NAMESPACE obvid:: DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/obvid")
configure_file(cmake/obvid_c.pc.in "${PROJECT_BINARY_DIR}/obvid_c.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/obvid_c.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
