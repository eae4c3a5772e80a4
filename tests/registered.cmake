# The tests that need more than a line of CMake: GL, the command line, and the scripts' checks of the project itself.

# Mesa keeps what it allocated until the process ends; the leak checker would blame us.
set(gl_environment "")
if(LIGHTSWEEP_SANITIZE)
  set(gl_environment "ASAN_OPTIONS=detect_leaks=0")
endif()

if(TARGET gl_tests)
  # What measures time gets the machine for itself.
  set(timed "TimerSelfTest.*:GroupRunner.*:Harness.*:Paths/ByHand.*")
  gtest_discover_tests(gl_tests TEST_PREFIX gl. DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES TEST_FILTER "-${timed}"
                       PROPERTIES LABELS gl TIMEOUT 300 ENVIRONMENT "${gl_environment}")
  gtest_discover_tests(gl_tests TEST_PREFIX gl. DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES TEST_FILTER "${timed}"
                       PROPERTIES LABELS gl TIMEOUT 300 RUN_SERIAL ON ENVIRONMENT "${gl_environment}")
  # Through OSMesa once more: what the driver's own glue could break (context, uploads, every layout and format, read-back).
  gtest_discover_tests(gl_tests TEST_PREFIX osmesa. DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES
                       TEST_FILTER "Shipped/EveryLayout.*:Scenes/EveryPath.EqualsForward/*:LightVolumes.*"
                       PROPERTIES LABELS osmesa TIMEOUT 300 ENVIRONMENT "LIGHTSWEEP_TEST_DEVICE=osmesa;${gl_environment}")
endif()

# tests/cli/*_test.py: the program and the scripts from the outside, as a shell sees them.
file(GLOB cli_tests CONFIGURE_DEPENDS cli/*_test.py)
foreach(file IN LISTS cli_tests)
  get_filename_component(name ${file} NAME_WE)
  string(REPLACE "_test" "" name ${name})
  add_test(NAME cli.${name} COMMAND ${LIGHTSWEEP_PYTHON} -B ${file})
  set_tests_properties(cli.${name} PROPERTIES LABELS cli TIMEOUT 300 ENVIRONMENT
                       "LIGHTSWEEP_PROGRAM=$<TARGET_FILE:lightsweep>;LIGHTSWEEP_BUILD=${PROJECT_BINARY_DIR};${gl_environment}")
endforeach()

add_test(NAME check.floors COMMAND ${LIGHTSWEEP_PYTHON} -B ${PROJECT_SOURCE_DIR}/scripts/check_floors.py)
file(GLOB_RECURSE committed_reports CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/results/*report.json)
if(committed_reports)
  add_test(NAME check.committed_reports
           COMMAND ${LIGHTSWEEP_PYTHON} -B ${PROJECT_SOURCE_DIR}/scripts/check_report.py ${committed_reports})
endif()
