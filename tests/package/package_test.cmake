# Installs the engine below the build tree, moves the tree, and builds and runs the consumer against it, once through
# find_package and once through pkg-config. Called by ctest: cmake -DBUILD=... -DSOURCE=... -P package_test.cmake

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${code}): ${command}")
  endif()
endfunction()

set(work ${BUILD}/package_test)
file(REMOVE_RECURSE ${work})
run(${CMAKE_COMMAND} --install ${BUILD} --component pfx --prefix ${work}/first)
file(RENAME ${work}/first ${work}/moved)

run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/consumer -B ${work}/consumer -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${work}/moved)
run(${CMAKE_COMMAND} --build ${work}/consumer)
run(${work}/consumer/drop)

file(GLOB_RECURSE pc_file ${work}/moved/pfx.pc)
cmake_path(GET pc_file PARENT_PATH pc_dir)
run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_dir} sh -c
  "${CXX} -std=c++20 -O1 ${SOURCE}/consumer/drop.cpp -o ${work}/drop $(pkg-config --cflags --libs pfx)")
run(${work}/drop)
