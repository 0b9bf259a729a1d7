# SPDX-License-Identifier: Apache-2.0
# Language, warnings, sanitizers and build helpers for every target of the project.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
if(EMSCRIPTEN)
  set(CMAKE_CXX_FLAGS_RELEASE -DNDEBUG)  # -O2 or -Oz: cmake/ObvidWeb.cmake
endif()
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g")

find_program(OBVID_CCACHE ccache)
if(OBVID_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${OBVID_CCACHE}")
endif()

find_program(OBVID_MOLD mold)
if(OBVID_MOLD AND NOT EMSCRIPTEN)
  add_link_options(-fuse-ld=mold)
endif()

add_library(obvid_flags INTERFACE)
# The same input must give the same bytes in every build, and proofs count every rounding: no fused
# multiply-add. (strict_arithmetic.h says so to compilers that know a pragma for it.)
if(MSVC)
  target_compile_options(obvid_flags INTERFACE /W4 /fp:precise)
else()
  target_compile_options(obvid_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off
    # No other library takes the place of our functions: they may be written into each other.
    -fno-semantic-interposition
    # What is built tells nothing of the machine that built it.
    "-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=" "-ffile-prefix-map=${PROJECT_BINARY_DIR}=build")
  # g++ 12 takes "text" + std::string for overlapping copies once it is inlined (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(obvid_flags INTERFACE -Wno-restrict)
  endif()
endif()
if(OBVID_WERROR)
  target_compile_options(obvid_flags INTERFACE -Werror)
endif()
if(OBVID_SANITIZE)
  # Traces need lines, not variables: a tenth less to compile. The build that fuzzes goes without lines:
  # the functions of a trace name the place, and undefined behaviour is told with its line; another tenth.
  # What no fuzz target feeds need not count its branches for them: a third less to compile
  # (target property OBVID_UNFED).
  string(REPLACE "fuzzer-no-link," "" obvid_sanitizers "${OBVID_SANITIZE}")
  set(obvid_sanitize -fsanitize=${obvid_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_compile_options(obvid_flags INTERFACE ${obvid_sanitize})
  set(obvid_lines -g1)
  if(NOT obvid_sanitizers STREQUAL OBVID_SANITIZE)
    set(obvid_lines -g0)
    target_compile_options(obvid_flags INTERFACE
      $<$<NOT:$<BOOL:$<TARGET_PROPERTY:OBVID_UNFED>>>:-fsanitize=fuzzer-no-link>)
    # A null pointer that is followed ends the program in this build anyway, and no cast moves a pointer
    # off its alignment: their checks at each access are a quarter of the compiler's work. The preset
    # asan-ubsan has them.
    target_compile_options(obvid_flags INTERFACE -fno-sanitize=null,alignment)
  endif()
  target_compile_options(obvid_flags INTERFACE ${obvid_lines})
  target_link_options(obvid_flags INTERFACE -fsanitize=${OBVID_SANITIZE})
  # g++ 12 takes sanitized code of its own standard library for uninitialized.
  target_compile_options(obvid_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
if(OBVID_COVERAGE)
  target_compile_options(obvid_flags INTERFACE --coverage -O0)
  target_link_options(obvid_flags INTERFACE --coverage)
endif()
