# `cpack`: the Debian packages coordreq (the program) and libcoordreq-dev (the library).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME coordreq)
set(CPACK_PACKAGE_VENDOR "The coordreq authors")
set(CPACK_PACKAGE_CONTACT "${coordreq_maintainer}")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_COMPONENTS_ALL program debian development debian-dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME coordreq)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-h5py, python3-matplotlib")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libcoordreq-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
    "libgmp-dev, libmpfr-dev, libflint-dev, libflint-arb-dev, libhdf5-dev, libdeflate-dev, zlib1g-dev, nettle-dev, libfmt-dev, nlohmann-json3-dev, pkg-config")


# Under the one line that describes the project.
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"Several agents share a safety task. While they can talk to each other they
agree on their actions; when the connection is lost each of them goes on
alone. coordreq computes for how long they may stay silent, from every cell of
a grid over the state space, before safety needs them to agree again.")
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION
"The library that the program coordreq is made of: headers, static libraries
and a package for find_package of CMake.")

include(CPack)
cpack_add_component_group(program)
cpack_add_component_group(library)
cpack_add_component(program GROUP program)
cpack_add_component(debian GROUP program)
cpack_add_component(development GROUP library)
cpack_add_component(debian-dev GROUP library)
