# coordreq_python_tests(<folder> <part> [CASES] <name>...): each NAME_test.py is a CTest test FOLDER.NAME of that part of the
# suite, quick or long: one process a file. With CASES every method test_... of its class Cases is a test of its own, so that
# one that skips itself is named in the last lines.
function(coordreq_python_tests folder part)
  cmake_parse_arguments(ARG "CASES" "" "" ${ARGN})
  foreach(name ${ARG_UNPARSED_ARGUMENTS})
    set(file ${CMAKE_CURRENT_SOURCE_DIR}/${name}_test.py)
    set(tests)
    if(ARG_CASES)
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
      file(STRINGS ${file} lines REGEX "^    def test_")
      foreach(line ${lines})
        string(REGEX REPLACE "^    def test_([a-z0-9_]+).*" "\\1" case ${line})
        add_test(NAME ${folder}.${name}.${case} COMMAND /usr/bin/python3 -B ${file} Cases.test_${case})
        list(APPEND tests ${folder}.${name}.${case})
      endforeach()
    else()
      add_test(NAME ${folder}.${name} COMMAND /usr/bin/python3 -B ${file})
      list(APPEND tests ${folder}.${name})
    endif()
    set_tests_properties(${tests} PROPERTIES LABELS ${part} TIMEOUT 1800 SKIP_REGULAR_EXPRESSION "OK \\(skipped=1\\)" ENVIRONMENT
      "COORDREQ_PROGRAM=$<TARGET_FILE:coordreq>;COORDREQ_ROOT=${PROJECT_SOURCE_DIR};COORDREQ_MAN_PAGE=${PROJECT_BINARY_DIR}/app/coordreq.1;COORDREQ_MPI_PROGRAM=$<$<TARGET_EXISTS:coordreq-mpi>:$<TARGET_FILE:coordreq-mpi>>;PYTHONPATH=${PROJECT_SOURCE_DIR}/tests/cli")
  endforeach()
endfunction()
