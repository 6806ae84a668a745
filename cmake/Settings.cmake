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
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/fathom>)
# Results must not depend on how the compiler contracts a*b+c, so that every build gives the same bytes. Neither errno nor
# floating-point traps are looked at; without them loops with square roots and rounding become vectors.
target_compile_options(fathom_settings INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion;-ffp-contract=off;-fno-math-errno;-fno-trapping-math>)
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

# fathom_module(NAME SOURCES... [PUBLIC targets...] [PRIVATE targets...]): one static library, exported as Fathom::NAME.
function(fathom_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(fathom_${name} STATIC ${ARG_SOURCES})
  add_library(Fathom::${name} ALIAS fathom_${name})
  set_target_properties(fathom_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(fathom_${name} PUBLIC fathom_settings ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  set_property(GLOBAL APPEND PROPERTY FATHOM_MODULES fathom_${name})
endfunction()
