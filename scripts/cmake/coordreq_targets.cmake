# coordreq_module(<name> [SOURCES <file>...] [DEPENDS <target>...] [PRIVATE_DEPENDS <target>...])
# One library target a room, coordreq_<name>, of all sources in its folder and SOURCES that are generated; headers are
# included as "<name>/<file>.hpp". Installed it is coordreq::<name>, and <coordreq/<name>/<file>.hpp> works too.

add_library(coordreq_options INTERFACE)
target_compile_features(coordreq_options INTERFACE cxx_std_20)
target_compile_options(coordreq_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  # Designated initialisers leave out what has a sensible default, on purpose.
  -Wno-missing-field-initializers
  # False alarms of g++ 12 on std::string (GCC bug 105651 and its like).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  # Interval arithmetic relies on every operation being rounded once, as written.
  -ffp-contract=off
  $<$<BOOL:${COORDREQ_WARNINGS_AS_ERRORS}>:-Werror>)

include(GNUInstallDirs)

# coordreq_precompile(<target>): the heavy headers of the standard library and of others are parsed once a build.
function(coordreq_precompile target)
  if(NOT TARGET coordreq_precompiled)
    add_library(coordreq_precompiled STATIC ${PROJECT_SOURCE_DIR}/scripts/cmake/precompiled.cpp)
    # A precompiled header is good only where the macros of its headers are the same.
    target_compile_definitions(coordreq_options INTERFACE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
    target_link_libraries(coordreq_precompiled PRIVATE coordreq_options)
    target_precompile_headers(coordreq_precompiled PRIVATE ${PROJECT_SOURCE_DIR}/scripts/cmake/precompiled.hpp)
  endif()
  target_precompile_headers(${target} REUSE_FROM coordreq_precompiled)
endfunction()

# coordreq_unite(<target>): with COORDREQ_UNITY_BUILD ten sources are compiled as one, so that they share what they
# instantiate of the libraries. All presets but tidy do so, that names in two files of one room differ everywhere.
function(coordreq_unite target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${COORDREQ_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 10)
endfunction()

# coordreq_compile_quickly(<target>...): what works through no cells is not compiled for speed.
function(coordreq_compile_quickly)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

function(coordreq_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target coordreq_${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  add_library(${target} STATIC ${sources} ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/coordreq>)
  # Users of the library need no headers that only its sources include.
  list(TRANSFORM ARG_PRIVATE_DEPENDS REPLACE "^(nlohmann_json::.*)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS}
                        PRIVATE $<BUILD_INTERFACE:coordreq_options> ${ARG_PRIVATE_DEPENDS})
  coordreq_precompile(${target})
  coordreq_unite(${target})
  target_compile_features(${target} INTERFACE cxx_std_20)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT coordreq-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endfunction()

# coordreq_test(<name> [SOURCES <file>...] DEPENDS <target>...): one GoogleTest binary, every case a CTest test; without
# SOURCES of all sources in the folder.
function(coordreq_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target test_${name})
  if(NOT ARG_SOURCES)
    file(GLOB_RECURSE ARG_SOURCES CONFIGURE_DEPENDS *.cpp)
  endif()
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE coordreq_options ${ARG_DEPENDS} GTest::gtest_main)
  coordreq_precompile(${target})
  # Parameters by number: printed, a struct is its bytes, which differ from run to run.
  gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
                       PROPERTIES TIMEOUT 600)
endfunction()
