# What `cmake --install` puts where: the command, the libraries with their public headers, and what
# find_package(pleinair) and pkg-config need. Included last, when every target exists.
include(CMakePackageConfigHelpers)

set(PLEINAIR_EXPORTED pleinair_base pleinair_files pleinair_scene pleinair_sky pleinair_gl pleinair_shadows pleinair_compositor
    pleinair_devices pleinair_tracker pleinair_calibration pleinair_session pleinair_export pleinair_april_tag)
install(TARGETS ${PLEINAIR_EXPORTED} EXPORT pleinair-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

# Headers that say "Internal:" before their first include stay here (tests/architecture holds the
# others free of the types of OpenCV, Ceres, Eigen and the like).
foreach(module IN ITEMS base files sky scene devices tracker gl shadows compositor session export)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${module}/*.h)
  foreach(header IN LISTS headers)
    file(STRINGS ${header} internal REGEX "Internal:" LIMIT_COUNT 1)
    if(NOT internal)
      file(RELATIVE_PATH relative ${PROJECT_SOURCE_DIR} ${header})
      cmake_path(GET relative PARENT_PATH folder)
      install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pleinair/${folder})
    endif()
  endforeach()
endforeach()

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pleinair)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/pleinair-config.cmake.in
  ${PROJECT_BINARY_DIR}/pleinair-config.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pleinair-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pleinair-config.cmake
              ${PROJECT_BINARY_DIR}/pleinair-config-version.cmake DESTINATION ${config_folder})
install(EXPORT pleinair-targets NAMESPACE pleinair:: DESTINATION ${config_folder})

# One pkg-config file a module. Those of OpenCV and others have a file of their own to require;
# Ceres, Embree, AprilTag and TinyGLTF are named as libraries.
function(pleinair_pkg_config module description requires libs)
  set(PC_MODULE ${module})
  set(PC_DESCRIPTION ${description})
  set(PC_REQUIRES ${requires})
  set(PC_LIBS ${libs})
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/pleinair-module.pc.in
    ${PROJECT_BINARY_DIR}/pleinair-${module}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/pleinair-${module}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
pleinair_pkg_config(sky "the sun's place and the day's light" "erfa" "")
pleinair_pkg_config(gl "OpenGL without a window" "epoxy egl" "-ldl")
pleinair_pkg_config(shadows "the sun's shadow maps" "pleinair-gl" "")
pleinair_pkg_config(compositor "virtual objects in camera pictures"
  "pleinair-shadows pleinair-sky" "-ltinygltf -lembree3 -pthread")
set(devices_requires "opencv4 yaml-cpp libjpeg zlib")
if(ARAVIS_FOUND)
  string(APPEND devices_requires " aravis-0.8")
endif()
if(LIBCAMERA_FOUND)
  string(APPEND devices_requires " libcamera")
endif()
pleinair_pkg_config(devices "cameras, recordings, calibrations and scenes" "${devices_requires}"
  "-pthread")
pleinair_pkg_config(tracker "markers and their poses" "opencv4 libhwy"
  "-lapriltag -lapriltag-utils -lceres -lglog -lgflags -lspqr -lcholmod -lcxsparse -llapack -lblas")

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/NOTICE
        DESTINATION ${CMAKE_INSTALL_DOCDIR})
