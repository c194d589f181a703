# Writes graze.spdx.json: what graze's libraries and its program are made of, in the format SPDX 2.3. It is of what this
# build has found, so each build has its own. tests/packages/sbom_test.py compares it with the files of the build.
set(sbom ${CMAKE_CURRENT_BINARY_DIR}/graze.spdx.json)
set(sbom_packages "[]")
set(sbom_relationships "[]")

# append_json(<list> <object>): adds an object to a list of JSON.
function(append_json list object)
  string(JSON length LENGTH "${${list}}")
  string(JSON longer SET "${${list}}" ${length} "${object}")
  set(${list} "${longer}" PARENT_SCOPE)
endfunction()

# add_package(<name> <version> <licence> <purl> [<download>]): one part, with its package URL or "".
macro(add_package name version licence purl)
  set(package [[{"filesAnalyzed": false, "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION",
    "supplier": "NOASSERTION", "downloadLocation": "NOASSERTION"}]])
  string(JSON package SET "${package}" SPDXID "\"SPDXRef-${name}\"")
  string(JSON package SET "${package}" name "\"${name}\"")
  if(NOT "${version}" STREQUAL "")
    string(JSON package SET "${package}" versionInfo "\"${version}\"")
  endif()
  string(JSON package SET "${package}" licenseDeclared "\"${licence}\"")
  if(NOT "${ARGN}" STREQUAL "")
    string(JSON package SET "${package}" downloadLocation "\"${ARGN}\"")
  endif()
  if(NOT "${purl}" STREQUAL "")
    string(JSON package SET "${package}" externalRefs "[{\"referenceCategory\": \"PACKAGE-MANAGER\", \
\"referenceType\": \"purl\", \"referenceLocator\": \"${purl}\"}]")
  endif()
  append_json(sbom_packages "${package}")
endmacro()

# relate(<from> <relationship> <to>)
macro(relate from relationship to)
  append_json(sbom_relationships "{\"spdxElementId\": \"SPDXRef-${from}\", \"relationshipType\": \"${relationship}\", \
\"relatedSpdxElement\": \"SPDXRef-${to}\"}")
endmacro()

# add_library_of_others(<name> <target> <version> <licence> <user>...): a library, and which parts of graze use it. A
# library of headers becomes a part of them, as a static one does.
function(add_library_of_others name target version licence)
  add_package(${name} "${version}" "${licence}" "pkg:generic/${name}@${version}")
  set(relationship STATIC_LINK)
  foreach(property IMPORTED_LOCATION IMPORTED_LOCATION_RELEASE IMPORTED_LOCATION_NONE IMPORTED_LOCATION_RELWITHDEBINFO)
    get_target_property(location ${target} ${property})
    if(location MATCHES "\\.(so|dylib|dll|tbd)")
      set(relationship DYNAMIC_LINK)
    endif()
  endforeach()
  foreach(user ${ARGN})
    relate(${user} ${relationship} ${name})
  endforeach()
  set(sbom_packages "${sbom_packages}" PARENT_SCOPE)
  set(sbom_relationships "${sbom_relationships}" PARENT_SCOPE)
endfunction()

# The parts of graze that this build has.
relate(DOCUMENT DESCRIBES graze)
set(parts graze)
if(TARGET graze_c)
  list(APPEND parts graze-c)
endif()
if(TARGET graze_io)
  list(APPEND parts graze-io)
endif()
if(TARGET graze_program)
  list(APPEND parts graze-program)
endif()
foreach(part ${parts})
  add_package(${part} ${PROJECT_VERSION} NOASSERTION "")
  if(NOT part STREQUAL "graze")
    relate(${part} STATIC_LINK graze)
  endif()
endforeach()

add_library_of_others(eigen Eigen3::Eigen "${Eigen3_VERSION}" MPL-2.0 ${parts})
if(GRAZE_TBB)
  set(users ${parts})
  list(REMOVE_ITEM users graze-io)
  add_library_of_others(onetbb TBB::tbb "${TBB_VERSION}" Apache-2.0 ${users})
endif()
if(TARGET graze_io)
  foreach(package assimp nlohmann_json PNG spdlog ZLIB)
    find_package(${package} REQUIRED)
  endforeach()
  set(users ${parts})
  list(REMOVE_ITEM users graze graze-c)
  add_library_of_others(assimp assimp::assimp "${assimp_VERSION}" BSD-3-Clause ${users})
  add_library_of_others(nlohmann-json nlohmann_json::nlohmann_json "${nlohmann_json_VERSION}" MIT ${users})
  add_library_of_others(libpng PNG::PNG "${PNG_VERSION_STRING}" libpng-2.0 ${users})
  add_library_of_others(spdlog spdlog::spdlog "${spdlog_VERSION}" MIT ${users})
  if(TARGET fmt::fmt)  # spdlog has one of its own, or is built with this one
    add_library_of_others(fmt fmt::fmt "${fmt_VERSION}" MIT ${users})
  endif()
  add_library_of_others(zlib ZLIB::ZLIB "${ZLIB_VERSION_STRING}" Zlib ${users})
endif()
if(TARGET graze_program)
  relate(graze-program STATIC_LINK graze-io)
  find_package(CLI11 REQUIRED)
  add_library_of_others(cli11 CLI11::CLI11 "${CLI11_VERSION}" BSD-3-Clause graze-program)
  # The page within the program has what its package.json depends on. The lock has versions and licences.
  find_program(npm npm NO_CACHE)
  if(NOT GRAZE_VIEWER STREQUAL "OFF" AND npm)
    file(READ ${PROJECT_SOURCE_DIR}/tools/viewer/package-lock.json lock)
    string(JSON names GET "${lock}" packages "" dependencies)
    string(JSON count LENGTH "${names}")
    math(EXPR last "${count} - 1")
    foreach(index RANGE ${last})
      string(JSON name MEMBER "${names}" ${index})
      foreach(key version license)
        string(JSON ${key} GET "${lock}" packages "node_modules/${name}" ${key})
      endforeach()
      add_package(${name} ${version} ${license} "pkg:npm/${name}@${version}"
        https://registry.npmjs.org/${name}/-/${name}-${version}.tgz)
      relate(graze-program CONTAINS ${name})
    endforeach()
  endif()
endif()

string(SHA256 hash "${sbom_packages}${sbom_relationships}")
string(SUBSTRING ${hash} 0 32 hash)
string(TIMESTAMP created "%Y-%m-%dT%H:%M:%SZ" UTC)
file(CONFIGURE OUTPUT ${sbom} @ONLY CONTENT [[{
  "spdxVersion": "SPDX-2.3",
  "dataLicense": "CC0-1.0",
  "SPDXID": "SPDXRef-DOCUMENT",
  "name": "graze-@PROJECT_VERSION@",
  "documentNamespace": "https://graze.invalid/spdx/graze-@PROJECT_VERSION@-@hash@",
  "creationInfo": {"created": "@created@", "creators": ["Tool: graze-sbom.cmake"]},
  "packages": @sbom_packages@,
  "relationships": @sbom_relationships@
}
]])
install(FILES ${sbom} DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/graze COMPONENT graze_sbom)
