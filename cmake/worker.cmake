# slipcheck_worker(<engine> <precision> SOURCES <file>... LIBRARIES <library>...)
# The executable that the harness starts for an engine, and beside it, in profiles/<engine>, the
# profiles of the calling folder.
function(slipcheck_worker engine precision)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  set(worker slipcheck-engine-${engine}-${precision})
  add_executable(${worker} ${arg_SOURCES})
  target_link_libraries(${worker} PRIVATE slipcheck_flags ${arg_LIBRARIES})
  if(NOT TARGET ${engine}_profiles)
    slipcheck_profiles(${engine})
  endif()
  add_dependencies(${worker} ${engine}_profiles)
endfunction()

# The target <engine>_profiles: the files profiles/*.yaml of the calling folder, copied to where
# workers are.
function(slipcheck_profiles engine)
  file(GLOB profiles CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/profiles profiles/*.yaml)
  set(copies)
  foreach(profile ${profiles})
    set(copy ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/profiles/${engine}/${profile})
    add_custom_command(OUTPUT ${copy}
      COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_CURRENT_SOURCE_DIR}/profiles/${profile} ${copy}
      DEPENDS profiles/${profile})
    list(APPEND copies ${copy})
  endforeach()
  add_custom_target(${engine}_profiles DEPENDS ${copies})
endfunction()
