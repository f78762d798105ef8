# cmake -DBUILD=... -DSOURCE=... -DWORK=... -DVERSION=... -P check.cmake: installs the build into WORK,
# runs the program from there, and builds and runs the consumer against it. Fails where any step does.
file(REMOVE_RECURSE ${WORK})
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${out}${err}")
  endif()
  set(out "${out}" PARENT_SCOPE)
endfunction()
function(expect text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "expected ${pattern}, got ${text}")
  endif()
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/there)
run(${WORK}/there/bin/scattermeter --version)
expect("${out}" "scattermeter ${VERSION}\nbuilt with .*Embree 3.*LibRaw 0.*")
foreach(file share/man/man1/scattermeter.1.gz share/man/man1/scattermeter-bench.1.gz
             share/bash-completion/completions/scattermeter
             share/scattermeter/rig.schema.json share/scattermeter/result.schema.json
             share/doc/scattermeter/copyright
             include/scattermeter/core/material/dipole.h
             include/scattermeter/apps/instrument/measure.h)
  if(NOT EXISTS ${WORK}/there/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/install -B ${WORK}/consumer -G Ninja
    -DCMAKE_PREFIX_PATH=${WORK}/there -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/consumer)
# By hand, alpha' = 2.19 / 2.192: the dipole with A of eta 1.3, and van de Hulst's (1 - s)(1 - 0.139 s) /
# (1 + 1.17 s), s = 0.030206, which is within 1e-4 there.
expect("${out}" "^0\\.8[0-9]+ 0\\.9327[0-9]+ 4\n$")
# The instrument from C++ and from Python, on the sample's rig at an eighth of its size; no program is
# started by either.
file(MAKE_DIRECTORY ${WORK}/small)
# Statements are parted by line ends: a semicolon would part the arguments here.
run(${PYTHON} -c "import sys, pathlib
sys.path.insert(0, '${SOURCE}/tests/road')
from small_rig import write_small_rig
write_small_rig(pathlib.Path('${SOURCE}/samples/three_plastics'), '${WORK}/small')")
run(${WORK}/there/bin/scattermeter --quiet simulate ${WORK}/small/rig.yaml --out ${WORK}/small/shots)
run(${WORK}/consumer/measure ${WORK}/small/rig.yaml ${WORK}/small/shots)
expect("${out}" "^PP     R [0-9.]+ \\+- [0-9.]+ [0-9.]+ \\+- [0-9.]+ ok\n")
if(EXISTS ${WORK}/there/lib/python3/dist-packages/scattermeter)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${WORK}/there/lib/python3/dist-packages PATH=/nowhere
      /usr/bin/python3 -c "import scattermeter
print(scattermeter.measure('${WORK}/small/shots', '${WORK}/small/rig.yaml', model='dipole'))")
  expect("${out}" "\nPP +R +[0-9.]+ \\+- [0-9.]+ .* dipole +ok")
endif()
message(STATUS "installed, and used: ${out}")
file(REMOVE_RECURSE ${WORK})
