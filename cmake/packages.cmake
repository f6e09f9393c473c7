# Debian packages, by `cmake --build build/release --target packages`, one for each component of the installation:
# slipcheck (the program with Bullet), an engine each, libslipcheck-dev, python3-slipcheck. What they depend on
# dpkg-shlibdeps finds out from the libraries that they are linked with.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME slipcheck)
set(CPACK_PACKAGE_CONTACT "Slipcheck maintainers <slipcheck@localhost>" CACHE STRING
  "Who maintains the packages: name and address")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_OUTPUT_FILE_PREFIX ${PROJECT_BINARY_DIR}/packages)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# slipcheck_package(<component> <name> <summary> [DEPENDS <text>] [RECOMMENDS <text>])
set(CPACK_COMPONENTS_ALL)
function(slipcheck_package component name summary)
  cmake_parse_arguments(arg "" "DEPENDS;RECOMMENDS" "" ${ARGN})
  string(TOUPPER ${component} upper)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION "${summary}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${arg_DEPENDS}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS "${arg_RECOMMENDS}" PARENT_SCOPE)
  install(FILES LICENSE RENAME copyright DESTINATION share/doc/${name} COMPONENT ${component})
endfunction()

slipcheck_package(program slipcheck "${PROJECT_DESCRIPTION}" RECOMMENDS "gnuplot-nox, nodejs, npm")
set(same "slipcheck (= ${PROJECT_VERSION})")
foreach(engine dart lammps mujoco ode siconos simbody)
  if(TARGET slipcheck-engine-${engine}-double)
    set(depends "${same}")
    if(engine STREQUAL lammps)  # a program
      string(APPEND depends ", lammps")
    endif()
    slipcheck_package(engine_${engine} slipcheck-engine-${engine} "The engine ${engine} beside Slipcheck's reference"
      DEPENDS "${depends}")
  endif()
endforeach()
slipcheck_package(dev libslipcheck-dev "Slipcheck's reference as C++ libraries, and what an engine of your own implements"
  DEPENDS "libboost-dev, libeigen3-dev, libfmt-dev, libhwy-dev, libsundials-dev, libudunits2-dev, libyaml-cpp-dev, nettle-dev, nlohmann-json3-dev, pkg-config")
if(TARGET slipcheck_python)
  # What find_package() says is known in that folder alone.
  get_target_property(minor slipcheck_python SLIPCHECK_PYTHON_MINOR)
  math(EXPR next_minor "${minor} + 1")
  slipcheck_package(python python3-slipcheck "Slipcheck's results in pandas and xarray, and its reference in Python"
    DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next_minor}), python3-numpy, python3-pandas, python3-xarray"
    RECOMMENDS "${same}, python3-matplotlib")
endif()

include(CPack)

# All that goes into them and nothing else: no test is built.
add_custom_target(packages
  COMMAND ${CMAKE_CPACK_COMMAND} --config ${PROJECT_BINARY_DIR}/CPackConfig.cmake
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR} VERBATIM USES_TERMINAL)
add_dependencies(packages slipcheck engines)
if(TARGET slipcheck_python)
  add_dependencies(packages slipcheck_python)
endif()
