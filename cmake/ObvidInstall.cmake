# SPDX-License-Identifier: Apache-2.0
# What `find_package(obvid)` finds: obvid::<module> for each module, obvid::obvid for all.
include(CMakePackageConfigHelpers)

get_property(obvid_modules GLOBAL PROPERTY OBVID_MODULES)
list(TRANSFORM obvid_modules PREPEND obvid_ OUTPUT_VARIABLE obvid_targets)
install(TARGETS ${obvid_targets} obvid_all EXPORT obvidTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

set(obvid_config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/obvid")
install(EXPORT obvidTargets NAMESPACE obvid:: DESTINATION ${obvid_config_dir})
# Headers below internal/ are for this project alone. Those of the proofs: a copy compiled with other options
# must not exist.
install(DIRECTORY include/obvid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*.inc" PATTERN "internal" EXCLUDE)
install(DIRECTORY "${PROJECT_BINARY_DIR}/generated/obvid" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

install(FILES LICENSE NOTICE SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(cmake/obvidConfig.cmake.in "${PROJECT_BINARY_DIR}/obvidConfig.cmake"
                              INSTALL_DESTINATION ${obvid_config_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/obvidConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/obvidConfig.cmake"
              "${PROJECT_BINARY_DIR}/obvidConfigVersion.cmake"
        DESTINATION ${obvid_config_dir})
