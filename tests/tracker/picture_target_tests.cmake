# Tests of tracker/picture_target/, mostly through tracker/tracker.h.
add_library(pleinair_picture_target_scenes STATIC picture_target_scenes.cc)
target_link_libraries(pleinair_picture_target_scenes PUBLIC pleinair_sg_test_scenes)
pleinair_configure_target(pleinair_picture_target_scenes)
pleinair_test(picture_target_file_test
  SOURCES picture_target_file_test.cc
  LIBS pleinair::tracker)
pleinair_test(picture_target_making_test
  SOURCES picture_target_making_test.cc
  LIBS pleinair_picture_target_scenes)
pleinair_test(picture_target_detection_test
  SOURCES picture_target_detection_test.cc
  LIBS pleinair_picture_target_scenes Eigen3::Eigen opencv_core opencv_imgcodecs)
pleinair_test(picture_target_tracking_test
  SOURCES counted_memory.cc picture_target_tracking_test.cc
  LIBS pleinair_picture_target_scenes)
pleinair_test(picture_target_fit_test
  SOURCES picture_target_fit_test.cc
  LIBS pleinair_picture_target_scenes)
if(PLEINAIR_BENCHMARKS)
  add_executable(picture_target_evaluation picture_target_evaluation.cc)
  target_link_libraries(picture_target_evaluation
    PRIVATE pleinair_picture_target_scenes opencv_core opencv_imgcodecs opencv_imgproc)
  pleinair_configure_target(picture_target_evaluation)
endif()
