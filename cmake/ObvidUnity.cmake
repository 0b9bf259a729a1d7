# SPDX-License-Identifier: Apache-2.0
# Unity builds: the sources of a target are compiled in a few units, so that each header is read a
# few times instead of once for every source. That halves the time of a build from nothing. It is
# why names are unique within a target even in anonymous namespaces (tools/check_names).
#
# CMake's own UNITY_BUILD writes absolute paths into the units, which ccache takes for another
# source when the project lies elsewhere; these have paths relative to the unit.
option(OBVID_UNITY "compile the sources of a target together (OFF: each by itself)" ON)

# obvid_unity(OUT PREFIX BATCH sources...): units for the sources, or the sources themselves.
# BATCH is the number of sources in a unit at most; units are filled evenly and in order.
function(obvid_unity out prefix batch)
  list(LENGTH ARGN count)
  if(NOT OBVID_UNITY OR count LESS 2)
    set(${out} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  if(OBVID_SANITIZE)  # hardly optimised: what is read twice, common headers, is half the time
    math(EXPR batch "2 * ${batch}")
  endif()
  math(EXPR units "(${count} + ${batch} - 1) / ${batch}")
  set(made)
  foreach(unit RANGE 1 ${units})
    math(EXPR first "${count} * (${unit} - 1) / ${units}")
    math(EXPR length "${count} * ${unit} / ${units} - ${first}")
    list(SUBLIST ARGN ${first} ${length} sources)
    set(path "${PROJECT_BINARY_DIR}/unity/${prefix}_${unit}.cpp")
    set(text "// Made by cmake/ObvidUnity.cmake\n")
    foreach(source IN LISTS sources)
      file(RELATIVE_PATH source "${PROJECT_BINARY_DIR}/unity" "${source}")
      string(APPEND text "#include \"${source}\"\n")
    endforeach()
    file(CONFIGURE OUTPUT "${path}" CONTENT "${text}" @ONLY)  # untouched when nothing changed
    list(APPEND made "${path}")
  endforeach()
  set(${out} ${made} PARENT_SCOPE)
endfunction()

# obvid_units(OUT TARGET BATCH LATER sources...): the same for a target, but sources whose path matches
# LATER (when it is not empty) are in units of their own, TARGET_later_1 and so on. The objects of the
# others are noted in the global property OBVID_FIRST_OF_TARGET, for cmake/ObvidFirst.cmake.
function(obvid_units out target batch later)
  set(first ${ARGN})
  set(rest)
  if(NOT later STREQUAL "")
    set(rest ${ARGN})
    list(FILTER first EXCLUDE REGEX "${later}")
    list(FILTER rest INCLUDE REGEX "${later}")
  endif()
  obvid_unity(first ${target} ${batch} ${first})
  obvid_unity(rest ${target}_later ${batch} ${rest})
  foreach(unit IN LISTS first)
    string(REPLACE "${PROJECT_BINARY_DIR}/" "" unit "${unit}")
    string(REPLACE "${PROJECT_SOURCE_DIR}/" "" unit "${unit}")
    set_property(GLOBAL APPEND PROPERTY OBVID_FIRST_OF_${target}
      "${PROJECT_BINARY_DIR}/CMakeFiles/${target}.dir/${unit}${CMAKE_CXX_OUTPUT_EXTENSION}")
  endforeach()
  set(${out} ${first} ${rest} PARENT_SCOPE)
endfunction()
