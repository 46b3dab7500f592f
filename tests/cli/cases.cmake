# Every method test_... of the class Cases in NAME_test.py is a CTest test FOLDER.NAME.CASE.
function(coordreq_python_tests folder)
  foreach(name ${ARGN})
    set(file ${CMAKE_CURRENT_SOURCE_DIR}/${name}_test.py)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(STRINGS ${file} lines REGEX "^    def test_")
    foreach(line ${lines})
      string(REGEX REPLACE "^    def test_([a-z0-9_]+).*" "\\1" case ${line})
      add_test(NAME ${folder}.${name}.${case} COMMAND /usr/bin/python3 -B ${file} Cases.test_${case})
      # One that skips itself is named in the last lines.
      set_tests_properties(${folder}.${name}.${case} PROPERTIES SKIP_REGULAR_EXPRESSION "OK \\(skipped=1\\)")
      set_tests_properties(${folder}.${name}.${case} PROPERTIES TIMEOUT 900 ENVIRONMENT
        "COORDREQ_PROGRAM=$<TARGET_FILE:coordreq>;COORDREQ_ROOT=${PROJECT_SOURCE_DIR};COORDREQ_MAN_PAGE=${PROJECT_BINARY_DIR}/app/coordreq.1;COORDREQ_MPI_PROGRAM=$<$<TARGET_EXISTS:coordreq-mpi>:$<TARGET_FILE:coordreq-mpi>>;PYTHONPATH=${PROJECT_SOURCE_DIR}/tests/cli")
    endforeach()
  endforeach()
endfunction()
