# slipcheck_layer(<layer>)
# Makes the static library slipcheck_<layer> what other projects may link as slipcheck::<layer>: its headers
# are installed, those of the calling folder, and it can be part of a shared library, as of Python's module.
function(slipcheck_layer layer)
  set(target slipcheck_${layer})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/core> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/slipcheck>)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${layer})
  add_library(slipcheck::${layer} ALIAS ${target})
  if(SLIPCHECK_PYTHON_MODULE AND NOT SLIPCHECK_SANITIZE)
    # Hidden: calls inside of the library go straight to where they go in a program.
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON
      CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
  install(TARGETS ${target} EXPORT slipcheck ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev)
  cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME folder)
  if(folder STREQUAL layer)
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/ COMPONENT dev
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/slipcheck/${layer}
      FILES_MATCHING PATTERN *.h PATTERN *-inl.h EXCLUDE)
  endif()
endfunction()
