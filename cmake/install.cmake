# What `cmake --install` puts where, in components that are also Debian packages (cmake/packages.cmake): libhl and
# libhlbatch (the libraries), libhl-dev (what a program is built with), hl-tools (hl, hld and the page), hl-cad (what
# reads CAD files), hl-vdb (what reads OpenVDB files), hl-ros (what speaks ROS 2's topics), hl-share (what
# shares worlds); python3-hl is in python/CMakeLists.txt.
include(CMakePackageConfigHelpers)
set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hl)

install(TARGETS hl_shared EXPORT hl_targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libhl NAMELINK_COMPONENT libhl-dev)
install(TARGETS hl_batch_shared EXPORT hl_targets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libhlbatch NAMELINK_COMPONENT libhl-dev)

# The reference of the calls, made from the headers.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
file(GLOB public_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/hl/*)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/reference.html
  DEPENDS scripts/reference scripts/reference_headers.py ${public_headers}
  COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/scripts/reference --out ${PROJECT_BINARY_DIR}/reference.html)
add_custom_target(reference ALL DEPENDS ${PROJECT_BINARY_DIR}/reference.html)
add_dependencies(programs reference)

install(DIRECTORY include/hl DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libhl-dev)
install(EXPORT hl_targets NAMESPACE hl:: FILE hlTargets.cmake DESTINATION ${cmake_folder} COMPONENT libhl-dev)
configure_package_config_file(cmake/hlConfig.cmake.in ${PROJECT_BINARY_DIR}/hlConfig.cmake
  INSTALL_DESTINATION ${cmake_folder} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hlConfigVersion.cmake COMPATIBILITY SameMinorVersion)
# A path from the file itself, so that the tree may be installed anywhere and moved.
file(RELATIVE_PATH HL_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(packaging/hl.pc.in ${PROJECT_BINARY_DIR}/hl.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/hlConfig.cmake ${PROJECT_BINARY_DIR}/hlConfigVersion.cmake
  DESTINATION ${cmake_folder} COMPONENT libhl-dev)
install(FILES ${PROJECT_BINARY_DIR}/hl.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT libhl-dev)
# The documents have the places that they have in the sources, so that their links lead somewhere.
install(FILES README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
  COMPONENT libhl-dev)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT libhl-dev)
install(FILES proto/hl.proto DESTINATION ${CMAKE_INSTALL_DOCDIR}/proto COMPONENT libhl-dev)
install(DIRECTORY scenes/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/scenes COMPONENT libhl-dev)
install(FILES ${PROJECT_BINARY_DIR}/reference.html DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT libhl-dev)
install(DIRECTORY csharp DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT libhl-dev)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT libhl-dev)
install(FILES src/dds/ros2.idl DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT libhl-dev)
install(FILES scenes/teapot_patches.h DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples COMPONENT libhl-dev)
# CMAKE_INSTALL_PREFIX is that of the installation, which may be another than now.
install(CODE "execute_process(COMMAND_ERROR_IS_FATAL ANY COMMAND \"${Python3_EXECUTABLE}\"
  \"${PROJECT_SOURCE_DIR}/scripts/installed_links.py\"
  \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")" COMPONENT libhl-dev)

install(TARGETS hl hld RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT hl-tools)
if(TARGET hl_cad_program)
  install(TARGETS hl_cad_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT hl-cad)
  install(FILES LICENSE DESTINATION share/doc/hl-cad RENAME copyright COMPONENT hl-cad)
endif()
if(TARGET hl_vdb_program)
  install(TARGETS hl_vdb_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT hl-vdb)
  install(FILES LICENSE DESTINATION share/doc/hl-vdb RENAME copyright COMPONENT hl-vdb)
endif()
if(TARGET hl_ros_program)
  install(TARGETS hl_ros_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT hl-ros)
  install(FILES LICENSE DESTINATION share/doc/hl-ros RENAME copyright COMPONENT hl-ros)
endif()
if(TARGET hl_share_program)
  install(TARGETS hl_share_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT hl-share)
  install(FILES LICENSE DESTINATION share/doc/hl-share RENAME copyright COMPONENT hl-share)
endif()
# Built by scripts/build, not by CMake: without it the programs serve a notice instead.
install(DIRECTORY viewer/dist/ DESTINATION share/hl/viewer COMPONENT hl-tools OPTIONAL)
install(DIRECTORY scenes/examples DESTINATION share/hl/scenes COMPONENT hl-tools)
install(FILES packaging/hld.conf DESTINATION share/doc/hl-tools COMPONENT hl-tools)
install(FILES packaging/hld.service DESTINATION lib/systemd/system COMPONENT hl-tools)

# Debian wants the licence of each package beside it.
foreach(component libhl libhlbatch libhl-dev hl-tools)
  install(FILES LICENSE DESTINATION share/doc/${component} RENAME copyright COMPONENT ${component})
endforeach()
