# `cmake --install BUILD [--prefix DIR]` installs the program, which finds its scenes relative to its own path. `cpack`
# in the build folder makes a Debian package.

# A program in a build folder uses the scenes of the sources.
foreach(folder ${PROJECT_BINARY_DIR} ${PROJECT_BINARY_DIR}/tests)
  file(RELATIVE_PATH scenes ${folder} ${PROJECT_SOURCE_DIR}/scenes)
  file(MAKE_DIRECTORY ${folder})
  file(CREATE_LINK ${scenes} ${folder}/scenes SYMBOLIC)
endforeach()

install(TARGETS taut RUNTIME)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/taut/scenes USE_SOURCE_PERMISSIONS
  PATTERN pictures EXCLUDE PATTERN *.md EXCLUDE)
foreach(room . engine render cli scenes scenes/gallery scenes/papers scenes/papers/scenes scenes/studies scenes/studies/results)
  file(GLOB texts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${room}/*.md)
  install(FILES ${texts} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${room})
endforeach()

set(words ${CMAKE_CURRENT_BINARY_DIR}/words)
add_custom_command(OUTPUT ${words}/done
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/words $<TARGET_FILE:taut> ${words}
  DEPENDS taut ${CMAKE_CURRENT_LIST_DIR}/words
  COMMENT "Completion, JSON Schemas and manual pages")
add_custom_target(taut_words ALL DEPENDS ${words}/done)
install(FILES ${words}/taut.bash RENAME taut DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${words}/taut.zsh RENAME _taut DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES ${words}/scene.schema.json ${words}/sweep.schema.json ${words}/claim.schema.json ${words}/suite.schema.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/taut/scenes)
install(DIRECTORY ${words}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of taut <taut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "compares SPH formulations for elastic solids")
set(CPACK_PACKAGE_DESCRIPTION
  "Runs the same scene with 25 formulations of smoothed particle hydrodynamics for\nelastic solids, 24 published and \
one of its own, draws the particles off\nscreen, and reports how accurate, fast and stable each formulation is.")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # reads the libraries from the program
set(CPACK_DEBIAN_PACKAGE_DEPENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, librsvg2-bin")  # charts; outlines from SVG files
set(CPACK_DEBIAN_PACKAGE_SUGGESTS ffmpeg)         # movie
include(CPack)
