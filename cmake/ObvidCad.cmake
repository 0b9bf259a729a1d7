# SPDX-License-Identifier: Apache-2.0
# The helper program obvid-cad: formats that need Open CASCADE. The program starts it on demand.
option(OBVID_CAD "build the helper for STEP, IGES and BREP (needs Open CASCADE)" ON)

# What both programs agree on: the program starts only a helper that was built from the same.
file(GLOB obvid_cad_agreed CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/cad/client/*"
     "${PROJECT_SOURCE_DIR}/src/cad/helper/*")
obvid_digest(obvid_cad_digest ${obvid_cad_agreed} "${PROJECT_SOURCE_DIR}/include/obvid/cad/internal/cad.h"
             "${PROJECT_SOURCE_DIR}/include/obvid/core/error.h"
             "${PROJECT_SOURCE_DIR}/include/obvid/exchange/internal/cad_curve.h"
             "${PROJECT_SOURCE_DIR}/include/obvid/core/units.h")
configure_file(cmake/cad_build_mark.h.in "${PROJECT_BINARY_DIR}/generated-private/cad_build_mark.h" @ONLY)

obvid_module(NAME cad FOLDER cad/client DEPENDS surface exchange)
target_include_directories(obvid_cad PRIVATE "${PROJECT_BINARY_DIR}/generated-private")

if(OBVID_CAD AND NOT OBVID_SANITIZE)
  find_package(OpenCASCADE QUIET)
endif()
if(NOT OpenCASCADE_FOUND)
  message(STATUS "no helper for STEP, IGES and BREP: Open CASCADE is missing or not wanted")
  return()
endif()
find_package(Threads REQUIRED)
file(GLOB helper_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/cad/helper/*.cpp")
obvid_unity(helper_units obvid_cad_helper ${OBVID_BATCH} ${helper_sources})
add_executable(obvid_cad_helper ${helper_units})
set_target_properties(obvid_cad_helper PROPERTIES
  OUTPUT_NAME obvid-cad RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
target_include_directories(obvid_cad_helper PRIVATE "${PROJECT_SOURCE_DIR}/src/cad/client"
                           "${PROJECT_SOURCE_DIR}/src/cad/helper"
                           "${PROJECT_BINARY_DIR}/generated-private")
target_include_directories(obvid_cad_helper SYSTEM PRIVATE ${OpenCASCADE_INCLUDE_DIR})
target_link_libraries(obvid_cad_helper PRIVATE obvid_flags fmt::fmt obvid::cad Threads::Threads
                      TKSTEP TKIGES TKShHealing TKPrim TKBRep TKGeomBase TKTopAlgo TKXSBase TKG3d TKMath TKernel)
obvid_for_words(obvid_cad_helper)
# where the program looks, seen from bin, whatever the system calls its folders
install(TARGETS obvid_cad_helper RUNTIME DESTINATION libexec/obvid)
