# Everything comes from the distribution; docs/building.md lists the packages.
find_package(Threads REQUIRED)
find_package(Imath REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(pugixml REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

find_path(LCMS2_INCLUDE lcms2.h REQUIRED)
find_library(LCMS2_LIBRARY lcms2 REQUIRED)
add_library(weft_lcms2 INTERFACE)
target_include_directories(weft_lcms2 SYSTEM INTERFACE ${LCMS2_INCLUDE})
target_link_libraries(weft_lcms2 INTERFACE ${LCMS2_LIBRARY})

# oneDNN's own CMake files insist on OpenCL's headers, which we have no use for.
find_path(DNNL_INCLUDE dnnl.hpp REQUIRED)
find_library(DNNL_LIBRARY dnnl REQUIRED)
add_library(weft_dnnl INTERFACE)
target_include_directories(weft_dnnl SYSTEM INTERFACE ${DNNL_INCLUDE})
target_link_libraries(weft_dnnl INTERFACE ${DNNL_LIBRARY})

# Embree 4 where present, else 3.13; the sources include "world/embree.h", which knows both.
find_package(embree 4 QUIET)
if(embree_FOUND)
  add_library(weft_embree INTERFACE)
  target_link_libraries(weft_embree INTERFACE embree)
else()
  find_package(embree 3.13 REQUIRED)
  add_library(weft_embree INTERFACE)
  target_include_directories(weft_embree SYSTEM INTERFACE ${EMBREE_INCLUDE_DIRS})
  target_link_libraries(weft_embree INTERFACE embree)
endif()

# Debian's OpenImageIO names an OpenCV folder that only another package would make.
get_target_property(folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
foreach(folder ${folders})
  if(IS_DIRECTORY ${folder})
    list(APPEND existing_folders ${folder})
  endif()
endforeach()
set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing_folders}")

# Debian 12 puts OpenColorIO's CMake files where CMake does not look, with wrong paths in them.
find_package(OpenColorIO 2.1 QUIET)
if(NOT TARGET OpenColorIO::OpenColorIO)
  find_path(OPENCOLORIO_INCLUDE_DIR OpenColorIO/OpenColorIO.h REQUIRED)
  find_library(OPENCOLORIO_LIBRARY OpenColorIO REQUIRED)
  add_library(OpenColorIO::OpenColorIO UNKNOWN IMPORTED)
  set_target_properties(OpenColorIO::OpenColorIO PROPERTIES
    IMPORTED_LOCATION ${OPENCOLORIO_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OPENCOLORIO_INCLUDE_DIR})
endif()
