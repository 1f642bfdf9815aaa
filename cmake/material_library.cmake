# Writes the text of scenes/materials/*.xml into a source file, so that the program can print and include
# them wherever it is installed.
function(weft_material_library output)
  file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/scenes/materials/*.xml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  set(entries "")
  set(count 0)
  foreach(file ${files})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(APPEND entries "    {\"${name}\", R\"xml(${text})xml\"},\n")
    math(EXPR count "${count} + 1")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Generated from scenes/materials.
#include \"io/material_library.h\"

#include <array>

namespace weft::io {

namespace {

constexpr std::array<LibraryFile, @count@> files{{
@entries@}};

} // namespace

std::span<LibraryFile const> material_library() { return files; }

} // namespace weft::io
")
endfunction()
