# `cmake --install`, find_package(Fathom) and pkg-config: the program, the libraries with their public headers, the scenes.
# Each component is a Debian package (Packages.cmake): data, program, development, openni2, python.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Fathom)
get_property(modules GLOBAL PROPERTY FATHOM_INSTALLED_MODULES)
get_property(headers GLOBAL PROPERTY FATHOM_INSTALLED_HEADERS)

if(EXISTS ${PROJECT_SOURCE_DIR}/scenes)
  install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/fathom COMPONENT data)
endif()

if(FATHOM_SIMULATOR)
  install(TARGETS fathom COMPONENT program)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program OPTIONAL)
  # Fathom::sim stands for every module below sim/.
  add_library(fathom_sim INTERFACE)
  add_library(Fathom::sim ALIAS fathom_sim)
  set_target_properties(fathom_sim PROPERTIES EXPORT_NAME sim)
  # Fathom::diagnosis: the same below diagnosis/, and its words and pages.
  add_library(fathom_diagnosis INTERFACE)
  add_library(Fathom::diagnosis ALIAS fathom_diagnosis)
  set_target_properties(fathom_diagnosis PROPERTIES EXPORT_NAME diagnosis)
  install(TARGETS fathom_sim fathom_diagnosis EXPORT FathomTargets COMPONENT development)
endif()
foreach(module IN LISTS modules)
  get_target_property(folder ${module} SOURCE_DIR)
  cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
  if(folder MATCHES ^sim/)
    target_link_libraries(fathom_sim INTERFACE ${module})
  elseif(folder MATCHES "^(diagnosis/|report$)")
    target_link_libraries(fathom_diagnosis INTERFACE ${module})
  endif()
endforeach()
install(TARGETS ${modules} fathom_settings fathom_pcl EXPORT FathomTargets COMPONENT development)

set(public_headers ${PROJECT_BINARY_DIR}/public_headers)
install(CODE "execute_process(COMMAND \"${CMAKE_COMMAND}\" \"-Dsource=${PROJECT_SOURCE_DIR}\" \"-Doutput=${public_headers}\"
  \"-Dheaders=${headers}\" -P \"${PROJECT_SOURCE_DIR}/cmake/PublicHeaders.cmake\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT development)
install(DIRECTORY ${public_headers}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fathom COMPONENT development)

install(EXPORT FathomTargets NAMESPACE Fathom:: DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(cmake/FathomConfig.cmake.in FathomConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(FathomConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/FathomConfig.cmake ${PROJECT_BINARY_DIR}/FathomConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT development)

# A static library stands before those that it needs: modules in the reverse of the order in which they were added.
set(pkgconfig_libraries ${modules})
list(REVERSE pkgconfig_libraries)
list(APPEND pkgconfig_libraries pcl_common lz4)
set(pkgconfig_requires eigen3 fmt libcrypto liblzf libpng nlohmann_json OpenEXR tbb)
if(FATHOM_SIMULATOR)
  list(APPEND pkgconfig_libraries embree3)
  list(APPEND pkgconfig_requires fontconfig)
endif()
list(TRANSFORM pkgconfig_libraries PREPEND -l)
list(JOIN pkgconfig_libraries " " pkgconfig_libraries)
list(JOIN pkgconfig_requires " " pkgconfig_requires)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE prefix_from_here)
configure_file(cmake/fathom.pc.in fathom.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/fathom.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
