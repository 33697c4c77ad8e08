# cmake --install: what a package holds. Programs find the library and the folder of the project from where they lie, so
# that the tree may be moved as a whole.
#
#   bin/                 the utilities
#   lib/                 libmpm.so, the participant for C (libmpm/capi), pkgconfig/ and cmake/ for who builds against it
#   include/libmpm/      mpm.h
#   lib/python3/dist-packages/   the module libmpm
#   lib/libmpm/          libmpmCore.so for every instruction set (portable build only)
#   share/libmpm/        etc, cases and utilities as in the source tree: what MPM_PROJECT_DIR names
#   share/doc/libmpm/    README, CHANGELOG, licence
set(MPM_LIBRARY_FOLDER ${CMAKE_INSTALL_LIBDIR}/libmpm)
set(MPM_DATA_FOLDER ${CMAKE_INSTALL_DATADIR}/libmpm)

file(RELATIVE_PATH MPM_DATA_FROM_BIN ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_DATADIR}/libmpm)
file(RELATIVE_PATH MPM_LIBRARY_FROM_BIN ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/libmpm)
file(RELATIVE_PATH MPM_LIBRARY_FROM_LIB ${CMAKE_INSTALL_FULL_LIBDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/libmpm)
file(RELATIVE_PATH MPM_BIN_FROM_DATA ${CMAKE_INSTALL_FULL_DATADIR}/libmpm ${CMAKE_INSTALL_FULL_BINDIR})

function(mpm_install_utility name)
    set_target_properties(${name} PROPERTIES INSTALL_RPATH "$ORIGIN/${MPM_LIBRARY_FROM_BIN}")
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# Scripts and cases. etc/installed tells etc/bashrc where the utilities are; bootstrap and checkFloors serve who builds.
file(GENERATE OUTPUT ${CMAKE_BINARY_DIR}/installed CONTENT "${MPM_BIN_FROM_DATA}\n")
install(FILES ${CMAKE_BINARY_DIR}/installed DESTINATION ${MPM_DATA_FOLDER}/etc)
install(DIRECTORY etc DESTINATION ${MPM_DATA_FOLDER} USE_SOURCE_PERMISSIONS
    PATTERN cmake EXCLUDE
    PATTERN __pycache__ EXCLUDE
    PATTERN checkFloors EXCLUDE)
install(DIRECTORY utilities DESTINATION ${MPM_DATA_FOLDER} FILES_MATCHING PATTERN "*.cpp")
# Cases without what runs left in them; examples likewise.
install(DIRECTORY cases examples DESTINATION ${MPM_DATA_FOLDER} USE_SOURCE_PERMISSIONS
    PATTERN postProcessing EXCLUDE
    PATTERN refined EXCLUDE
    REGEX "/([0-9.]+(e-?[0-9]+)?|log\\.[^/]*|[^/]*\\.(h5|xdmf|pvd))$" EXCLUDE)
install(FILES README.md CHANGELOG.md COPYING LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
