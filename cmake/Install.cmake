# `cmake --install` and find_package(Fathom): the program, the modules with their headers, the scenes.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Fathom)
get_property(modules GLOBAL PROPERTY FATHOM_MODULES)

# Fathom::sim stands for every module below sim/.
add_library(fathom_sim INTERFACE)
add_library(Fathom::sim ALIAS fathom_sim)
set_target_properties(fathom_sim PROPERTIES EXPORT_NAME sim)

install(TARGETS fathom)
install(TARGETS ${modules} fathom_sim fathom_settings fathom_pcl EXPORT FathomTargets)
foreach(module IN LISTS modules)
  get_target_property(folder ${module} SOURCE_DIR)
  cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
  install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fathom/${folder} FILES_MATCHING PATTERN *.h)
  if(folder MATCHES ^sim/)
    target_link_libraries(fathom_sim INTERFACE ${module})
  endif()
endforeach()
if(EXISTS ${PROJECT_SOURCE_DIR}/scenes)
  install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/fathom)
endif()

install(EXPORT FathomTargets NAMESPACE Fathom:: DESTINATION ${package_folder})
list(JOIN FATHOM_PCL_COMPONENTS " " pcl_components)
configure_package_config_file(cmake/FathomConfig.cmake.in FathomConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(FathomConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/FathomConfig.cmake ${PROJECT_BINARY_DIR}/FathomConfigVersion.cmake
  DESTINATION ${package_folder})
