# Tests and benchmark of tracker/alignment/.
pleinair_test(alignment_test
  SOURCES alignment_covariance_test.cc alignment_fit_test.cc alignment_raster_test.cc
          alignment_scene.cc alignment_tiles_test.cc counted_memory.cc
  LIBS pleinair_marker_rendering Eigen3::Eigen hwy::hwy)
if(PLEINAIR_BENCHMARKS)
  find_package(benchmark REQUIRED)
  add_executable(alignment_benchmark alignment_benchmark.cc)
  target_link_libraries(alignment_benchmark
    PRIVATE pleinair_marker_rendering benchmark::benchmark)
  pleinair_configure_target(alignment_benchmark)
endif()
