# Tests of the project itself: who includes whom, how it is formatted, what it installs.
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_test(NAME layers COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/layers.py)
add_test(NAME layers_test COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/layers_test.py)
add_test(NAME skipped_test COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/skipped_test.py)
add_test(NAME constants_page COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/constants_page.py)
add_test(NAME links COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/links.py)
add_test(NAME docs COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/docs_test.py)
set_tests_properties(docs PROPERTIES SKIP_REGULAR_EXPRESSION "OK [(]skipped=")
set_tests_properties(layers layers_test skipped_test constants_page links PROPERTIES LABELS architecture)

if(FATHOM_SIMULATOR)
  add_test(NAME pages COMMAND ${PROJECT_SOURCE_DIR}/scripts/pages --check $<TARGET_FILE:fathom>)
  add_test(NAME manual COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/app/manual_test.py $<TARGET_FILE:fathom>)
  add_test(NAME progress COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/app/progress_test.py $<TARGET_FILE:fathom>)
  add_test(NAME examples COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/app/examples.py --quick $<TARGET_FILE:fathom>)
  add_test(NAME laboratory COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/app/laboratory_test.py $<TARGET_FILE:fathom>)
  add_test(NAME results_test COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/results_test.py)
  set_tests_properties(results_test PROPERTIES ENVIRONMENT FATHOM=$<TARGET_FILE:fathom>)
  set_tests_properties(pages PROPERTIES LABELS architecture)
  add_test(NAME datasets_load COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/datasets/load_test.py $<TARGET_FILE:fathom>)
  add_test(NAME datasets_slurm COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/datasets/slurm_test.py $<TARGET_FILE:fathom>)
  if(NOT FATHOM_SANITIZE)  # Python would load a driver with sanitizers
    add_test(NAME record_clouds COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/openni2/record_clouds_test.py $<TARGET_FILE:fathom> ${PROJECT_BINARY_DIR}/lib/fathom)
    set_tests_properties(record_clouds PROPERTIES SKIP_RETURN_CODE 77 PROCESSORS 2)
  endif()
  add_test(NAME view_page COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/view/page_test.py $<TARGET_FILE:fathom>)
  set_tests_properties(view_page PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
  set_tests_properties(datasets_load datasets_slurm PROPERTIES SKIP_RETURN_CODE 77 PROCESSORS 2 TIMEOUT 600)
endif()

find_program(FATHOM_CLANG_FORMAT clang-format-14)
if(FATHOM_CLANG_FORMAT)
  add_test(NAME format COMMAND ${PROJECT_SOURCE_DIR}/scripts/format --check)
  set_tests_properties(format PROPERTIES LABELS architecture)
endif()

if(NOT FATHOM_SANITIZE)  # a consumer would need the same sanitizer
  include(GNUInstallDirs)
  get_property(public_headers GLOBAL PROPERTY FATHOM_INSTALLED_HEADERS)
  add_test(NAME find_package COMMAND ${CMAKE_COMMAND}
    -D build=${PROJECT_BINARY_DIR} -D consumer=${CMAKE_CURRENT_SOURCE_DIR}/find_package
    -D scratch=${CMAKE_CURRENT_BINARY_DIR}/find_package -D generator=${CMAKE_GENERATOR} -D examples=${PROJECT_SOURCE_DIR}/examples
    -D simulator=${FATHOM_SIMULATOR} -D libraries=${CMAKE_INSTALL_LIBDIR} "-Dheaders=${public_headers}"
    -P ${CMAKE_CURRENT_SOURCE_DIR}/find_package/run.cmake)
endif()

# The Python module, by the Python that it is for.
if(FATHOM_PYTHON_FOUND)
  foreach(test theory capture detect diagnose folders waiting package)
    add_test(NAME python.${test} COMMAND ${FATHOM_PYTHON_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/python/${test}_test.py)
    set_tests_properties(python.${test} PROPERTIES PROCESSORS 2 TIMEOUT 600 SKIP_REGULAR_EXPRESSION "OK [(]skipped="
      ENVIRONMENT "FATHOM_PROGRAM=$<TARGET_FILE:fathom>;PYTHONPATH=${PROJECT_BINARY_DIR}/python")
  endforeach()
endif()

# Hostile inputs, kills and races; many more by hand (docs/testing.md).
if(FATHOM_SIMULATOR AND NOT FATHOM_SANITIZE)
  foreach(test "hostile --mutants 250 --quiet" "kills --kills 6" "races --races 4")
    separate_arguments(test)
    list(POP_FRONT test name)
    add_test(NAME hostile.${name} COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/hostile/${name}.py $<TARGET_FILE:fathom> ${test})
    set_tests_properties(hostile.${name} PROPERTIES TIMEOUT 1200)
  endforeach()
endif()

if(FATHOM_SIMULATOR AND NOT FATHOM_SANITIZE)
  add_test(NAME blind_smoke_test COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/blind/smoke_test.py $<TARGET_FILE:blind_score>)
  add_test(NAME blind_smoke COMMAND Python3::Interpreter -B ${CMAKE_CURRENT_SOURCE_DIR}/blind/smoke.py $<TARGET_FILE:fathom>)
  set_tests_properties(blind_smoke PROPERTIES RUN_SERIAL ON TIMEOUT 2400)
  # By Debian's Python, whose packages it needs.
  add_test(NAME worlds_test COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/blind/worlds_test.py)
  set_tests_properties(worlds_test PROPERTIES SKIP_REGULAR_EXPRESSION "OK [(]skipped=")
endif()
