# Every .cpp file of the library and of the Python module, floor by floor from the ground up.
# A new file is appended here by whoever adds it; a listed file that does not exist stops CMake.
set(SALTUS_SOURCES
  # spatial
  # tree
  # lagrangian
  # collision
  # model
  # variational
  # rollout
  # urdf
)

set(SALTUS_BINDING_SOURCES
  # python/bindings/core.cpp
)

if(NOT SALTUS_SOURCES)
  message(FATAL_ERROR "cpp/sources.cmake lists no file yet: append the first .cpp to SALTUS_SOURCES")
endif()
