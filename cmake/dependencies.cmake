# Everything from outside, gathered in one interface library (see docs/dependencies.md).
find_package(PkgConfig REQUIRED)
find_package(OpenMP COMPONENTS C)
pkg_check_modules(LAPACKE REQUIRED IMPORTED_TARGET lapacke)
pkg_check_modules(OPENBLAS REQUIRED IMPORTED_TARGET openblas)
pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo)
pkg_check_modules(CJSON REQUIRED IMPORTED_TARGET libcjson)
pkg_check_modules(ZLIB REQUIRED IMPORTED_TARGET zlib)

add_library(crease_outside INTERFACE)
target_link_libraries(crease_outside INTERFACE
  PkgConfig::LAPACKE PkgConfig::OPENBLAS PkgConfig::CAIRO PkgConfig::CJSON PkgConfig::ZLIB)
if(OpenMP_C_FOUND)
  target_link_libraries(crease_outside INTERFACE OpenMP::OpenMP_C)
endif()

# OpenCASCADE by its libraries: its own CMake package asks for the development files of everything
# that OpenCASCADE itself was built with.
if(CREASE_CAD)
  find_path(OpenCASCADE_INCLUDE_DIR Standard_Version.hxx PATH_SUFFIXES opencascade occt REQUIRED)
  set(CREASE_OCCT)
  foreach(toolkit TKSTEP TKSTEPBase TKSTEPAttr TKSTEP209 TKIGES TKXSBase TKMesh TKShHealing TKFillet TKBool TKBO TKPrim TKTopAlgo TKBRep
                  TKGeomAlgo TKGeomBase TKG3d TKG2d TKMath TKernel)
    find_library(OCCT_${toolkit} ${toolkit} REQUIRED)
    list(APPEND CREASE_OCCT ${OCCT_${toolkit}})
  endforeach()
endif()

if(CREASE_MPI)
  find_package(MPI REQUIRED COMPONENTS C)
endif()
