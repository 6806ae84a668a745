# Installs the build into a fresh prefix, then builds and runs a program that knows nothing but that prefix.
file(REMOVE_RECURSE ${scratch})
foreach(command
    "--install;${build};--prefix;${scratch}/prefix"
    "-S;${consumer};-B;${scratch}/build;-G;${generator};-DCMAKE_BUILD_TYPE=Release;-DCMAKE_PREFIX_PATH=${scratch}/prefix"
    "--build;${scratch}/build"
    "-E;env;--unset=FATHOM_DATA;${scratch}/build/consumer"
    "-E;env;${scratch}/prefix/bin/fathom;--version")
  execute_process(COMMAND ${CMAKE_COMMAND} ${command} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endforeach()
