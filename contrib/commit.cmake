# cmake -D SOURCE=... -D OUTPUT=... -P commit.cmake: writes the header that names the commit of the source tree, with
# "-dirty" if files differ from it, or "unknown" where SOURCE is not the top of a git checkout. Runs at every build and
# touches the header only when it changes.
set(commit unknown)
find_program(GIT git)
if(GIT)
  set(git ${GIT} -c safe.directory=${SOURCE} -C ${SOURCE})
  execute_process(COMMAND ${git} rev-parse --show-prefix RESULT_VARIABLE failed OUTPUT_VARIABLE prefix
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed AND prefix STREQUAL "")
    execute_process(COMMAND ${git} describe --always --dirty --abbrev=12 --exclude=* OUTPUT_VARIABLE described
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(described)
      set(commit ${described})
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define VIBROCONTACT_COMMIT \"${commit}\"\n")
