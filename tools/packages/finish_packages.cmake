# Adds to each staged package what Debian asks of it: a copyright, two changelogs, overrides of lintian and compressed
# pages of the manual. Adds the list of parts, too. debian.cmake sets `packages`, `version`, `maintainer`, `source` and
# `sbom`, and cpack runs this before it packs.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(debian_changelog "graze (${version}) unstable; urgency=medium\n\n  * Packages of version ${version}. \
changelog.gz says what is new.\n\n -- ${maintainer}  ${date}\n")

# compress(<file>): a page as Debian has it, the same bytes each time.
function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

foreach(entry ${packages})
  string(REGEX MATCH "^(.*)=(.*)$" entry ${entry})
  set(component ${CMAKE_MATCH_1})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}${CPACK_PACKAGING_INSTALL_PREFIX})
  set(package ${CMAKE_MATCH_2})
  if(NOT IS_DIRECTORY ${root})
    continue()
  endif()
  set(documents ${root}/share/doc/${package})
  file(MAKE_DIRECTORY ${documents})
  file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/copyright ${documents}/copyright)
  file(COPY_FILE ${sbom} ${documents}/graze.spdx.json)
  file(COPY_FILE ${source}/docs/changelog.md ${documents}/changelog)
  file(WRITE ${documents}/changelog.Debian "${debian_changelog}")
  compress(${documents}/changelog)
  compress(${documents}/changelog.Debian)
  set(overrides ${root}/share/lintian/overrides)
  file(MAKE_DIRECTORY ${overrides})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/lintian-overrides text)
  if(component STREQUAL "graze_runtime")
    file(READ ${CMAKE_CURRENT_LIST_DIR}/lintian-overrides-runtime more)
    string(APPEND text "${more}")
  endif()
  file(WRITE ${overrides}/${package} "${text}")
  file(GLOB_RECURSE archives ${root}/lib/*.a)
  foreach(archive ${archives})  # without the name of the compiler in each object
    execute_process(COMMAND strip --strip-debug --remove-section=.comment --enable-deterministic-archives ${archive}
      COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  file(GLOB_RECURSE pages ${root}/share/man/*)
  foreach(page ${pages})
    compress(${page})
  endforeach()
endforeach()
