# Tests and benchmark of tracker/surf/.
find_package(hwy REQUIRED)
pleinair_test(surf_test
  SOURCES surf_allocation_test.cc surf_kernels_test.cc surf_reference.cc surf_test.cc
          surf_test_pictures.cc
  LIBS pleinair::tracker hwy::hwy)
