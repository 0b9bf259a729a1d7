# SPDX-License-Identifier: Apache-2.0
# Libraries of other people for WebAssembly: the headers of Debian's packages, each linked into a
# folder of its own, because the headers of this machine's C library lie beside them. pugixml has a
# compiled part: OBVID_PUGIXML is the folder of its sources (tools/build_web brings them).
set(OBVID_PUGIXML "" CACHE PATH "folder with pugixml.hpp and pugixml.cpp")
if(NOT EXISTS "${OBVID_PUGIXML}/pugixml.cpp")
  message(FATAL_ERROR "OBVID_PUGIXML names no folder with pugixml.cpp; tools/build_web finds one")
endif()

# obvid_foreign(TARGET path/of/header): an imported target with the headers below the first folder.
function(obvid_foreign target header)
  string(REGEX REPLACE "/.*" "" top "${header}")
  string(MAKE_C_IDENTIFIER "OBVID_${top}" variable)
  find_path(${variable} "${header}" PATHS /usr/include /usr/local/include
            NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  set(folder "${PROJECT_BINARY_DIR}/foreign/${top}")
  file(MAKE_DIRECTORY "${folder}")
  file(CREATE_LINK "${${variable}}/${top}" "${folder}/${top}" SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE "${folder}")
endfunction()

# Exceptions of WebAssembly itself: without them a throw of a library ends the engine.
add_compile_options(-fwasm-exceptions -include "${PROJECT_SOURCE_DIR}/apps/web/libcxx_13.h"
                    -isystem "${PROJECT_BINARY_DIR}/foreign/fast_float")
add_link_options(-fwasm-exceptions)

obvid_foreign(tl::expected tl/expected.hpp)
obvid_foreign(fmt::fmt fmt/format.h)
obvid_foreign(Boost::headers boost/version.hpp)
obvid_foreign(nlohmann_json::nlohmann_json nlohmann/json.hpp)
obvid_foreign(FastFloat::fast_float fast_float/fast_float.h)
add_library(pugixml STATIC "${OBVID_PUGIXML}/pugixml.cpp")
target_include_directories(pugixml SYSTEM PUBLIC "${OBVID_PUGIXML}")
add_library(pugixml::pugixml ALIAS pugixml)
