# weft_embedded_text(OUTPUT FILE HEADER NAMESPACE FUNCTION): a source file that defines
# `std::string_view FUNCTION()`, declared in HEADER, with the text of FILE, so that the program can use
# it wherever it is installed.
function(weft_embedded_text output file header namespace function)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  get_filename_component(name ${file} NAME)
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT "// Generated from @name@.
#include \"@header@\"

namespace @namespace@ {

std::string_view @function@() {
    return R\"embedded(@text@)embedded\";
}

} // namespace @namespace@
")
endfunction()
