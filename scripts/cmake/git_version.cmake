# cmake -DSOURCE_DIR=<folder> -DHEADER=<file> -P git_version.cmake
# Writes a header with the commit of SOURCE_DIR, "unknown" if that is not the top of a git working tree (a
# release tarball, perhaps unpacked inside some other repository). Leaves the file alone if nothing changed.
cmake_minimum_required(VERSION 3.25)
set(sha1 "unknown")
find_program(GIT git)
if(GIT)
  execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --show-toplevel
                  OUTPUT_VARIABLE top OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  file(REAL_PATH "${SOURCE_DIR}" source)
  if(top)
    file(REAL_PATH "${top}" top)
  endif()
  if(top STREQUAL source)
    execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} rev-parse --verify --quiet HEAD
                    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(head MATCHES "^[0-9a-f]+$")
      set(sha1 "${head}")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT
"#pragma once

inline constexpr char kGitSha1[] = \"@sha1@\";
")
