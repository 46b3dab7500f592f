# coordreq_module(<name> SOURCES <file>... [DEPENDS <target>...] [PRIVATE_DEPENDS <target>...])
# One library target a module, coordreq_<name>; headers are included as "<name>/<file>.hpp". Installed it is
# coordreq::<name>, and <coordreq/<name>/<file>.hpp> works too.

add_library(coordreq_options INTERFACE)
target_compile_features(coordreq_options INTERFACE cxx_std_20)
target_compile_options(coordreq_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  # Designated initialisers leave out what has a sensible default, on purpose.
  -Wno-missing-field-initializers
  # False alarms of g++ 12 on std::string (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # Interval arithmetic relies on every operation being rounded once, as written.
  -ffp-contract=off
  $<$<BOOL:${COORDREQ_WARNINGS_AS_ERRORS}>:-Werror>)

include(GNUInstallDirs)

function(coordreq_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target coordreq_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/coordreq>)
  # Users of the library need no headers that only its sources include.
  list(TRANSFORM ARG_PRIVATE_DEPENDS REPLACE "^(nlohmann_json::.*)$" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(${target} PUBLIC ${ARG_DEPENDS}
                        PRIVATE $<BUILD_INTERFACE:coordreq_options> ${ARG_PRIVATE_DEPENDS})
  target_compile_features(${target} INTERFACE cxx_std_20)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT coordreq-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
endfunction()

# coordreq_test(<name> SOURCES <file>... DEPENDS <target>...): one GoogleTest binary, every case a CTest test.
function(coordreq_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target test_${name})
  add_executable(${target} ${ARG_SOURCES})
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${target} PRIVATE coordreq_options ${ARG_DEPENDS} GTest::gtest_main)
  # Parameters by number: printed, a struct is its bytes, which differ from run to run.
  gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
                       PROPERTIES TIMEOUT 600)
endfunction()
