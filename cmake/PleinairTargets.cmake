# Functions that give every target of the project the same settings.
include(PleinairUnity)

# Warnings, sanitizers and include path of our own code.
function(pleinair_configure_target target)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/pleinair>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                         # GCC 12 sees overlaps in "literal" + std::string that are not there (PR 105651).
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
                         # And members of an empty std::optional that are read nowhere (PR 80635).
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>
                         $<$<BOOL:${PLEINAIR_WERROR}>:-Werror>)
  if(PLEINAIR_FUZZERS)
    # Without this a fuzzer sees no coverage of the code that it is there for.
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  if(PLEINAIR_SANITIZE)
    list(JOIN PLEINAIR_SANITIZE "," sanitizers)
    target_compile_options(${target} PUBLIC $<BUILD_INTERFACE:-fsanitize=${sanitizers}>
                           $<BUILD_INTERFACE:-fno-omit-frame-pointer>)
    target_link_options(${target} PUBLIC $<BUILD_INTERFACE:-fsanitize=${sanitizers}>)
    if("undefined" IN_LIST PLEINAIR_SANITIZE)
      target_compile_options(${target} PUBLIC $<BUILD_INTERFACE:-fno-sanitize-recover=undefined>)
      # Relative, where compilers run: ccache takes an absolute path for another option elsewhere.
      file(RELATIVE_PATH ignorelist ${CMAKE_BINARY_DIR}
           ${PROJECT_SOURCE_DIR}/scripts/sanitizers/library_headers.ignore)
      target_compile_options(${target} PRIVATE
        $<$<CXX_COMPILER_ID:Clang>:-fsanitize-ignorelist=${ignorelist}>)
    endif()
  endif()
  if(PLEINAIR_UNITY)
    # GCC takes an included source for a header, whose classes others could see.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    # Sub-folders may add sources, until the whole tree is read.
    cmake_language(EVAL CODE
      "cmake_language(DEFER DIRECTORY [[${PROJECT_SOURCE_DIR}]] CALL pleinair_unite_sources ${target})")
  endif()
endfunction()

# pleinair_library(NAME SOURCES ... [PUBLIC ...] [PRIVATE ...]): module library with the alias pleinair::NAME.
function(pleinair_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(pleinair_${name} STATIC ${ARG_SOURCES})
  add_library(pleinair::${name} ALIAS pleinair_${name})
  set_target_properties(pleinair_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(pleinair_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  pleinair_configure_target(pleinair_${name})
endfunction()

# Compiles the sources of a target but those that match the regular expression with less optimisation
# in a release: they run rarely, and their templates (JSON, formatting, the command line) take longest
# to compile. Sanitized builds have their own.
function(pleinair_optimize_lightly target except)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "${except}")
  foreach(source IN LISTS sources)
    get_source_file_property(options ${source} COMPILE_OPTIONS)
    if(NOT options)
      set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
    endif()
  endforeach()
endfunction()

# pleinair_test(NAME SOURCES ... LIBS ... [LABELS ...]): a GoogleTest program, each test known to ctest.
function(pleinair_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} pleinair_source_tree GTest::gmock_main)
  pleinair_configure_target(${name})
  # What a test says takes longer to compile than to run; the code under test keeps its optimisation
  # (not so at -O0: the linker would take inline functions of libraries from the test's objects).
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  pleinair_list_program(${name} test ${ARG_SOURCES})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT 600)
endfunction()

# pleinair_fuzzer(NAME SOURCES ... LIBS ...): a libFuzzer target (clang only).
function(pleinair_fuzzer name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS})
  pleinair_configure_target(${name})
  target_compile_options(${name} PRIVATE -fsanitize=fuzzer)
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  pleinair_list_program(${name} fuzzer ${ARG_SOURCES})
endfunction()

# Adds a line "KIND TARGET FOLDER SOURCES..." to the list of test programs and fuzz targets, by which
# scripts/reached_tests chooses among them.
function(pleinair_list_program name kind)
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}
             OUTPUT_VARIABLE folder)
  set(line "${kind} ${name} ${folder}")
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source NORMALIZE)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    string(APPEND line " ${source}")
  endforeach()
  set_property(GLOBAL APPEND_STRING PROPERTY PLEINAIR_PROGRAMS "${line}\n")
endfunction()
