# The Debian packages that `cpack -G DEB` makes of a build. finish_packages.cmake adds what Debian asks of each.
if(NOT UNIX OR APPLE)
  return()
endif()
set(GRAZE_PACKAGE_MAINTAINER "graze maintainers <maintainers@graze.invalid>" CACHE STRING
  "Who made the Debian packages: a name and an address")
set(GRAZE_PACKAGE_RELEASE 1 CACHE STRING "The number of the Debian packages of one version of graze")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME graze)
set(CPACK_PACKAGE_VENDOR graze)
set(CPACK_PACKAGE_CONTACT "${GRAZE_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL graze_runtime graze_development graze_tools graze_python)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${GRAZE_PACKAGE_RELEASE})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${GRAZE_PACKAGE_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(full_version ${PROJECT_VERSION}-${GRAZE_PACKAGE_RELEASE})
set(library_package libgraze-c${PROJECT_VERSION_MAJOR})

# graze_package(<component> <package> <section> <depends> <summary> <more>...): the settings of one package. <more> are
# the lines of its description.
function(graze_package component package section depends summary)
  string(TOUPPER ${component} upper)
  list(JOIN ARGN "\n" description)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${description}" PARENT_SCOPE)
endfunction()

set(what_graze_is "graze finds where surfaces touch, or are about to. It is for games and surgery"
  "simulators, whose loops move deformable and rigid meshes." ".")
graze_package(graze_runtime ${library_package} libs "" "find where deformable surfaces touch (C library)"
  ${what_graze_is} "This package has the shared library of the C interface.")
set(CPACK_DEBIAN_GRAZE_RUNTIME_PACKAGE_SHLIBDEPS ON)
graze_package(graze_development libgraze-dev libdevel
  "${library_package} (= ${full_version}), libeigen3-dev (>= 3.4), libtbb-dev"
  "find where deformable surfaces touch (development files)"
  ${what_graze_is} "This package has the headers, the static libraries of C++, and the files for"
  "CMake and pkg-config. The component io needs the recommended packages.")
set(CPACK_DEBIAN_GRAZE_DEVELOPMENT_PACKAGE_RECOMMENDS
  "libassimp-dev, libspdlog-dev, libpng-dev, zlib1g-dev, nlohmann-json3-dev")
graze_package(graze_tools graze-tools science "" "find where surfaces touch, in scenes and mesh files"
  ${what_graze_is} "This package has the program graze. It plays scenes and mesh files, writes"
  "reports, and records and replays runs.")
set(CPACK_DEBIAN_GRAZE_TOOLS_PACKAGE_SHLIBDEPS ON)
graze_package(graze_python python3-graze python
  "python3:any (>= 3.9), python3-numpy, ${library_package} (= ${full_version})"
  "find where deformable surfaces touch (Python module)"
  ${what_graze_is} "This package has the module graze, whose reports are numpy arrays.")
set(CPACK_DEBIAN_GRAZE_PYTHON_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_GRAZE_PYTHON_PACKAGE_CONTROL_EXTRA
  "${CMAKE_CURRENT_SOURCE_DIR}/python/postinst;${CMAKE_CURRENT_SOURCE_DIR}/python/prerm")

# What the library's package says to programs that are linked with it: each function is as old as the package. The
# loader looks for new libraries when a package with this trigger comes or goes.
file(STRINGS ${PROJECT_SOURCE_DIR}/tests/c_interface/abi.txt functions REGEX "^function ")
set(symbols "libgraze_c.so.${PROJECT_VERSION_MAJOR} ${library_package} #MINVER#\n* Build-Depends-Package: libgraze-dev\n")
foreach(function ${functions})
  string(REPLACE "function " "" name "${function}")
  string(APPEND symbols " ${name}@Base ${PROJECT_VERSION}\n")
endforeach()
file(CONFIGURE OUTPUT symbols CONTENT "${symbols}")
file(CONFIGURE OUTPUT shlibs CONTENT
  "libgraze_c ${PROJECT_VERSION_MAJOR} ${library_package} (>= ${PROJECT_VERSION})\n")
file(CONFIGURE OUTPUT triggers CONTENT "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_GRAZE_RUNTIME_PACKAGE_CONTROL_EXTRA
  "${CMAKE_CURRENT_BINARY_DIR}/symbols;${CMAKE_CURRENT_BINARY_DIR}/shlibs;${CMAKE_CURRENT_BINARY_DIR}/triggers")

# What finish_packages.cmake puts into each package.
set(packages "graze_runtime=${library_package}" graze_development=libgraze-dev graze_tools=graze-tools
  graze_python=python3-graze)
file(CONFIGURE OUTPUT finish_packages.cmake @ONLY CONTENT "set(packages \"@packages@\")\n\
set(version @full_version@)\nset(maintainer \"@GRAZE_PACKAGE_MAINTAINER@\")\nset(source \"@PROJECT_SOURCE_DIR@\")\n\
set(sbom \"@sbom@\")\n\
include(@CMAKE_CURRENT_SOURCE_DIR@/finish_packages.cmake)\n")
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_BINARY_DIR}/finish_packages.cmake)
include(CPack)
