# lightsweep_room(<name> DIR <folder> [LINK public...] [PRIVATE private...]): one static library per room of the house,
# from every .cpp in its folder. A new file needs no registration here.
add_library(lightsweep_options INTERFACE)
target_compile_options(lightsweep_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow
                       $<$<BOOL:${LIGHTSWEEP_WERROR}>:-Werror>)
# GCC 12 sees overlapping copies in `"text" + std::string` that are not there (GCC bug 105651).
target_compile_options(lightsweep_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# The CPU stages and metrics are floating-point loops; contraction to FMA would make results differ between machines.
target_compile_options(lightsweep_options INTERFACE -ffp-contract=off)
if(LIGHTSWEEP_SANITIZE)
  target_compile_options(lightsweep_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                         -fno-omit-frame-pointer
                         # GCC 12 finds uninitialised values inside std::regex under the sanitizers; there are none.
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(lightsweep_options INTERFACE -fsanitize=address,undefined)
endif()

function(lightsweep_room name)
  cmake_parse_arguments(ROOM "" "DIR" "LINK;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${ROOM_DIR}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${ROOM_DIR}/*.h)
  add_library(lightsweep_${name} STATIC)
  target_sources(lightsweep_${name} PRIVATE ${sources}
                 PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  set_target_properties(lightsweep_${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  target_link_libraries(lightsweep_${name} PUBLIC ${ROOM_LINK} PRIVATE lightsweep_options ${ROOM_PRIVATE})
endfunction()
