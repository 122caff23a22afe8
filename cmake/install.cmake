# What `make install` and the packages hold: the program with its data, and the library for programs of others.
include(CMakePackageConfigHelpers)
set(RIPSTOP_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/ripstop)

install(TARGETS ripstop_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
install(DIRECTORY materials examples DESTINATION ${CMAKE_INSTALL_DATADIR}/ripstop COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# The site of the documentation, where `make docs` has built it.
set(RIPSTOP_SITE ${CMAKE_SOURCE_DIR}/build-docs/site)
install(DIRECTORY ${RIPSTOP_SITE}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/ripstop/html COMPONENT documentation OPTIONAL)

# Manual pages and shell completion, which the program's own --help gives.
if(RIPSTOP_PYTHON)
  set(RIPSTOP_TERMINAL ${CMAKE_BINARY_DIR}/terminal)
  add_custom_command(OUTPUT ${RIPSTOP_TERMINAL}/bash/ripstop VERBATIM
    DEPENDS ripstop_program ${CMAKE_SOURCE_DIR}/packaging/terminal.py ${CMAKE_SOURCE_DIR}/docs/site/reference.py
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${RIPSTOP_TERMINAL}
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_SOURCE_DIR}/packaging/terminal.py --program $<TARGET_FILE:ripstop_program>
      --version ${PROJECT_VERSION} --out ${RIPSTOP_TERMINAL})
  add_custom_target(terminal ALL DEPENDS ${RIPSTOP_TERMINAL}/bash/ripstop)
  install(DIRECTORY ${RIPSTOP_TERMINAL}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  install(FILES ${RIPSTOP_TERMINAL}/bash/ripstop DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
  install(FILES ${RIPSTOP_TERMINAL}/zsh/_ripstop DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
  install(FILES ${RIPSTOP_TERMINAL}/fish/ripstop.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
endif()

install(TARGETS ripstop EXPORT ripstop-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
# Without the two headers that need a library of their own, which only sources include, and without Studio, a part of the program.
install(DIRECTORY src/ripstop DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development FILES_MATCHING
  PATTERN "*.h" PATTERN "run/json.h" EXCLUDE PATTERN "output/drawing.h" EXCLUDE
  PATTERN "studio" EXCLUDE)
install(EXPORT ripstop-targets NAMESPACE ripstop:: DESTINATION ${RIPSTOP_CMAKE_DIR} COMPONENT development)
configure_package_config_file(cmake/ripstop-config.cmake.in ${CMAKE_BINARY_DIR}/ripstop-config.cmake
  INSTALL_DESTINATION ${RIPSTOP_CMAKE_DIR})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/ripstop-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/ripstop-config.cmake ${CMAKE_BINARY_DIR}/ripstop-config-version.cmake
  DESTINATION ${RIPSTOP_CMAKE_DIR} COMPONENT development)
