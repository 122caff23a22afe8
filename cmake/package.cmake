# The Debian packages: `make package`.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${PROJECT_HOMEPAGE_URL})
set(CPACK_PACKAGE_CONTACT "The Ripstop developers <ripstop@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME ripstop)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "openfoam, openmpi-bin")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "subsonic parachutes: shape, drag, stresses and loads
 Ripstop computes the inflated shape of a parachute, its drag, the stresses
 in the cloth, the tensions of the lines and the opening load. The cloth is a
 lattice of nonlinear springs, and the air a turbulent flow of the built-in
 engine or of OpenFOAM. The package contains materials and examples.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "subsonic parachutes: C++ library
 The static library of Ripstop with its headers, and its package for CMake.")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "subsonic parachutes: Python package
 The Python package ripstop: cases, runs and results as NumPy arrays.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libripstop-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "ripstop, pkg-config, libfmt-dev, libtomlplusplus-dev, libpng-dev, zlib1g-dev, libhwy-dev, libcairo2-dev, libxxhash-dev, libnlopt-dev, libpugixml-dev, libminizip-dev")
if(EXISTS ${RIPSTOP_SITE}/index.html)
  list(APPEND CPACK_COMPONENTS_ALL documentation)
endif()
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME ripstop-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "subsonic parachutes: documentation
 Tutorials, guide, theory, validation and reference of Ripstop as pages for the
 browser, with search and without a network: /usr/share/doc/ripstop/html.")
if(RIPSTOP_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR python_next "${Python3_VERSION_MINOR} + 1")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-ripstop)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "ripstop, python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}), python3 (<< ${Python3_VERSION_MAJOR}.${python_next}), python3-numpy")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)

# What Debian expects of every package: its copyright, and a change log that states the version. Packages have the prefix /usr.
string(TIMESTAMP today "%a, %d %b %Y 00:00:00 +0000" UTC)
foreach(names program ripstop development libripstop-dev documentation ripstop-doc python python3-ripstop)
  if(NOT component)
    set(component ${names})
    continue()
  endif()
  set(folder ${CMAKE_BINARY_DIR}/debian/${names})
  file(WRITE ${folder}/changelog "${names} (${PROJECT_VERSION}) stable; urgency=medium\n\n  * See CHANGELOG.md of the package ripstop.\n\n -- "
    "${CPACK_PACKAGE_CONTACT}  ${today}\n")
  execute_process(COMMAND gzip -9nf ${folder}/changelog)
  install(CODE "if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
    file(INSTALL DESTINATION \"/usr/share/doc/${names}\" TYPE FILE FILES \"${folder}/changelog.gz\"
      \"${CMAKE_SOURCE_DIR}/packaging/debian/copyright\")
  endif()" COMPONENT ${component})
  unset(component)
endforeach()
include(CPack)
