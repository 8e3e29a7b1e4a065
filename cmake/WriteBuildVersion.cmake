# cmake -D VERSION= -D GIT= -D FOLDERS= -D FILE= -P WriteBuildVersion.cmake: writes build_version() to FILE if it has
# changed.
if(GIT)
  set(ENV{GIT_OPTIONAL_LOCKS} 0)
  execute_process(COMMAND ${GIT} rev-parse --short=7 HEAD
    OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    string(APPEND VERSION "+g${commit}")
    execute_process(COMMAND ${GIT} status --porcelain -- ${FOLDERS} CMakeLists.txt cmake OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      string(APPEND VERSION ".dirty")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${FILE} CONTENT [[
#include "core/base/build_version.hpp"

namespace carom {

const char* build_version() {
  return "@VERSION@";
}

}  // namespace carom
]] @ONLY)
