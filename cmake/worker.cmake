# Where the installed program looks for workers, from its own folder (engine_registry.h).
set(SLIPCHECK_WORKER_DIR libexec/slipcheck)

# slipcheck_worker(<engine> <precision> SOURCES <file>... LIBRARIES <library>...)
# The executable that the harness starts for an engine, and beside it, in profiles/<engine>, the
# profiles of the calling folder.
function(slipcheck_worker engine precision)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  set(worker slipcheck-engine-${engine}-${precision})
  add_executable(${worker} ${arg_SOURCES})
  target_link_libraries(${worker} PRIVATE slipcheck_flags ${arg_LIBRARIES})
  set_target_properties(${worker} PROPERTIES SLIPCHECK_PLAIN ON)  # the engine is what runs long
  if(NOT TARGET ${engine}_profiles)
    slipcheck_profiles(${engine})
  endif()
  add_dependencies(${worker} ${engine}_profiles)
  slipcheck_component(${engine} component)
  # What was not built, as the quick start builds no other engine, is not installed.
  install(TARGETS ${worker} RUNTIME DESTINATION ${SLIPCHECK_WORKER_DIR} COMPONENT ${component} OPTIONAL)
endfunction()

# The component of the installation that an engine belongs to: Bullet comes with the program.
function(slipcheck_component engine result)
  set(component engine_${engine})
  if(engine STREQUAL bullet)
    set(component program)
  endif()
  set(${result} ${component} PARENT_SCOPE)
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
  slipcheck_component(${engine} component)
  install(FILES ${copies} DESTINATION ${SLIPCHECK_WORKER_DIR}/profiles/${engine} COMPONENT ${component} OPTIONAL)
endfunction()
