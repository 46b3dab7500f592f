# Part of an install script: installs what the policy of Debian wants compressed, without times inside.
cmake_minimum_required(VERSION 3.25)

function(install_compressed file folder name)
  set(compressed ${build}/debian/${package}/${name}.gz)
  cmake_path(GET compressed PARENT_PATH parent)
  file(MAKE_DIRECTORY ${parent})
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${compressed} COMMAND_ERROR_IS_FATAL ANY)
  file(INSTALL ${compressed} DESTINATION ${CMAKE_INSTALL_PREFIX}/${folder})
endfunction()

set(date "Thu, 01 Jan 1970 00:00:00 +0000")
execute_process(COMMAND git -C ${source} log -1 --format=%cD OUTPUT_VARIABLE commit_date
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(NOT failed)
  set(date ${commit_date})
endif()
file(WRITE ${build}/debian/changelog "coordreq (${version}-1) unstable; urgency=medium

  * See /usr/share/doc/${package}/changelog.gz.

 -- ${maintainer}  ${date}
")
install_compressed(${build}/debian/changelog ${data}/doc/${package} changelog.Debian)
install_compressed(${source}/CHANGELOG.md ${data}/doc/${package} changelog)
if(package STREQUAL "coordreq")
  install_compressed(${build}/app/coordreq.1 ${data}/man/man1 coordreq.1)
  install_compressed(${source}/scripts/coordreq-plot.1 ${data}/man/man1 coordreq-plot.1)
  file(INSTALL ${source}/README.md ${source}/CONTRIBUTING.md ${source}/docs
       DESTINATION ${CMAKE_INSTALL_PREFIX}/${data}/doc/${package})
  file(INSTALL ${build}/app/completions/_coordreq
       DESTINATION ${CMAKE_INSTALL_PREFIX}/${data}/zsh/vendor-completions)
endif()
