# The tests that need more than a line of CMake: GL, the command line, and the scripts' checks of the project itself.

# Mesa keeps what it allocated until the process ends; the leak checker would blame us.
set(gl_environment "")
if(LIGHTSWEEP_SANITIZE)
  set(gl_environment "ASAN_OPTIONS=detect_leaks=0")
endif()

if(TARGET gl_tests)
  # Starting a context takes longer than most tests: each process takes a share of them. What measures time gets the
  # machine for itself.
  function(add_gl_tests name count filter environment)
    math(EXPR last "${count} - 1")
    foreach(share RANGE ${last})
      add_test(NAME ${name}.${share} COMMAND gl_tests --gtest_brief=1 "--gtest_filter=${filter}")
      set_tests_properties(${name}.${share} PROPERTIES LABELS ${name} TIMEOUT 600 ENVIRONMENT
                           "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${share};${environment};${gl_environment}")
    endforeach()
  endfunction()
  set(timed "TimerSelfTest.*:GroupRunner.*:Harness.*:Paths/ByHand.*")
  add_gl_tests(gl 16 "-${timed}" "")
  add_gl_tests(gl.timed 1 "${timed}" "")
  set_tests_properties(gl.timed.0 PROPERTIES RUN_SERIAL ON)
  # Through OSMesa once more: what the driver's own glue could break (context, uploads, every layout and format, read-back).
  add_gl_tests(osmesa 4 "Shipped/EveryLayout.*:Scenes/EveryPath.EqualsForward/*:LightVolumes.*"
               "LIGHTSWEEP_TEST_DEVICE=osmesa")
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

# Every stress case is tried, and every planted defect: minutes of drawing, two processes at a time.
set_tests_properties(cli.stress cli.stress_defects PROPERTIES TIMEOUT 900 PROCESSORS 2)

add_test(NAME check.floors COMMAND ${LIGHTSWEEP_PYTHON} -B ${PROJECT_SOURCE_DIR}/scripts/check_floors.py)
file(GLOB_RECURSE committed_reports CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/results/*report.json
     ${PROJECT_SOURCE_DIR}/results/*stress.json)
if(committed_reports)
  add_test(NAME check.committed_reports
           COMMAND ${LIGHTSWEEP_PYTHON} -B ${PROJECT_SOURCE_DIR}/scripts/check_report.py ${committed_reports})
endif()

# tests/fuzz/<reader>_fuzz.cpp: any bytes for a reader of files. With libFuzzer (scripts/fuzz.sh) they are programs that
# search; otherwise each is a test that replays its corpus and mutations of it.
option(LIGHTSWEEP_FUZZ "Build the fuzz targets with Clang's libFuzzer, to search with" OFF)
file(GLOB fuzz_targets CONFIGURE_DEPENDS fuzz/*_fuzz.cpp)
foreach(file IN LISTS fuzz_targets)
  get_filename_component(name ${file} NAME_WE)
  string(REPLACE "_fuzz" "" reader ${name})
  add_executable(fuzz_${reader} ${file})
  target_link_libraries(fuzz_${reader} PRIVATE lightsweep_report lightsweep_gbuffer lightsweep_options)
  if(LIGHTSWEEP_FUZZ)
    target_link_options(fuzz_${reader} PRIVATE -fsanitize=fuzzer)
  else()
    target_sources(fuzz_${reader} PRIVATE fuzz/replay_main.cpp)
    add_test(NAME fuzz.${reader} COMMAND fuzz_${reader} ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/corpus/${reader})
    set_tests_properties(fuzz.${reader} PROPERTIES LABELS fuzz TIMEOUT 120)
  endif()
endforeach()
