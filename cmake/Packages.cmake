# Debian packages by CPack (scripts/package): one for each component of cmake/Install.cmake.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "Fathom developers")
set(CPACK_PACKAGE_CONTACT "Fathom developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)

# fathom_deb(COMPONENT PACKAGE DESCRIPTION [ALL] [DEPENDS ...] [RECOMMENDS ...] [SUGGESTS ...]): what shared libraries need is found by
# dpkg-shlibdeps; DEPENDS is what they do not say. ALL: for any architecture. The first line of the description is its synopsis.
function(fathom_deb component package description)
  cmake_parse_arguments(ARG "ALL" "" "DEPENDS;RECOMMENDS;SUGGESTS" ${ARGN})
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/debian/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  string(TOUPPER ${component} name)
  set(CPACK_DEBIAN_${name}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${name}_DESCRIPTION "${description}" PARENT_SCOPE)
  foreach(kind DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN ARG_${kind} ", " others)
    set(CPACK_DEBIAN_${name}_PACKAGE_${kind} "${others}" PARENT_SCOPE)
  endforeach()
  if(ARG_ALL)
    set(CPACK_DEBIAN_${name}_PACKAGE_ARCHITECTURE all PARENT_SCOPE)
    set(CPACK_DEBIAN_${name}_PACKAGE_SHLIBDEPS OFF PARENT_SCOPE)
  endif()
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

set(this_data "fathom-data (= ${PROJECT_VERSION})")
set(CPACK_COMPONENTS_ALL "")
fathom_deb(data fathom-data "Cups, liquids, sensors and scenes of Fathom
What the program fathom, its library and its device of OpenNI2 read: descriptions of
cups, walls, media and sensors, each with its source, and scenes to begin with." ALL)
fathom_deb(program fathom "Simulator of a depth camera that looks at cups with liquids
Simulates a structured-light depth camera (ASUS Xtion PRO LIVE, Kinect v1) that looks
at cups with liquids in them, finds cups and liquids in simulated or measured clouds,
and says where a measurement disagrees with its model."
  DEPENDS ${this_data} RECOMMENDS "gnuplot-nox | gnuplot" libjs-three SUGGESTS libfathom-openni2)
fathom_deb(development libfathom-dev "Libraries and headers of Fathom
Static libraries of the simulator, the detector and the diagnosis, for C++ programs
that find them by find_package(Fathom) or pkg-config."
  DEPENDS ${this_data} libeigen3-dev libembree-dev libfmt-dev libfontconfig-dev liblzf-dev libopenexr-dev libpcl-dev libpng-dev libssl-dev libtbb-dev
          nlohmann-json3-dev)
fathom_deb(openni2 libfathom-openni2 "Virtual Xtion for programs that use OpenNI2
A driver by which programs that read an Xtion read Fathom's scenes and captures: the
path of a scene file or of a captured folder is the URI of a device."
  DEPENDS ${this_data} libopenni2-0)

if(TARGET _fathom)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  fathom_deb(python python3-fathom "Fathom in Python and NumPy
The simulator of a depth camera that looks at cups with liquids, the detector and the
diagnosis, as functions that take and return arrays: import fathom."
    DEPENDS ${this_data} "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})"
            "python3 (<< ${Python_VERSION_MAJOR}.${next_minor})" python3-numpy)
  # They make and remove what Python compiles.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst ${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
endif()

include(CPack)
