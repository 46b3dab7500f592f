# Who answers for packages that are built here, as "NAME <ADDRESS>": COORDREQ_MAINTAINER if it is set, else what
# Debian's tools ask, DEBFULLNAME and DEBEMAIL, else git's user.name and user.email. Empty if nobody has said it:
# nobody is made up, and cpack then asks for a maintainer.
set(COORDREQ_MAINTAINER "" CACHE STRING "Maintainer of packages, NAME <ADDRESS>; default: DEBFULLNAME and DEBEMAIL, or git's user")

function(coordreq_find_maintainer variable)
  set(found "${COORDREQ_MAINTAINER}")
  if(NOT found AND NOT "$ENV{DEBFULLNAME}" STREQUAL "" AND NOT "$ENV{DEBEMAIL}" STREQUAL "")
    set(found "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  endif()
  find_program(GIT git)
  if(NOT found AND GIT)
    foreach(key name email)
      execute_process(COMMAND ${GIT} config user.${key} WORKING_DIRECTORY ${CMAKE_CURRENT_LIST_DIR}
                      OUTPUT_VARIABLE ${key} OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    endforeach()
    if(name AND email)
      set(found "${name} <${email}>")
    endif()
  endif()
  set(${variable} "${found}" PARENT_SCOPE)
endfunction()
