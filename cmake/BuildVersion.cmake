# carom_build_version: the only source file that contains the commit (core/base/build_version.hpp). It is written again
# when git's HEAD or a source of the program changes, so that a commit costs only this file and the links.
set(version_file ${PROJECT_BINARY_DIR}/build_version.cpp)
set(version_folders core parallel io run app)
set(version_depends ${PROJECT_SOURCE_DIR}/cmake/WriteBuildVersion.cmake)
foreach(folder IN LISTS version_folders)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/${folder}/*.hpp ${PROJECT_SOURCE_DIR}/${folder}/*.inl)
  list(APPEND version_depends ${files})
endforeach()
list(APPEND version_folders viewer)
list(APPEND version_depends ${viewer_sources})

# Only if the repository is this project's own: a tarball may have been unpacked inside another repository.
find_program(GIT git)
set(version_git "")
if(GIT AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  set(version_git ${GIT})
  execute_process(COMMAND ${GIT} rev-parse --path-format=absolute --git-path logs/HEAD
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(EXISTS "${head}")
    list(APPEND version_depends ${head})
  endif()
endif()

add_custom_command(OUTPUT ${version_file}
  COMMAND ${CMAKE_COMMAND} -D VERSION=${PROJECT_VERSION} -D "GIT=${version_git}" -D "FOLDERS=${version_folders}"
    -D FILE=${version_file} -P ${PROJECT_SOURCE_DIR}/cmake/WriteBuildVersion.cmake
  DEPENDS ${version_depends} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "" VERBATIM)
add_library(carom_build_version STATIC ${version_file})
target_include_directories(carom_build_version PRIVATE ${PROJECT_SOURCE_DIR})
set_target_properties(carom_build_version PROPERTIES POSITION_INDEPENDENT_CODE ON)
