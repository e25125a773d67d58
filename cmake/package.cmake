# How other projects find what is installed: a CMake package, a pkg-config file; and the way back.
include(CMakePackageConfigHelpers)
set(CREASE_INSTALLED crease-static crease_outside)
if(CREASE_SHARED)
  list(APPEND CREASE_INSTALLED crease-shared)
endif()
set_target_properties(crease_outside PROPERTIES EXPORT_NAME outside)
install(TARGETS ${CREASE_INSTALLED} EXPORT crease
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

set(CREASE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/crease)
install(EXPORT crease NAMESPACE crease:: FILE creaseTargets.cmake DESTINATION ${CREASE_CMAKE_DIR})
configure_package_config_file(cmake/creaseConfig.cmake.in ${PROJECT_BINARY_DIR}/creaseConfig.cmake
  INSTALL_DESTINATION ${CREASE_CMAKE_DIR})
# Until 1.0 each minor version may break the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/creaseConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/creaseConfig.cmake ${PROJECT_BINARY_DIR}/creaseConfigVersion.cmake
  DESTINATION ${CREASE_CMAKE_DIR})

# What a program that links the static library needs besides.
set(CREASE_PC_PRIVATE -lstdc++ -lm)
if(OpenMP_C_FOUND)
  list(PREPEND CREASE_PC_PRIVATE ${OpenMP_C_FLAGS})
endif()
foreach(library ${CREASE_OCCT})
  get_filename_component(name ${library} NAME_WE)
  string(REGEX REPLACE "^lib" "-l" name ${name})
  list(APPEND CREASE_PC_OCCT ${name})
endforeach()
list(JOIN CREASE_PC_OCCT " " CREASE_PC_OCCT)
list(JOIN CREASE_PC_PRIVATE " " CREASE_PC_PRIVATE)
file(RELATIVE_PATH CREASE_PC_TO_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(cmake/crease.pc.in ${PROJECT_BINARY_DIR}/crease.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/crease.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
  -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake VERBATIM)
