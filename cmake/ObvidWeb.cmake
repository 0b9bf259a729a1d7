# SPDX-License-Identifier: Apache-2.0
# obvid_web: the engine of the studio's page as WebAssembly (docs/studio.md); tools/build_web makes it.
file(GLOB web_sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/apps/web/*.cpp"
     "${PROJECT_SOURCE_DIR}/src/capi/*.cpp")
add_executable(obvid_web ${web_sources} "${PROJECT_SOURCE_DIR}/apps/studio/engine.cpp")
target_include_directories(obvid_web PRIVATE "${PROJECT_SOURCE_DIR}/apps/studio"
  "${PROJECT_SOURCE_DIR}/src/capi" "${PROJECT_SOURCE_DIR}/src/cad/client")
target_link_libraries(obvid_web PRIVATE obvid_flags obvid::pipeline fmt::fmt
                      nlohmann_json::nlohmann_json pugixml::pugixml)
target_link_options(obvid_web PRIVATE
  --no-entry -sMODULARIZE -sEXPORT_NAME=createEngine -sENVIRONMENT=worker -sFILESYSTEM=0
  -sALLOW_MEMORY_GROWTH -sMAXIMUM_MEMORY=4GB -sTOTAL_STACK=8MB
  -sEXPORTED_FUNCTIONS=_obvid_web_answer,_malloc,_free
  -sEXPORTED_RUNTIME_METHODS=UTF8ToString)
# What a drag waits for is fast, all else is small. Each gets one level alone: clang 14 makes large,
# slow code of -Oz with -O2 behind it.
set(fast core curve series region chain contour_spirals)
set(usual fairing certify pipeline)
get_property(modules GLOBAL PROPERTY OBVID_MODULES)
foreach(module IN LISTS modules ITEMS web)
  get_target_property(kind obvid_${module} TYPE)
  if(module IN_LIST fast)
    target_compile_options(obvid_${module} PRIVATE -O2)
  elseif(module IN_LIST usual)
    target_compile_options(obvid_${module} PRIVATE -Os)
  elseif(NOT kind STREQUAL INTERFACE_LIBRARY)
    target_compile_options(obvid_${module} PRIVATE -Oz)
  endif()
endforeach()
target_compile_options(pugixml PRIVATE -Oz)
target_link_options(obvid_web PRIVATE -O2)
