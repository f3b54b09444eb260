# Run by PleinairShaders.cmake: checks SHADER with VALIDATOR; includes are found under ROOT. COPY is
# where the text goes with the extension that glslangValidator wants before it reads an #include
# (drivers read shaders with their includes resolved and know no such extension).
file(READ ${SHADER} text)
string(REGEX REPLACE "(#version[^\n]*\n)"
       "\\1#extension GL_GOOGLE_include_directive : require\n#line 2\n" text "${text}")
file(WRITE ${COPY} "${text}")
execute_process(COMMAND ${VALIDATOR} -l -I${ROOT} ${COPY}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
# Its includes are honoured only together with -l, which links the one stage.
if(NOT result EQUAL 0)
  file(REMOVE ${COPY})
  message(FATAL_ERROR "${SHADER} is not valid:\n${output}")
endif()
