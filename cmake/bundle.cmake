# What saves time when everything is compiled: files compiled together and headers compiled once.
include(${CMAKE_CURRENT_LIST_DIR}/unity.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/precompiled.cmake)

# For all targets of a directory and of those below it.
function(slipcheck_bundle_all directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    slipcheck_unite(${target})
    slipcheck_precompile(${target})
  endforeach()
  get_property(folders DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(folder IN LISTS folders)
    slipcheck_bundle_all(${folder})
  endforeach()
endfunction()
