# Tests of tracker/surf_golay/, mostly through tracker/tracker.h.
add_library(pleinair_sg_test_scenes STATIC sg_test_scenes.cc)
target_link_libraries(pleinair_sg_test_scenes PUBLIC pleinair_marker_rendering GTest::gtest)
pleinair_configure_target(pleinair_sg_test_scenes)
pleinair_test(sg_detection_test
  SOURCES sg_detection_test.cc
  LIBS pleinair_sg_test_scenes)
pleinair_test(sg_occlusion_test
  SOURCES sg_occlusion_test.cc
  LIBS pleinair_sg_test_scenes)
pleinair_test(cell_lattice_test
  SOURCES cell_lattice_test.cc
  LIBS pleinair_sg_test_scenes)
pleinair_test(sg_negative_test
  SOURCES sg_negative_test.cc
  LIBS pleinair_sg_test_scenes)
pleinair_test(sg_tracking_test
  SOURCES counted_memory.cc sg_memory_test.cc sg_tracking_test.cc
  LIBS pleinair_sg_test_scenes Eigen3::Eigen)
pleinair_test(sg_cells_test
  SOURCES number_proof_test.cc sg_cells_test.cc vote_agreement_test.cc
  LIBS pleinair_sg_test_scenes Eigen3::Eigen)
if(PLEINAIR_BENCHMARKS)
  find_package(benchmark REQUIRED)
  add_executable(detection_benchmark detection_benchmark.cc)
  target_link_libraries(detection_benchmark
    PRIVATE pleinair_marker_rendering pleinair_april_tag benchmark::benchmark)
  pleinair_configure_target(detection_benchmark)
endif()
