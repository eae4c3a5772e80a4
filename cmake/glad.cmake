# The GL loader, generated at build time from the registry that python3-glad carries: no network, no checked-in code.
set(glad_dir ${CMAKE_CURRENT_BINARY_DIR}/glad)
set(glad_files ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h)
add_custom_command(
  OUTPUT ${glad_files}
  COMMAND ${LIGHTSWEEP_PYTHON} -m glad --quiet --reproducible --api gl:core=4.5 --extensions GL_KHR_debug
          --out-path ${glad_dir} c
  COMMENT "Generating the GL 4.5 core loader"
  VERBATIM)
add_library(lightsweep_glad STATIC ${glad_files})
target_include_directories(lightsweep_glad SYSTEM PUBLIC ${glad_dir}/include)
