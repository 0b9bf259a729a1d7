# SPDX-License-Identifier: Apache-2.0
# obvid_digest, obvid_module, obvid_umbrella, obvid_program: targets made from what lies in the folders.

configure_file("${PROJECT_SOURCE_DIR}/cmake/version.h.in"
               "${PROJECT_BINARY_DIR}/generated/obvid/core/version.h" @ONLY)

# For targets that make texts, not figures: a release build spends a third less time on them.
function(obvid_for_words target)
  if(NOT MSVC AND NOT EMSCRIPTEN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# With sanitizers only what takes most of the time of the tests that run then is optimised: clang compiles
# the rest in half the time.
set(OBVID_OPTIMISED_WHEN_SANITIZED obvid_numeric obvid_curve obvid_region obvid_chain obvid_fairing obvid_certify)
# Modules whose code fuzz targets reach hardly or not at all.
set(OBVID_UNFED_BY_FUZZERS obvid_alignment obvid_cutting obvid_picture obvid_pipeline obvid_surface_builders
    obvid_surface_cut obvid_toolpath obvid_cli)
function(obvid_for_sanitizers target)
  if(OBVID_SANITIZE AND NOT target IN_LIST OBVID_OPTIMISED_WHEN_SANITIZED)
    target_compile_options(${target} PRIVATE -O0)
  endif()
  if(target IN_LIST OBVID_UNFED_BY_FUZZERS)
    set_target_properties(${target} PROPERTIES OBVID_UNFED ON)
  endif()
endfunction()

# obvid_digest(variable file...): one digest of their contents, made anew when one of them changes.
function(obvid_digest variable)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
  set(digests "")
  foreach(source IN LISTS ARGN)
    file(SHA256 "${source}" digest)
    string(APPEND digests "${digest}\n")
  endforeach()
  string(SHA256 digest "${digests}")
  set(${variable} "${digest}" PARENT_SCOPE)
endfunction()

# obvid_module(NAME x [FOLDER src-folder] [DEPENDS module...] [LIBRARIES target...]
#              [PRIVATE_HEADERS_OF target...] [BATCH number] [LATER regex] [WORDS])
# Target obvid_x with alias obvid::x from all src/<folder>/**.cpp. A module without sources is a
# header-only one. LIBRARIES appear in its public headers, PRIVATE_HEADERS_OF only in its sources.
# BATCH: sources that are compiled together. LATER: sources that the launcher's first program goes
# without (cmake/ObvidFirst.cmake). WORDS: they make texts, not figures, and are compiled
# for a short build (obvid_for_words).
set(OBVID_BATCH 16)
function(obvid_module)
  cmake_parse_arguments(M "WORDS" "NAME;FOLDER;BATCH;LATER" "DEPENDS;LIBRARIES;PRIVATE_HEADERS_OF" ${ARGN})
  if(NOT M_FOLDER)
    set(M_FOLDER ${M_NAME})
  endif()
  if(NOT M_BATCH)
    set(M_BATCH ${OBVID_BATCH})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/${M_FOLDER}/*.cpp")
  if(EMSCRIPTEN)
    list(FILTER sources EXCLUDE REGEX "/(helper_file|helper_process|named_builder|part_program)\\.cpp$")  # apps/web has others
  endif()
  set(target obvid_${M_NAME})
  if(sources)
    obvid_units(units ${target} ${M_BATCH} "${M_LATER}" ${sources})
    add_library(${target} STATIC ${units})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE fmt::fmt $<BUILD_INTERFACE:obvid_flags>)
    target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/src/${M_FOLDER}")
    foreach(library IN LISTS M_PRIVATE_HEADERS_OF)
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${library}>)
    endforeach()
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    if(EMSCRIPTEN)  # where a page is loaded, size is time
      set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    endif()
    if(M_WORDS)
      obvid_for_words(${target})
    endif()
    obvid_for_sanitizers(${target})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} ${scope} cxx_std_20)
  target_link_libraries(${target} ${scope} tl::expected ${M_LIBRARIES})
  foreach(dependency IN LISTS M_DEPENDS)
    target_link_libraries(${target} ${scope} obvid::${dependency})
  endforeach()
  add_library(obvid::${M_NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${M_NAME})
  set_property(GLOBAL APPEND PROPERTY OBVID_MODULES ${M_NAME})
endfunction()

# obvid::obvid is every module at once.
function(obvid_umbrella)
  get_property(modules GLOBAL PROPERTY OBVID_MODULES)
  add_library(obvid_all INTERFACE)
  list(TRANSFORM modules PREPEND obvid:: OUTPUT_VARIABLE targets)
  target_link_libraries(obvid_all INTERFACE ${targets})
  add_library(obvid::obvid ALIAS obvid_all)
  set_target_properties(obvid_all PROPERTIES EXPORT_NAME obvid)
endfunction()

# obvid_program(NAME x FOLDER dir [LATER regex] DEPENDS module...): the program x in the build folder itself.
function(obvid_program)
  cmake_parse_arguments(P "" "NAME;FOLDER;LATER" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${P_FOLDER}/*.cpp")
  if(NOT sources)
    message(STATUS "no sources in ${P_FOLDER}: program ${P_NAME} left out")
    return()
  endif()
  obvid_units(units ${P_NAME}_cli ${OBVID_BATCH} "${P_LATER}" ${sources})
  add_executable(${P_NAME}_cli ${units})
  set_target_properties(${P_NAME}_cli PROPERTIES
    OUTPUT_NAME ${P_NAME} RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
  target_include_directories(${P_NAME}_cli PRIVATE "${PROJECT_SOURCE_DIR}/${P_FOLDER}"
                             "${PROJECT_SOURCE_DIR}/apps")
  target_link_libraries(${P_NAME}_cli PRIVATE obvid_flags fmt::fmt CLI11::CLI11
                        nlohmann_json::nlohmann_json)
  foreach(dependency IN LISTS P_DEPENDS)
    target_link_libraries(${P_NAME}_cli PRIVATE obvid::${dependency})
  endforeach()
  obvid_for_words(${P_NAME}_cli)
  obvid_for_sanitizers(${P_NAME}_cli)
  install(TARGETS ${P_NAME}_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()
