# CAROM_SANITIZE: empty, "fuzzer-no-link;address;undefined" or "thread"; set by the presets asan and tsan. The first is
# clang's: its build serves the fuzzers too, which follow what the rooms that read input do (carom_coverage).
# Those build with -O1 -g1 (at -O2 one test that reads JSON takes g++ half a minute) and without NDEBUG, and let the
# standard library check its bounds, which a sanitizer sees only where the memory beyond was not allocated.
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
    # Debian's oneTBB is built without the thread sanitizer, which takes every block for a race with whoever gave it
    # work. The one file that knows TBB (with what its headers make there) is left out too, and tells the sanitizer.
    target_compile_definitions(carom_sanitizers INTERFACE CAROM_THREAD_SANITIZER)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/parallel/threads/executor.cpp PROPERTIES COMPILE_OPTIONS -fno-sanitize=thread)
  endif()
endif()
