# Shaders as files: checked with glslangValidator where it is installed, embedded in the module's
# library, found by name at run time (gl/shader_library.h).
#
# pleinair_embed_shaders(<module> FILES shaders/a.vert shaders/b.glsl ...)
#   Adds the files to the target pleinair_<module> and generates the header
#   "<module>/embedded_shaders.h" with `void pleinair::<module>::RegisterShaders()`. A shader's name
#   is its path in the source tree, "<module>/shaders/a.vert"; `#include "<module>/shaders/b.glsl"`
#   names it the same way. Files ending in .vert, .frag, .geom or .comp are validated; .glsl files
#   are only included by others.

find_program(PLEINAIR_GLSLANG_VALIDATOR glslangValidator)
if(NOT PLEINAIR_GLSLANG_VALIDATOR)
  message(STATUS "glslangValidator not found: shaders are checked by the driver only, at run time")
endif()
set(PLEINAIR_VALIDATE_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/ValidateShader.cmake)
set(PLEINAIR_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/EmbedShaders.cmake)

function(pleinair_embed_shaders module)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(paths)
  set(stamps)
  # Every .glsl of the tree may be included by any stage: cheap enough to revalidate on a change.
  file(GLOB includes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/*/shaders/*.glsl)
  foreach(file IN LISTS ARG_FILES)
    set(path ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    list(APPEND paths ${path})
    if(PLEINAIR_GLSLANG_VALIDATOR AND NOT file MATCHES "\\.glsl$")
      string(REPLACE "/" "_" flat "${module}/${file}")
      set(stamp ${CMAKE_CURRENT_BINARY_DIR}/validated/${flat})
      add_custom_command(OUTPUT ${stamp}
        COMMAND ${CMAKE_COMMAND} -DVALIDATOR=${PLEINAIR_GLSLANG_VALIDATOR} -DSHADER=${path}
                -DROOT=${PROJECT_SOURCE_DIR} -DCOPY=${stamp} -P ${PLEINAIR_VALIDATE_SCRIPT}
        DEPENDS ${path} ${includes} ${PLEINAIR_VALIDATE_SCRIPT}
        COMMENT "Validating ${module}/${file}" VERBATIM)
      list(APPEND stamps ${stamp})
    endif()
  endforeach()

  set(generated ${PROJECT_BINARY_DIR}/generated/${module}/embedded_shaders)
  add_custom_command(OUTPUT ${generated}.cc ${generated}.h
    COMMAND ${CMAKE_COMMAND} -DMODULE=${module} -DROOT=${PROJECT_SOURCE_DIR}
            -DOUTPUT=${generated} "-DFILES=${paths}" -P ${PLEINAIR_EMBED_SCRIPT}
    DEPENDS ${paths} ${stamps} ${PLEINAIR_EMBED_SCRIPT}
    COMMENT "Embedding the shaders of ${module}" VERBATIM)
  target_sources(pleinair_${module} PRIVATE ${generated}.cc ${generated}.h)
  target_include_directories(pleinair_${module} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/generated>)
endfunction()
