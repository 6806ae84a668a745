# Language level, warnings and sanitizers: one INTERFACE target that every module links.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

add_library(fathom_settings INTERFACE)
target_compile_features(fathom_settings INTERFACE cxx_std_20)
target_include_directories(fathom_settings INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
# Results must not depend on how the compiler contracts a*b+c, so that every build gives the same bytes. Neither errno nor
# floating-point traps are looked at; without them loops with square roots and rounding become vectors.
target_compile_options(fathom_settings INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion;-ffp-contract=off;-fno-math-errno;-fno-trapping-math>)
# GCC collects its garbage so early that a tenth of the time goes there; it may take 1 GB first.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  target_compile_options(fathom_settings INTERFACE $<BUILD_INTERFACE:--param=ggc-min-heapsize=1000000>)
endif()
if(FATHOM_WARNINGS_AS_ERRORS)
  target_compile_options(fathom_settings INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(FATHOM_SANITIZE)
  # Under a sanitizer Eigen would align memory by hand, and free so what Debian's PCL took from malloc.
  target_compile_definitions(fathom_settings INTERFACE $<BUILD_INTERFACE:EIGEN_MALLOC_ALREADY_ALIGNED=1>)
  target_compile_options(fathom_settings INTERFACE
    $<BUILD_INTERFACE:-fsanitize=${FATHOM_SANITIZE};-fno-omit-frame-pointer;-fno-sanitize-recover=all>)
  target_link_options(fathom_settings INTERFACE $<BUILD_INTERFACE:-fsanitize=${FATHOM_SANITIZE}>)
endif()
if(FATHOM_FUZZ)
  target_compile_options(fathom_settings INTERFACE $<BUILD_INTERFACE:-fsanitize=fuzzer-no-link>)
endif()

# Most files read the same headers of libraries for a second or two: targets that use fmt read them compiled.
# GCC takes a compiled header only with the very options and macros that it was made with, so modules, the program and the tests have one each.
# The presets sanitize, tsan and fuzz read the headers themselves, and so find a file that forgets one.
option(FATHOM_PRECOMPILE "Compile the headers of libraries once, not in every file" ON)
set(FATHOM_PRECOMPILED <Eigen/Geometry> <filesystem> <fmt/format.h> <functional> <map> <nlohmann/json.hpp>)

# What takes most of a file's time is not its own: templates of Eigen, nlohmann and GoogleTest that every file instantiates
# again, even where a precompiled header has them. So sixteen files are compiled as one: two units of eight, made one, take an
# eighth less.
# Those presets compile each file alone as well; who works on a file may do so, too.
option(FATHOM_UNITY "Compile several files as one" ON)
set(CMAKE_UNITY_BUILD ${FATHOM_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)
if(FATHOM_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # Unity builds include sources, which GCC then treats as headers.
  target_compile_options(fathom_settings INTERFACE $<BUILD_INTERFACE:-Wno-subobject-linkage>)
endif()

# fathom_precompiled(NAME [HEADERS...] [LINK targets...] [OPTIONS options...] [FOR_PROGRAMS]): what
# fathom_use_precompiled(TARGET NAME) shares.
function(fathom_precompiled name)
  cmake_parse_arguments(ARG "FOR_PROGRAMS" "" "HEADERS;LINK;OPTIONS" ${ARGN})
  if(NOT FATHOM_PRECOMPILE)
    return()
  endif()
  file(CONFIGURE OUTPUT ${name}.cpp CONTENT "")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE fathom_settings Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json ${ARG_LINK})
  if(ARG_FOR_PROGRAMS)
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${name} PRIVATE -fPIE)
  endif()
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(${name} PRIVATE ${FATHOM_PRECOMPILED} ${ARG_HEADERS})
endfunction()

function(fathom_use_precompiled target name)
  get_target_property(libraries ${target} LINK_LIBRARIES)
  # PCL brings an option of position-independent code that others do not have.
  if(TARGET ${name} AND "fmt::fmt" IN_LIST libraries AND NOT fathom_pcl IN_LIST libraries AND NOT fathom_all_pcl IN_LIST libraries)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

# fathom_module(NAME SOURCES... [HEADERS...] [PUBLIC targets...] [PRIVATE targets...]): one static library. One with HEADERS, which are what other
# programs are to call, is installed with them and exported as Fathom::NAME.
function(fathom_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  add_library(fathom_${name} STATIC ${ARG_SOURCES})
  add_library(Fathom::${name} ALIAS fathom_${name})
  set_target_properties(fathom_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(fathom_${name} PUBLIC fathom_settings ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  fathom_use_precompiled(fathom_${name} fathom_precompiled_modules)
  if(ARG_HEADERS)
    cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
    list(TRANSFORM ARG_HEADERS PREPEND ${folder}/)
    set_property(GLOBAL APPEND PROPERTY FATHOM_INSTALLED_MODULES fathom_${name})
    set_property(GLOBAL APPEND PROPERTY FATHOM_INSTALLED_HEADERS ${ARG_HEADERS})
  endif()
endfunction()
