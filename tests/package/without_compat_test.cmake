# Configures a copy of the project without engine/compat and asks for the plan of its build: no target may miss a file of
# that folder. That no file of another room includes one is what house/includes_never_point_upwards looks at. Called by
# ctest: cmake -DROOT=... -DWORK=... -DGENERATOR=... -DCXX=... -P without_compat_test.cmake
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/project)
foreach(entry CMakeLists.txt engine samples viewer shaders tests)
  file(COPY ${ROOT}/${entry} DESTINATION ${WORK}/project REGEX "/engine/compat$" EXCLUDE)
endforeach()
if(EXISTS ${WORK}/project/engine/compat)
  message(FATAL_ERROR "the folder is still there")
endif()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "failed (${code}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK}/project -B ${WORK}/build -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${CXX}
  -DVITRINE_TESTS=ON -DVITRINE_VIEWER=ON)
run(${CMAKE_COMMAND} --build ${WORK}/build -- -n)
if(output MATCHES "engine/compat|compat_tests|physics_effects")
  message(FATAL_ERROR "the build still speaks of it:\n${output}")
endif()
