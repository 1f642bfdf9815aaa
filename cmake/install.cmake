# What `cmake --install` puts under the prefix, and what CPack makes of it: the program, the scenes and
# pages that come with it, completions for shells and the manual page, which the program itself prints,
# and the weights of the denoiser's network where they have been fetched. Nothing knows the prefix: the
# program looks beside its own folder.
include(GNUInstallDirs)

if(DEFINED ENV{WEFT_WEIGHTS})
  set(weights $ENV{WEFT_WEIGHTS})
elseif(DEFINED ENV{XDG_DATA_HOME})
  set(weights $ENV{XDG_DATA_HOME}/weft/weights)
else()
  set(weights $ENV{HOME}/.local/share/weft/weights)
endif()
set(WEFT_WEIGHTS ${weights} CACHE PATH "Folder with the denoiser's weights, to be installed; empty for none")

install(TARGETS weft RUNTIME)
install(FILES scenes/demo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/scenes)
install(DIRECTORY scenes/demo scenes/materials DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/scenes)
install(FILES README.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(WEFT_WEIGHTS)
  install(DIRECTORY ${WEFT_WEIGHTS}/ DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/weights OPTIONAL
    FILES_MATCHING PATTERN "*.tza" PATTERN "LICENSE.txt")
endif()

# weft_install_output(FILE DESTINATION ARGUMENT...): what the program prints, called so.
function(weft_install_output file destination)
  set(made ${PROJECT_BINARY_DIR}/printed/${file})
  install(CODE "execute_process(COMMAND \"$<TARGET_FILE:weft>\" ${ARGN} OUTPUT_FILE \"${made}\"
    COMMAND_ERROR_IS_FATAL ANY)")
  install(FILES ${made} DESTINATION ${destination})
endfunction()
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/printed)
weft_install_output(weft.1 ${CMAKE_INSTALL_MANDIR}/man1 docs --man)
weft_install_output(weft ${CMAKE_INSTALL_DATADIR}/bash-completion/completions completion bash)
weft_install_output(_weft ${CMAKE_INSTALL_DATADIR}/zsh/site-functions completion zsh)
weft_install_output(weft.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d completion fish)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME weft)
set(CPACK_PACKAGE_VENDOR "The Weft project")
set(CPACK_PACKAGE_CONTACT "The Weft project <weft@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Path tracer for film-quality pictures")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Renders scenes in its own format and in glTF on ordinary processors,
denoises, compares and displays pictures. Needs a processor of the level
${WEFT_ARCH}, as it was built for.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
