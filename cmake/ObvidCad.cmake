# SPDX-License-Identifier: Apache-2.0
# The plugin obvid_cad.so: formats that need Open CASCADE. The program loads it on demand.
option(OBVID_CAD "build the plugin for STEP, IGES and BREP (needs Open CASCADE)" ON)

obvid_module(NAME cad FOLDER cad/loader DEPENDS curve surface exchange)
target_link_libraries(obvid_cad PUBLIC ${CMAKE_DL_LIBS})

if(OBVID_CAD AND NOT OBVID_SANITIZE)
  find_package(OpenCASCADE QUIET)
endif()
if(NOT OpenCASCADE_FOUND)
  message(STATUS "no plugin for STEP, IGES and BREP: Open CASCADE is missing or not wanted")
  return()
endif()
file(GLOB plugin_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/cad/plugin/*.cpp")
obvid_unity(plugin_units obvid_cad_plugin ${OBVID_BATCH} ${plugin_sources})
add_library(obvid_cad_plugin MODULE ${plugin_units})
set_target_properties(obvid_cad_plugin PROPERTIES
  PREFIX "" OUTPUT_NAME obvid_cad LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
  CXX_VISIBILITY_PRESET hidden)
target_include_directories(obvid_cad_plugin PRIVATE "${PROJECT_SOURCE_DIR}/src/cad/plugin")
target_include_directories(obvid_cad_plugin SYSTEM PRIVATE ${OpenCASCADE_INCLUDE_DIR})
target_link_libraries(obvid_cad_plugin PRIVATE obvid_flags fmt::fmt obvid::curve obvid::surface obvid::exchange
                      TKSTEP TKIGES TKShHealing TKPrim TKBRep TKGeomBase TKTopAlgo TKXSBase TKG3d TKMath TKernel)
# where the loader looks, seen from bin, whatever the system calls its folder of libraries
install(TARGETS obvid_cad_plugin LIBRARY DESTINATION lib/obvid)
