# The kernels in cpp/src/lagrangian/packed: loops over lanes that the compiler makes wide.
#
# GCC vectorises them loop by loop; its other vectoriser, of straight code, only scatters what one lane computes.
# Products and sums fuse where the machine can, in ISO mode too. errno would keep functions out of loops. Vectors
# passed to inlined functions have no ABI to warn of.
set(_kernels ${SALTUS_SOURCES})
list(FILTER _kernels INCLUDE REGEX "/packed/")
set_source_files_properties(${_kernels} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_source_files_properties(${_kernels} PROPERTIES
    COMPILE_OPTIONS "-fno-math-errno;-fno-tree-slp-vectorize;-ffp-contract=fast;-Wno-psabi")
endif()
