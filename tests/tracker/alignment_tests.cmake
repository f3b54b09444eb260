# Tests and benchmark of tracker/alignment/.
if(PLEINAIR_BENCHMARKS)
  find_package(benchmark REQUIRED)
  add_executable(alignment_benchmark alignment_benchmark.cc)
  target_link_libraries(alignment_benchmark
    PRIVATE pleinair_marker_rendering benchmark::benchmark)
  pleinair_configure_target(alignment_benchmark)
endif()
