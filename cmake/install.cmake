# What `make install` and the packages hold: the program with its data, and the library for programs of others.
include(CMakePackageConfigHelpers)
set(RIPSTOP_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/ripstop)

install(TARGETS ripstop_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY materials examples DESTINATION ${CMAKE_INSTALL_DATADIR}/ripstop COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

install(TARGETS ripstop EXPORT ripstop-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
# Without the two headers that need a library of their own; only sources include them.
install(DIRECTORY src/ripstop DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING
  PATTERN "*.h" PATTERN "run/json.h" EXCLUDE PATTERN "output/drawing.h" EXCLUDE)
install(EXPORT ripstop-targets NAMESPACE ripstop:: DESTINATION ${RIPSTOP_CMAKE_DIR} COMPONENT development)
configure_package_config_file(cmake/ripstop-config.cmake.in ${CMAKE_BINARY_DIR}/ripstop-config.cmake
  INSTALL_DESTINATION ${RIPSTOP_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ripstop-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/ripstop-config.cmake ${CMAKE_BINARY_DIR}/ripstop-config-version.cmake
  DESTINATION ${RIPSTOP_CMAKE_DIR} COMPONENT development)
