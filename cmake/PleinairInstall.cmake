# What `cmake --install` puts where: the command, the libraries with their public headers, and what
# find_package(pleinair) and pkg-config need. Included last, when every target exists.
include(CMakePackageConfigHelpers)

set(PLEINAIR_EXPORTED pleinair_base pleinair_files pleinair_scene pleinair_sky pleinair_clouds pleinair_gl pleinair_shadows pleinair_leaf pleinair_compositor
    pleinair_devices pleinair_tracker pleinair_calibration pleinair_session pleinair_export pleinair_april_tag)
install(TARGETS ${PLEINAIR_EXPORTED} EXPORT pleinair-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

# One name for all of them.
add_library(pleinair_pleinair INTERFACE)
add_library(pleinair::pleinair ALIAS pleinair_pleinair)
set_target_properties(pleinair_pleinair PROPERTIES EXPORT_NAME pleinair)
target_link_libraries(pleinair_pleinair INTERFACE pleinair::export pleinair::session)
target_include_directories(pleinair_pleinair INTERFACE
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS pleinair_pleinair EXPORT pleinair-targets)

# Gives the headers of ours that a header includes, itself among them.
function(pleinair_headers_reached header result)
  set(reached ${header})
  set(open ${header})
  while(open)
    list(POP_FRONT open file)
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    file(STRINGS ${PROJECT_SOURCE_DIR}/${file} includes REGEX "^#include \"")
    foreach(include IN LISTS includes)
      string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" include ${include})
      if(NOT include IN_LIST reached)
        list(APPEND reached ${include})
        list(APPEND open ${include})
      endif()
    endforeach()
  endwhile()
  set(${result} ${reached} PARENT_SCOPE)
endfunction()

# What the public face reaches, and nothing else; tests/architecture holds these headers free of GL,
# GLM, OpenCV, Eigen and Ceres.
pleinair_headers_reached(pleinair/pleinair.h headers)
foreach(header IN LISTS headers)
  cmake_path(GET header PARENT_PATH folder)
  if(folder STREQUAL "pleinair")
    set(folder "")  # #include <pleinair/pleinair.h>
  endif()
  install(FILES ${PROJECT_SOURCE_DIR}/${header}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pleinair/${folder})
endforeach()

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pleinair)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pleinair-config.cmake.in
  ${PROJECT_BINARY_DIR}/pleinair-config.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pleinair-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pleinair-config.cmake
              ${PROJECT_BINARY_DIR}/pleinair-config-version.cmake DESTINATION ${config_folder})
install(EXPORT pleinair-targets NAMESPACE pleinair:: DESTINATION ${config_folder})

# For pkg-config, all libraries under one name, each before those that it uses.
set(pleinair_libs export session compositor leaf shadows gl tracker devices calibration scene files clouds sky)
list(TRANSFORM pleinair_libs PREPEND "-lpleinair_")
list(JOIN pleinair_libs " " PLEINAIR_PC_LIBS)
set(PLEINAIR_PC_REQUIRES "erfa epoxy egl yaml-cpp zlib libpng libjpeg libhwy fmt OpenEXR")
string(APPEND PLEINAIR_PC_REQUIRES " libavformat libavcodec libavutil libswscale libexif libzip geographiclib")
foreach(library meshoptimizer:MESHOPT draco:DRACO webp:WEBP)
  string(REPLACE ":" ";" library ${library})
  list(GET library 0 name)
  list(GET library 1 word)
  if(PLEINAIR_${word}_LIBRARY)
    string(APPEND PLEINAIR_PC_LIBS " -l${name}")
  endif()
endforeach()
if(ARAVIS_FOUND)
  string(APPEND PLEINAIR_PC_REQUIRES " aravis-0.8")
endif()
if(LIBCAMERA_FOUND)
  string(APPEND PLEINAIR_PC_REQUIRES " libcamera")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/pleinair.pc.in ${PROJECT_BINARY_DIR}/pleinair.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/pleinair.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
