# Installs the engine below the build tree, moves the tree, and builds and runs the consumer against it, once through
# find_package and once through pkg-config; the same for a program that includes physics_effects.h, as C++14 and 17. Called by ctest: cmake -DBUILD=... -DSOURCE=... -P package_test.cmake

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

file(GLOB_RECURSE pc_file_compat ${work}/moved/physics_effects.pc)
if(pc_file_compat)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE}/compat_consumer -B ${work}/compat_consumer -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${work}/moved)
  run(${CMAKE_COMMAND} --build ${work}/compat_consumer)
  run(${work}/compat_consumer/fall)
  foreach(standard 14 17)
    run(${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${pc_dir} sh -c
      "${CXX} -std=c++${standard} -Wall -Wextra -Werror -O1 ${SOURCE}/compat_consumer/fall.cpp -o ${work}/fall $(pkg-config --cflags --libs physics_effects)")
    run(${work}/fall)
  endforeach()
endif()
