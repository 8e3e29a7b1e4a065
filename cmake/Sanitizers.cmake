# CAROM_SANITIZE: empty, "fuzzer-no-link;address;undefined" or "thread"; set by the presets asan and tsan. The first
# needs clang; its build is also used for the fuzzers, which follow the execution of rooms that read input
# (carom_coverage). These builds use -O1 -g1 (with -O2 a test that reads JSON takes g++ half a minute) and no NDEBUG,
# and the standard library checks its bounds, which a sanitizer notices only if the memory beyond is not allocated.
set(CAROM_SANITIZE "" CACHE STRING "sanitizers to build with")
add_library(carom_sanitizers INTERFACE)
add_library(carom_coverage INTERFACE)
if(CAROM_SANITIZE)
  set(checks ${CAROM_SANITIZE})
  if("fuzzer-no-link" IN_LIST checks)
    list(REMOVE_ITEM checks fuzzer-no-link)
    target_compile_options(carom_coverage INTERFACE -fsanitize=fuzzer-no-link)
  endif()
  string(REPLACE ";" "," joined "${checks}")
  target_compile_options(carom_sanitizers INTERFACE -fsanitize=${joined} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_compile_definitions(carom_sanitizers INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(carom_sanitizers INTERFACE -fsanitize=${joined})
  if(CAROM_SANITIZE MATCHES "address")
    target_compile_definitions(carom_sanitizers INTERFACE CAROM_ADDRESS_SANITIZER)
  endif()
  if(CAROM_SANITIZE MATCHES "thread")
    # Debian's oneTBB is built without the thread sanitizer, which takes every block for a race with the thread that
    # provided its work. The one file that uses TBB (with the code from its headers) is excluded, too, and tells the
    # sanitizer about these synchronisations.
    target_compile_definitions(carom_sanitizers INTERFACE CAROM_THREAD_SANITIZER)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/parallel/threads/executor.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=thread)
  endif()
endif()
