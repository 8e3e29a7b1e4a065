# Libraries, all of them from Debian packages (packages.txt), looked for only here.
find_package(TBB REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
# Sums are in the order of the array for any instruction set.
target_compile_definitions(Eigen3::Eigen INTERFACE EIGEN_DONT_VECTORIZE)
find_package(fmt REQUIRED)
if(CAROM_PROGRAM)
  find_package(CLI11 REQUIRED)
endif()
if(CAROM_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter Development.Module)
endif()
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
pkg_search_module(hdf5 REQUIRED IMPORTED_TARGET hdf5-serial hdf5)  # the name in Debian, and that elsewhere
find_package(ZLIB REQUIRED)
find_path(RANDOM123_INCLUDE Random123/philox.h REQUIRED)
find_path(TOMLPLUSPLUS_INCLUDE toml++/toml.h REQUIRED)
# Optional: several ranks over MPI (packages.txt, [mpi]).
find_package(MPI QUIET COMPONENTS CXX)
