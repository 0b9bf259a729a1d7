# SPDX-License-Identifier: Apache-2.0
# obvid-first: what the launcher builds before anything else, `fit` and `analyse` of points, with
# contour files and pictures. It is made of the same objects as the whole program, without those of
# the sources that modules call LATER; apps/first goes on in the whole program where one is needed.
if(NOT OBVID_UNITY OR OBVID_SANITIZE OR OBVID_COVERAGE OR NOT CMAKE_GENERATOR STREQUAL "Ninja")
  return()
endif()
set(first_objects)
foreach(target IN ITEMS core curve series region chain fairing certify contour_common contour_spirals contour_arcs
                        contour_clothoids contour_bsplines contour_conics contour_beziers picture io pipeline cli)
  get_property(objects GLOBAL PROPERTY OBVID_FIRST_OF_obvid_${target})
  list(APPEND first_objects ${objects})
endforeach()
# By their names: objects of a target would bring the whole target with them.
set_source_files_properties(${first_objects} PROPERTIES GENERATED TRUE EXTERNAL_OBJECT TRUE)
file(GLOB first_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/first/*.cpp")
obvid_unity(first_units obvid_first ${OBVID_BATCH} ${first_sources})
add_executable(obvid_first ${first_units} "${obvid_style_texts}" ${first_objects})
set_target_properties(obvid_first PROPERTIES
  OUTPUT_NAME obvid-first RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
target_include_directories(obvid_first PRIVATE "${PROJECT_SOURCE_DIR}/apps/first" "${PROJECT_SOURCE_DIR}/src/pipeline"
  "${PROJECT_SOURCE_DIR}/apps/cli" "${PROJECT_SOURCE_DIR}/include" "${PROJECT_BINARY_DIR}/generated")
target_link_libraries(obvid_first PRIVATE obvid_flags fmt::fmt tl::expected)
obvid_for_words(obvid_first)
