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

# obvid_units(OUT PREFIX BATCH LATER sources...): the same, but sources whose path matches LATER (when it
# is not empty) are in units of their own, PREFIX_later_1 and so on: cmake/ObvidFirst.cmake.
function(obvid_units out prefix batch later)
  set(first ${ARGN})
  set(rest)
  if(NOT later STREQUAL "")
    set(rest ${ARGN})
    list(FILTER first EXCLUDE REGEX "${later}")
    list(FILTER rest INCLUDE REGEX "${later}")
  endif()
  obvid_unity(first ${prefix} ${batch} ${first})
  obvid_unity(rest ${prefix}_later ${batch} ${rest})
  set(${out} ${first} ${rest} PARENT_SCOPE)
endfunction()
