# weft_room(NAME ROOM...): the folder src/NAME as one library that uses the named rooms.
# A room that has only headers becomes an interface library.

add_library(weft_flags INTERFACE)
target_compile_options(weft_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers)
# GCC 12 warns falsely about std::string's operator+ at -O3 (GCC bug 105329).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(weft_flags INTERFACE -Wno-restrict)
endif()
if(WEFT_WERROR)
  target_compile_options(weft_flags INTERFACE -Werror)
endif()
if(WEFT_ARCH)
  target_compile_options(weft_flags INTERFACE -march=${WEFT_ARCH})
endif()
# Math functions need not set errno, nor trap: neither changes a value, both let code vectorise.
# -ffast-math stays off: NaNs must remain visible.
target_compile_options(weft_flags INTERFACE -fno-math-errno -fno-trapping-math)
if(WEFT_SANITIZE)
  target_compile_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE})
endif()

# Most of the time to compile is spent on reading headers: a few sources in one unit read them once.
option(WEFT_UNITY "Compile several sources at once" ON)
function(weft_compile_together target)
  if(WEFT_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 6)
    # GCC takes every source of a unit for a header, in which unnamed namespaces would be a mistake.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
    endif()
  endif()
endfunction()

set(weft_libraries_base Imath::Imath Threads::Threads)
set(weft_libraries_image OpenImageIO::OpenImageIO weft_lcms2)
set(weft_libraries_io pugixml::pugixml nlohmann_json::nlohmann_json fmt::fmt)
set(weft_libraries_schema nlohmann_json::nlohmann_json fmt::fmt)
set(weft_libraries_world weft_embree TBB::tbb)
set(weft_libraries_post OpenColorIO::OpenColorIO TBB::tbb weft_dnnl ${CMAKE_DL_LIBS})
set(weft_libraries_session TBB::tbb fmt::fmt nlohmann_json::nlohmann_json Threads::Threads)

function(weft_room name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  list(TRANSFORM ARGN PREPEND weft_ OUTPUT_VARIABLE rooms)
  if(sources)
    add_library(weft_${name} STATIC ${sources})
    weft_compile_together(weft_${name})
    set(scope PUBLIC)
  else()
    add_library(weft_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(weft_${name} ${scope} ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(weft_${name} ${scope} weft_flags ${rooms} ${weft_libraries_${name}})
endfunction()
