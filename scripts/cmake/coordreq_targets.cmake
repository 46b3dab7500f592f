# coordreq_module(<name> [UNITS <number> [BY_FOLDER]] [HOT <file>...] [SOURCES <file>...] [DEPENDS <target>...]
#                 [PRIVATE_DEPENDS <target>...])
# One library target a room, coordreq_<name>, of all sources in its folder and SOURCES that are generated, in so many units
# (see coordreq_unite). With HOT, only those are compiled for speed (see coordreq_compile_quickly). Headers are included as
# "<name>/<file>.hpp". Installed it is coordreq::<name>, and <coordreq/<name>/<file>.hpp> works too.

add_library(coordreq_options INTERFACE)
target_compile_features(coordreq_options INTERFACE cxx_std_20)
target_compile_options(coordreq_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  # Designated initialisers leave out what has a sensible default, on purpose.
  -Wno-missing-field-initializers
  # False alarms of g++ 12 on std::string (GCC bug 105651 and its like).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds>
  $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>
  # g++ tidies up its memory seldom: a twentieth to a tenth of its time, for 300 MiB more at most.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
  # Interval arithmetic relies on every operation being rounded once, as written.
  -ffp-contract=off
  # Newer versions of g++ than that of Debian 12 may warn of more: there a warning is no error.
  $<$<AND:$<BOOL:${COORDREQ_WARNINGS_AS_ERRORS}>,$<NOT:$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>>>:-Werror>)
# A precompiled header is good only where the macros of its headers are the same.
target_compile_definitions(coordreq_options INTERFACE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

include(GNUInstallDirs)

# coordreq_precompile(<target> [tests]): the heavy headers of the standard library and of others are parsed once a build:
# those of scripts/cmake/precompiled.hpp, of tests those of GoogleTest and RapidCheck too.
function(coordreq_precompile target)
  set(header precompiled)
  set(libraries coordreq_options)
  if("${ARGN}" STREQUAL "tests")
    set(header precompiled_tests)
    list(APPEND libraries GTest::gtest rapidcheck)
  endif()
  if(NOT TARGET coordreq_${header})
    add_library(coordreq_${header} STATIC ${PROJECT_SOURCE_DIR}/scripts/cmake/precompiled.cpp)
    target_link_libraries(coordreq_${header} PRIVATE ${libraries})
    target_precompile_headers(coordreq_${header} PRIVATE ${PROJECT_SOURCE_DIR}/scripts/cmake/${header}.hpp)
  endif()
  target_precompile_headers(${target} REUSE_FROM coordreq_${header})
endfunction()

# coordreq_unite(<target> [<units> [BY_FOLDER]]): with COORDREQ_UNITY_BUILD the sources of a target are compiled as one, so
# that they share what they parse and instantiate; those of a large one as so many units, to which they are dealt by their
# names, or by those of their folders, so that a new file shifts no others. All presets but iterate and tidy do so, that names
# in two files of one room differ everywhere.
function(coordreq_unite target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${COORDREQ_UNITY_BUILD} UNITY_BUILD_MODE GROUP)
  list(APPEND ARGN 1)
  list(GET ARGN 0 units)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "^\\$<")
  foreach(source ${sources})
    set(name ${source})
    if("BY_FOLDER" IN_LIST ARGN)
      cmake_path(GET source PARENT_PATH name)
    endif()
    cmake_path(GET name FILENAME name)
    string(MD5 digest ${name})
    string(SUBSTRING ${digest} 0 6 digits)
    math(EXPR unit "0x${digits} % ${units}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${unit})
  endforeach()
endfunction()

# coordreq_compile_quickly(<target>...): what works through no cells is not compiled for speed.
function(coordreq_compile_quickly)
  foreach(target ${ARGN})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

function(coordreq_module name)
  cmake_parse_arguments(ARG "BY_FOLDER" "UNITS" "HOT;SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target coordreq_${name})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
  if(ARG_HOT)
    list(TRANSFORM ARG_HOT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    list(REMOVE_ITEM sources ${ARG_HOT})
    add_library(${target}_hot OBJECT ${ARG_HOT})
    target_include_directories(${target}_hot PRIVATE ${PROJECT_SOURCE_DIR}/lib)
    target_link_libraries(${target}_hot PRIVATE coordreq_options ${ARG_DEPENDS} ${ARG_PRIVATE_DEPENDS})
    coordreq_precompile(${target}_hot)
    coordreq_unite(${target}_hot)
    list(APPEND ARG_SOURCES $<TARGET_OBJECTS:${target}_hot>)
  endif()
  add_library(${target} STATIC ${sources} ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/coordreq>)
  # Users of the library need no headers that only its sources include.
  list(TRANSFORM ARG_PRIVATE_DEPENDS REPLACE "^(nlohmann_json::.*)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS}
                        PRIVATE $<BUILD_INTERFACE:coordreq_options> ${ARG_PRIVATE_DEPENDS})
  coordreq_precompile(${target})
  if(ARG_BY_FOLDER)
    list(APPEND ARG_UNITS BY_FOLDER)
  endif()
  coordreq_unite(${target} ${ARG_UNITS})
  target_compile_features(${target} INTERFACE cxx_std_20)
  if(ARG_HOT)
    coordreq_compile_quickly(${target})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT coordreq-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endfunction()

# coordreq_test(<name> [CASES] [UNITS <number>] [SOURCES <file>...] DEPENDS <target>...): one GoogleTest binary, of all
# sources in the folder unless SOURCES says which. One CTest test of the quick part, <name>.units; with CASES every case is a
# test of the long part, so that they share the processors.
function(coordreq_test name)
  cmake_parse_arguments(ARG "CASES" "UNITS" "SOURCES;DEPENDS" ${ARGN})
  set(target test_${name})
  if(NOT ARG_SOURCES)
    file(GLOB_RECURSE ARG_SOURCES CONFIGURE_DEPENDS *.cpp)
  endif()
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE coordreq_options ${ARG_DEPENDS} GTest::gtest_main rapidcheck)
  coordreq_precompile(${target} tests)
  coordreq_unite(${target} ${ARG_UNITS})
  if(ARG_CASES)
    # Parameters by number: printed, a struct is its bytes, which differ from run to run.
    gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
                         PROPERTIES TIMEOUT 1800 LABELS standard)
  else()
    add_test(NAME ${name}.units COMMAND ${target} --gtest_brief=1)
    set_tests_properties(${name}.units PROPERTIES TIMEOUT 1800 LABELS quick)
  endif()
endfunction()
