# Tests and benchmark of tracker/surf/.
find_package(hwy REQUIRED)
pleinair_test(surf_test
  SOURCES counted_memory.cc keypoint_selection_test.cc surf_allocation_test.cc surf_kernels_test.cc
          surf_reference.cc surf_test.cc surf_test_pictures.cc
  LIBS pleinair::tracker hwy::hwy)

# Time, repeatability and matching against OpenCV's SIFT, ORB and AKAZE and, if there, dlib's SURF.
if(PLEINAIR_BENCHMARKS)
  find_package(benchmark REQUIRED)
  find_package(OpenCV REQUIRED COMPONENTS core calib3d features2d imgcodecs imgproc)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(DLIB IMPORTED_TARGET dlib-1)
  add_library(pleinair_surf_peers STATIC surf_peers.cc)
  target_link_libraries(pleinair_surf_peers PUBLIC pleinair::tracker opencv_core opencv_features2d)
  pleinair_configure_target(pleinair_surf_peers)
  if(DLIB_FOUND)
    target_link_libraries(pleinair_surf_peers PRIVATE PkgConfig::DLIB)
    target_compile_definitions(pleinair_surf_peers PRIVATE PLEINAIR_HAVE_DLIB DLIB_NO_GUI_SUPPORT)
  endif()
  add_executable(surf_evaluation surf_evaluation.cc)
  target_link_libraries(surf_evaluation
    PRIVATE pleinair_surf_peers opencv_calib3d opencv_imgcodecs opencv_imgproc)
  pleinair_configure_target(surf_evaluation)
  add_executable(surf_benchmark surf_benchmark.cc surf_test_pictures.cc)
  target_link_libraries(surf_benchmark
    PRIVATE pleinair_surf_peers opencv_imgcodecs opencv_imgproc benchmark::benchmark)
  pleinair_configure_target(surf_benchmark)
endif()
