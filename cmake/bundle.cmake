# What saves time when everything is compiled: files compiled together and headers compiled once.
include(${CMAKE_CURRENT_LIST_DIR}/unity.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/precompiled.cmake)
# Off for who changes one file again and again, as tests/mutants does: then those of tests alone are compiled as one.
option(SLIPCHECK_UNITE "With SLIPCHECK_BUNDLE: compile several files of a library as one" ON)

# For all targets of a directory and of those below it.
function(slipcheck_bundle_all directory)
  set(tests ${PROJECT_SOURCE_DIR}/tests)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  cmake_path(IS_PREFIX tests ${directory} is_test)
  foreach(target IN LISTS targets)
    if(SLIPCHECK_UNITE OR is_test)
      slipcheck_unite(${target})
    endif()
    if(NOT CMAKE_CXX_CLANG_TIDY)  # which reads no headers of another compiler's
      slipcheck_precompile(${target})
    endif()
  endforeach()
  get_property(folders DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(folder IN LISTS folders)
    slipcheck_bundle_all(${folder})
  endforeach()
endfunction()
