# carom_hdf5: HDF5 for what links it. The shared library of Debian brings some thirty others along (curl, Kerberos, LDAP, for
# files in the web), which is half of the time that a program takes to start. Its archive needs two of them: programs are
# linked with that where there is one that needs no more, and libraries, whose users may have HDF5 themselves, are not.
find_library(HDF5_ARCHIVE libhdf5.a HINTS ${hdf5_LIBDIR} ${hdf5_LIBRARY_DIRS})
find_library(SZIP_LIBRARY sz)
set(CAROM_HDF5_ARCHIVE OFF)
if(HDF5_ARCHIVE AND SZIP_LIBRARY AND NOT CAROM_SANITIZE)
  include(CheckCXXSourceCompiles)
  set(CMAKE_REQUIRED_INCLUDES ${hdf5_INCLUDE_DIRS})
  set(CMAKE_REQUIRED_LIBRARIES ${HDF5_ARCHIVE} ${SZIP_LIBRARY} ZLIB::ZLIB ${CMAKE_DL_LIBS} m)
  check_cxx_source_compiles("#include <hdf5.h>\nint main() { return H5open(); }" CAROM_HDF5_ARCHIVE_LINKS)
  unset(CMAKE_REQUIRED_INCLUDES)
  unset(CMAKE_REQUIRED_LIBRARIES)
  set(CAROM_HDF5_ARCHIVE ${CAROM_HDF5_ARCHIVE_LINKS})
endif()

add_library(carom_hdf5 INTERFACE)
if(NOT CAROM_HDF5_ARCHIVE)
  target_link_libraries(carom_hdf5 INTERFACE PkgConfig::hdf5)
  return()
endif()
# A program that uses libcarom.so says CAROM_SHARED_HDF5: it should not have HDF5 twice.
set(program "$<AND:$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>,$<NOT:$<BOOL:$<TARGET_PROPERTY:CAROM_SHARED_HDF5>>>>")
target_link_libraries(carom_hdf5 INTERFACE $<$<NOT:${program}>:PkgConfig::hdf5>
  $<${program}:${HDF5_ARCHIVE}> $<${program}:${SZIP_LIBRARY}> $<${program}:ZLIB::ZLIB> $<${program}:${CMAKE_DL_LIBS}>)
