# GTest::gtest and GTest::gtest_main: the system's, or built from the sources of Debian's googletest or of the
# wheel ros-gtest-vendor (PyPI has no other GoogleTest).
find_package(GTest QUIET)
if(NOT TARGET GTest::gtest_main)
  find_path(GTEST_SOURCE_DIR src/gtest-all.cc
    PATHS /usr/src/googletest/googletest PATH_SUFFIXES src/gtest_vendor)
  if(NOT GTEST_SOURCE_DIR)
    message(FATAL_ERROR "GoogleTest not found: apt-get install libgtest-dev, or pip install ros-gtest-vendor")
  endif()
  find_package(Threads REQUIRED)
  add_library(gtest STATIC ${GTEST_SOURCE_DIR}/src/gtest-all.cc)
  target_include_directories(gtest SYSTEM PUBLIC ${GTEST_SOURCE_DIR}/include PRIVATE ${GTEST_SOURCE_DIR})
  target_compile_features(gtest PUBLIC cxx_std_17)
  target_link_libraries(gtest PUBLIC Threads::Threads)
  add_library(gtest_main STATIC ${GTEST_SOURCE_DIR}/src/gtest_main.cc)
  target_link_libraries(gtest_main PUBLIC gtest)
  add_library(GTest::gtest ALIAS gtest)
  add_library(GTest::gtest_main ALIAS gtest_main)
endif()
