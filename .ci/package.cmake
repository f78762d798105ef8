# What `cmake --install` adds for find_package, and the Debian packages that `cpack` makes.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/scattermeter)
install(TARGETS scattermeter_flags EXPORT scattermeter-core)
set_target_properties(scattermeter_flags PROPERTIES EXPORT_NAME flags)
configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/.ci/scattermeter-config.cmake.in
  ${PROJECT_BINARY_DIR}/scattermeter-config.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/scattermeter-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/scattermeter-config.cmake
              ${PROJECT_BINARY_DIR}/scattermeter-config-version.cmake
        DESTINATION ${config_folder} COMPONENT development)
# Each Debian package has its own licence and changelog.
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/changelog "scattermeter (${PROJECT_VERSION}) unstable; urgency=medium

  * What changed: CHANGELOG.md.

 -- scattermeter developers <scattermeter@localhost>  ${package_date}
")
file(ARCHIVE_CREATE OUTPUT ${PROJECT_BINARY_DIR}/changelog.gz PATHS ${PROJECT_BINARY_DIR}/changelog
     FORMAT raw COMPRESSION GZip COMPRESSION_LEVEL 9)
function(scattermeter_package component name)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright
          COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endfunction()
scattermeter_package(program scattermeter)
scattermeter_package(development libscattermeter-dev)
if(SCATTERMETER_PYTHON)
  scattermeter_package(python python3-scattermeter)
endif()
install(FILES README.md ACCURACY.md CHANGELOG.md apps/RIG.md
        DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/scattermeter COMPONENT program)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scattermeter)
set(CPACK_PACKAGE_CONTACT "scattermeter developers <scattermeter@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
    "scattering and absorption of translucent materials from raw shots")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(SCATTERMETER_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-scattermeter)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy, scattermeter")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/.ci/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "scattermeter for Python: measure, read results, forward models on NumPy arrays.")
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME scattermeter)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# dpkg-shlibdeps finds the linked libraries; gnuplot is run as a program to draw plots.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libscattermeter-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libembree-dev, libceres-dev, libhwy-dev, libtbb-dev, libopencv-dev, libopenexr-dev, libtiff-dev, libraw-dev, libtinyobjloader-dev"
)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "Measures reduced scattering and absorption of a translucent material,
each with its uncertainty, from raw camera shots of an object of known shape
under lamps of known place and power.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Headers, static libraries and CMake files of scattermeter.")
include(CPack)
