# The parts of the installed program besides the library, and Debian packages of both by cpack.
include(GNUInstallDirs)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # neither tests nor benchmarks are installed
if(CAROM_PROGRAM)
  install(TARGETS carom RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # Made from the program's own --help.
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/carom.1
    COMMAND bash ${PROJECT_SOURCE_DIR}/cmake/man_page.sh $<TARGET_FILE:carom> ${PROJECT_VERSION} > carom.1
    DEPENDS carom ${PROJECT_SOURCE_DIR}/cmake/man_page.sh WORKING_DIRECTORY ${PROJECT_BINARY_DIR} COMMENT "" VERBATIM)
  add_custom_target(carom_man_page ALL DEPENDS ${PROJECT_BINARY_DIR}/carom.1)
  install(FILES ${PROJECT_BINARY_DIR}/carom.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/carom.bash RENAME carom
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
endif()
if(TARGET carom-mpi)
  install(TARGETS carom-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ranks)  # beside carom, which looks for it there
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Carom <carom@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "hard disks in a rectangle, simulated exactly and fast")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME carom)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "gnuplot-nox, ffmpeg")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libcarom${PROJECT_VERSION_MAJOR})
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libcarom-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libcarom${PROJECT_VERSION_MAJOR} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENTS_ALL "")
if(CAROM_PROGRAM)
  list(APPEND CPACK_COMPONENTS_ALL program)
endif()
if(TARGET carom-mpi)
  list(APPEND CPACK_COMPONENTS_ALL ranks)
  set(CPACK_DEBIAN_RANKS_PACKAGE_NAME carom-mpi)
  set(CPACK_DEBIAN_RANKS_PACKAGE_DEPENDS "carom (= ${PROJECT_VERSION}), openmpi-bin")
endif()
if(CAROM_LIBRARY)
  list(APPEND CPACK_COMPONENTS_ALL runtime dev)
endif()
if(CAROM_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python3)
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_NAME python3-carom)
  math(EXPR next_python "${Python3_VERSION_MINOR} + 1")  # the compiled part is for one version of Python
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON3_PACKAGE_SUGGESTS "python3-h5py")
endif()
# Debian requires the licence of every package in this place.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME} COMPONENT ${component})
endforeach()
include(CPack)
