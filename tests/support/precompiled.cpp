// Holds no code: CMake wants a source to compile the shared test headers with (CMakeLists.txt).
