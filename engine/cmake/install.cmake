# How the engine is installed: the library, its headers by floor, a CMake package and a pkg-config file.
# A version promises what semantic versioning says: before 1.0 the minor number may break callers.

# `cmake --install build/release --component pfx` installs the engine without the program.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME pfx)

install(TARGETS pfx EXPORT pfxTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/pfx DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
if(TARGET pfx_compat)
  install(TARGETS pfx_compat EXPORT pfxTargets)
  install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/compat DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h" PATTERN native.h EXCLUDE PATTERN solver_pair.h EXCLUDE PATTERN serialize_records.h EXCLUDE)
endif()

set(PFX_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/pfx)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pfxConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/pfxConfig.cmake
  INSTALL_DESTINATION ${PFX_PACKAGE_DIR})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/pfxConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT pfxTargets NAMESPACE pfx:: DESTINATION ${PFX_PACKAGE_DIR})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pfxConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/pfxConfigVersion.cmake
  DESTINATION ${PFX_PACKAGE_DIR})

# The prefix is written relative to the .pc file, so that an installed tree can be moved.
file(RELATIVE_PATH PFX_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" PFX_PREFIX_FROM_PC "${PFX_PREFIX_FROM_PC}")
set(PFX_PC_FILES pfx)
if(TARGET pfx_compat)
  list(APPEND PFX_PC_FILES physics_effects)
endif()
foreach(name ${PFX_PC_FILES})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()
