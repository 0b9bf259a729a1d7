# SPDX-License-Identifier: Apache-2.0
# Libraries of other people, all from Debian's packages (tools/packages names them).
# Imported targets are SYSTEM: their warnings are not ours.
find_package(tl-expected REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(Boost 1.74 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(FastFloat REQUIRED)
if(OBVID_BUILD_APPS)
  find_package(CLI11 2 REQUIRED)
endif()
if(OBVID_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()
if(OBVID_BUILD_BENCHES)
  find_package(benchmark REQUIRED)
endif()
