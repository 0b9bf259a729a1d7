# SPDX-License-Identifier: Apache-2.0
# What packages hold beside programs and libraries, and how cpack makes them (tools/make_packages):
# man pages and completions, the page of the studio, the Python package, the workbench of FreeCAD.
if(NOT TARGET obvid_cli OR OBVID_SANITIZE OR OBVID_COVERAGE)
  return()
endif()
set(OBVID_PYTHON_DIR "lib/python3/dist-packages" CACHE STRING
    "where the Python package is installed, seen from the prefix")
set(OBVID_FREECAD_DIR "share/freecad/Mod/Obvid" CACHE STRING
    "where the workbench of FreeCAD is installed, seen from the prefix")
set(OBVID_ZSH_DIR "share/zsh/site-functions" CACHE STRING
    "where the completion of zsh is installed, seen from the prefix")

# Man pages and completions, of what the built programs say about themselves.
find_package(Python3 QUIET COMPONENTS Interpreter)
if(Python3_FOUND)
  set(manuals "${PROJECT_BINARY_DIR}/manuals")
  set(told_by obvid_cli)
  foreach(part IN ITEMS obvid_batch obvid_studio)
    if(TARGET ${part})
      list(APPEND told_by ${part})
    endif()
  endforeach()
  add_custom_command(OUTPUT "${manuals}/made"
    COMMAND Python3::Interpreter -B "${PROJECT_SOURCE_DIR}/tools/make_manuals" $<TARGET_FILE:obvid_cli> "${manuals}"
    COMMAND ${CMAKE_COMMAND} -E touch "${manuals}/made"
    DEPENDS tools/make_manuals ${told_by} VERBATIM COMMENT "man pages and completions")
  add_custom_target(obvid_manuals ALL DEPENDS "${manuals}/made")
  install(DIRECTORY "${manuals}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}" OPTIONAL)
  install(FILES "${manuals}/completions/obvid"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" OPTIONAL)
  install(FILES "${manuals}/completions/_obvid" DESTINATION "${OBVID_ZSH_DIR}" OPTIONAL)
  install(FILES "${manuals}/completions/obvid.fish"
          DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" OPTIONAL)
endif()

# Made by tools/build_page, which needs node.
install(FILES "${PROJECT_BINARY_DIR}/studio.html" DESTINATION "${CMAKE_INSTALL_DATADIR}/obvid" OPTIONAL)

if(TARGET obvid_c)
  install(DIRECTORY bindings/python/obvid DESTINATION "${OBVID_PYTHON_DIR}"
          FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
  # The package looks for the library beside itself.
  file(RELATIVE_PATH library "/${OBVID_PYTHON_DIR}/obvid" "/${CMAKE_INSTALL_LIBDIR}/libobvid_c.so.1")
  install(CODE "
    set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${OBVID_PYTHON_DIR}/obvid\")
    file(REMOVE \"\${folder}/libobvid_c.so\")
    file(CREATE_LINK \"${library}\" \"\${folder}/libobvid_c.so\" SYMBOLIC)")
  file(READ integrations/freecad/package.xml package_xml)
  string(REPLACE "@VERSION@" "${PROJECT_VERSION}" package_xml "${package_xml}")
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/freecad/package.xml" CONTENT "${package_xml}" @ONLY)
  install(DIRECTORY integrations/freecad/ DESTINATION "${OBVID_FREECAD_DIR}"
          PATTERN "package.xml" EXCLUDE PATTERN "__pycache__" EXCLUDE)
  install(FILES "${PROJECT_BINARY_DIR}/freecad/package.xml" DESTINATION "${OBVID_FREECAD_DIR}")
endif()

# Debian's form of the licences and of the history.
set(debian "${PROJECT_BINARY_DIR}/debian")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS NOTICE
             integrations/freecad/package.xml)
file(READ NOTICE notice)
string(STRIP "${notice}" notice)
string(REGEX REPLACE "\n\n" "\n.\n" notice "${notice}")
string(REPLACE "\n" "\n " notice " ${notice}")
set(CPACK_PACKAGE_CONTACT "Obvid maintainers <maintainers@obvid.invalid>")
string(TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH where it is set
file(CONFIGURE OUTPUT "${debian}/changelog" CONTENT "obvid (${PROJECT_VERSION}-1) stable; urgency=medium

  * What is new stands in changelog.gz.

 -- ${CPACK_PACKAGE_CONTACT}  ${debian_date}
" @ONLY)
file(CONFIGURE OUTPUT "${debian}/copyright" CONTENT
"Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: obvid
Comment:
${notice}

Files: *
Copyright: 2026 The Obvid authors
License: Apache-2.0
 Licensed under the Apache License, Version 2.0. On Debian systems the text of
 the licence is in /usr/share/common-licenses/Apache-2.0.
" @ONLY)
install(FILES "${debian}/copyright" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(CODE "
  set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
  execute_process(COMMAND gzip -9nc \"${PROJECT_SOURCE_DIR}/CHANGELOG.md\"
                  OUTPUT_FILE \"\${folder}/changelog.gz\" COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND gzip -9nc \"${debian}/changelog\"
                  OUTPUT_FILE \"\${folder}/changelog.Debian.gz\" COMMAND_ERROR_IS_FATAL ANY)")
install(FILES cmake/debian/lintian-overrides DESTINATION "${CMAKE_INSTALL_DATADIR}/lintian/overrides"
        RENAME obvid)

set(CPACK_PACKAGE_NAME obvid)
set(CPACK_PACKAGE_VENDOR "The Obvid authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "fair contours through points: curvature continuous, monotone, proved")
set(CPACK_PACKAGE_DESCRIPTION
"Obvid draws a curve through points, or within their noise, whose curvature is
continuous and rises or falls without wobbling for as long as the points allow,
and proves that of the finished curve. It reads and writes STEP, IGES, BREP,
DXF, SVG, G-code and more, forms surfaces through sections and tool paths on
them.
.
This package holds the program with its studio, its batches and its helper for
CAD files, the libraries for C and C++, the Python package and the workbench
for FreeCAD.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_BINARY_DIR}/packages")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # all libraries of all programs, by dpkg-shlibdeps
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.8), python3-numpy")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "xdg-utils")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
    "freecad, python3-matplotlib, python3-distributed, libboost-dev, libexpected-dev, libfmt-dev, libpugixml-dev")
file(WRITE "${debian}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${debian}/triggers"
    "${PROJECT_SOURCE_DIR}/cmake/debian/postinst" "${PROJECT_SOURCE_DIR}/cmake/debian/prerm")
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # cpack packs what is built
include(CPack)
