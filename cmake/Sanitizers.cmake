# CAROM_SANITIZE: empty, "address;undefined" or "thread"; set by the presets asan and tsan.
set(CAROM_SANITIZE "" CACHE STRING "sanitizers to build with")
add_library(carom_sanitizers INTERFACE)
if(CAROM_SANITIZE)
  string(REPLACE ";" "," joined "${CAROM_SANITIZE}")
  target_compile_options(carom_sanitizers INTERFACE -fsanitize=${joined} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(carom_sanitizers INTERFACE -fsanitize=${joined})
endif()
