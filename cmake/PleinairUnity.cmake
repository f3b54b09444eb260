# PLEINAIR_UNITY compiles several files of a target as one: headers and templates that they share are
# compiled once (docs/measurements/build.md). Off in the preset dev, where one changed file recompiles
# alone and each file must include what it uses.
option(PLEINAIR_UNITY "Compile several files of a target as one: a quicker whole build" OFF)
set(PLEINAIR_UNITY_LINES 3000 CACHE STRING "Lines of the files that are compiled as one, at most")
mark_as_advanced(PLEINAIR_UNITY_LINES)

# Replaces sources of the target by files that include several of them. Called when the whole tree is
# read, so that all sources are known. CMake's own UNITY_BUILD includes absolute paths, which ccache
# takes for other contents in another checkout, and compiles files with options of their own alone.
function(pleinair_unite_sources target)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  # By folder: neighbours include the same headers.
  list(SORT sources)
  set(kept)
  set(all_options)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE OUTPUT_VARIABLE file)
    # Generated files do not exist yet.
    if(NOT source MATCHES "\\.cc$" OR NOT EXISTS ${file})
      list(APPEND kept ${source})
      continue()
    endif()
    get_source_file_property(options ${file} TARGET_DIRECTORY ${target} COMPILE_OPTIONS)
    if(NOT options)
      set(options)
    endif()
    string(MAKE_C_IDENTIFIER "${target}${options}" key)
    if(NOT key IN_LIST all_options)
      list(APPEND all_options ${key})
      set(options_${key} "${options}")
    endif()
    list(APPEND files_${key} ${file})
  endforeach()

  foreach(key IN LISTS all_options)
    execute_process(
      COMMAND awk -v max_lines=${PLEINAIR_UNITY_LINES}
              -f ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/unity_batches.awk ${files_${key}}
      OUTPUT_VARIABLE lines OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\n" ";" lines "${lines}")
    set(batches)
    foreach(line IN LISTS lines)
      string(REGEX MATCH "^([0-9]+) (.*)$" line "${line}")
      list(APPEND batches ${CMAKE_MATCH_1})
      list(APPEND batch_${CMAKE_MATCH_1} ${CMAKE_MATCH_2})
    endforeach()
    list(REMOVE_DUPLICATES batches)
    foreach(batch IN LISTS batches)
      list(LENGTH batch_${batch} length)
      if(batch EQUAL 0 OR length EQUAL 1)
        list(APPEND kept ${batch_${batch}})
      else()
        set(content)
        foreach(file IN LISTS batch_${batch})
          file(RELATIVE_PATH file ${PROJECT_SOURCE_DIR} ${file})
          string(APPEND content "#include \"${file}\"\n")
        endforeach()
        set(united ${PROJECT_BINARY_DIR}/unity/${key}_${batch}.cc)
        file(CONFIGURE OUTPUT ${united} CONTENT "${content}" @ONLY)
        list(APPEND kept ${united})
        if(options_${key})
          set_source_files_properties(${united} TARGET_DIRECTORY ${target} PROPERTIES
                                      COMPILE_OPTIONS "${options_${key}}")
        endif()
      endif()
      unset(batch_${batch})
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${kept}")
endfunction()
