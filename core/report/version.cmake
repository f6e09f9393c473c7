# Writes OUTPUT, a header with the version and the commit that is being built. Run at every build, so
# that a new commit is seen; the file is touched only when its text changes, so that nothing is
# compiled again without need.
#   cmake -D SOURCE=… -D VERSION=… -D TEMPLATE=version.h.in -D OUTPUT=version.h -P version.cmake

set(COMMIT "unknown")
find_program(GIT git)
if(GIT)
  # A tarball unpacked somewhere below another repository must not report that one's commit.
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-prefix --short=12 HEAD
    RESULT_VARIABLE failed OUTPUT_VARIABLE found ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  # --show-prefix answers with an empty line at the top of a work tree.
  if(NOT failed AND found MATCHES "^\n([0-9a-f]+)$")
    set(COMMIT ${CMAKE_MATCH_1})
    execute_process(
      COMMAND ${GIT} --no-optional-locks -C ${SOURCE} status --porcelain --untracked-files=no
      RESULT_VARIABLE failed OUTPUT_VARIABLE changes ERROR_QUIET)
    if(failed OR NOT changes STREQUAL "")
      string(APPEND COMMIT "-modified")
    endif()
  endif()
endif()

configure_file(${TEMPLATE} ${OUTPUT} @ONLY)  # leaves an unchanged file alone
