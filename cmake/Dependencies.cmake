# Debian 12 packages only. Heavy ones are private to one module's .cpp files.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(TBB REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenEXR CONFIG REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(CLI11 REQUIRED)
find_path(OPENNI2_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2 REQUIRED)
find_library(OPENNI2_LIBRARY OpenNI2 REQUIRED)
add_library(OpenNI2::OpenNI2 UNKNOWN IMPORTED)
set_target_properties(OpenNI2::OpenNI2 PROPERTIES
  IMPORTED_LOCATION ${OPENNI2_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${OPENNI2_INCLUDE_DIR})
# Debian's PCL asks for optional parts that are not installed; only its own are used here.
set(FATHOM_PCL_COMPONENTS common io kdtree search sample_consensus segmentation filters features registration)
find_package(PCL 1.12 REQUIRED QUIET COMPONENTS ${FATHOM_PCL_COMPONENTS})

# PCL's variables as one target, with its include folders marked as system headers.
add_library(fathom_pcl INTERFACE)
target_include_directories(fathom_pcl SYSTEM INTERFACE ${PCL_INCLUDE_DIRS})
target_link_libraries(fathom_pcl INTERFACE ${PCL_LIBRARIES})
if(FATHOM_BENCH)
  find_package(benchmark REQUIRED)
  find_package(OpenCV REQUIRED COMPONENTS core calib3d imgproc)
endif()
if(FATHOM_TESTS)
  find_package(GTest REQUIRED)
endif()
