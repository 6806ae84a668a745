# Installs the build into a fresh prefix, then builds and runs programs that know nothing but that prefix.
file(REMOVE_RECURSE ${scratch})
function(run)
  execute_process(COMMAND ${CMAKE_COMMAND} ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(--install ${build} --prefix ${scratch}/prefix)
run(-S ${consumer} -B ${scratch}/build -G ${generator} -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${scratch}/prefix
    -Dexamples=${examples})
run(--build ${scratch}/build)
run(-E env --unset=FATHOM_DATA ${scratch}/build/consumer)
run(-E env ${scratch}/build/examples/find_cups ${scratch}/prefix/share/fathom/scenes/templates/paper_cup.pcd)
if(simulator)
  run(-E env ${scratch}/prefix/bin/fathom --version)
endif()
