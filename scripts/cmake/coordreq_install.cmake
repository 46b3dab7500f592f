# What `cmake --install` puts where. Nothing installed knows its prefix, so that the tree may be moved.
#   program      the program, its completions, the examples and the plots
#   documents    man page, README and licence, as they are
#   mpi          coordreq-mpi, only when asked for: cmake --install build --component mpi
#   development  libraries, the headers of the interface, and the package for find_package
# and, only for packages of Debian, debian and debian-dev: documents the way its policy wants them.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(coordreq_maintainer)
coordreq_find_maintainer(coordreq_maintainer)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/coordreq)
set(data_dir ${CMAKE_INSTALL_DATADIR}/coordreq)
set(support ${PROJECT_SOURCE_DIR}/scripts/cmake)

# program
install(TARGETS coordreq RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
if(TARGET coordreq-mpi)
  install(TARGETS coordreq-mpi RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi EXCLUDE_FROM_ALL)
endif()
install(DIRECTORY configs DESTINATION ${data_dir} COMPONENT program)
install(PROGRAMS configs/ci/check_specs DESTINATION ${data_dir}/configs/ci COMPONENT program)
install(FILES lib/spec/schema.json DESTINATION ${data_dir} COMPONENT program)
install(PROGRAMS scripts/plot DESTINATION ${data_dir} COMPONENT program)
install(DIRECTORY scripts/plotting DESTINATION ${data_dir} COMPONENT program FILES_MATCHING PATTERN "*.py")
file(RELATIVE_PATH plot /${CMAKE_INSTALL_BINDIR} /${data_dir}/plot)
file(CREATE_LINK ${plot} ${PROJECT_BINARY_DIR}/coordreq-plot SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/coordreq-plot DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)

# The pages link to the examples.
file(RELATIVE_PATH configs /${CMAKE_INSTALL_DOCDIR} /${data_dir}/configs)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/links)
file(CREATE_LINK ${configs} ${PROJECT_BINARY_DIR}/links/configs SYMBOLIC)
install(FILES ${PROJECT_BINARY_DIR}/links/configs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

set(completions ${PROJECT_BINARY_DIR}/app/completions)
install(FILES ${completions}/coordreq.bash RENAME coordreq
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${completions}/coordreq.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(FILES ${completions}/_coordreq
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT documents)

# documents
install(FILES ${PROJECT_BINARY_DIR}/app/coordreq.1 scripts/coordreq-plot.1
        DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT documents)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)

# development
install(EXPORT coordreq-targets NAMESPACE coordreq:: DESTINATION ${package_dir} COMPONENT development)
configure_package_config_file(${support}/coordreq-config.cmake.in coordreq-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/coordreq-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/coordreq-config.cmake ${PROJECT_BINARY_DIR}/coordreq-config-version.cmake
        DESTINATION ${package_dir} COMPONENT development)
install(DIRECTORY tests/install/consumer/ DESTINATION ${data_dir}/examples/library COMPONENT development)
install(CODE "
  set(folder \"${PROJECT_SOURCE_DIR}/lib\")
  set(headers ${COORDREQ_PUBLIC_HEADERS})
  set(destination \"${CMAKE_INSTALL_INCLUDEDIR}/coordreq\")
  include(\"${support}/install_headers.cmake\")" COMPONENT development)

# debian, debian-dev
foreach(package coordreq libcoordreq-dev)
  string(REPLACE libcoordreq-dev debian-dev component ${package})
  string(REPLACE coordreq debian component ${component})
  install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(CODE "
    set(source \"${PROJECT_SOURCE_DIR}\")
    set(build \"${PROJECT_BINARY_DIR}\")
    set(package ${package})
    set(version ${PROJECT_VERSION})
    set(maintainer [==[${coordreq_maintainer}]==])
    set(data \"${CMAKE_INSTALL_DATADIR}\")
    include(\"${support}/install_debian.cmake\")" COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
