# Every .cpp file of the library and of the Python module, floor by floor from the ground up.
# A new file is appended here by whoever adds it; a listed file that does not exist stops CMake.
set(SALTUS_SOURCES
  # spatial
  # tree
  cpp/src/tree/kinematics.cpp
  cpp/src/tree/tree.cpp
  # lagrangian
  cpp/src/lagrangian/arc_matrix.cpp
  cpp/src/lagrangian/composite.cpp
  cpp/src/lagrangian/energy.cpp
  cpp/src/lagrangian/partials.cpp
  # collision
  # model
  cpp/src/model/assembly.cpp
  cpp/src/model/masses.cpp
  cpp/src/model/model.cpp
  cpp/src/model/model_builder.cpp
  cpp/src/model/pairs.cpp
  cpp/src/model/topology.cpp
  # variational
  cpp/src/variational/arc.cpp
  cpp/src/variational/cascade.cpp
  cpp/src/variational/flight.cpp
  cpp/src/variational/impact_time.cpp
  cpp/src/variational/node.cpp
  cpp/src/variational/stepper.cpp
  # rollout
  cpp/src/rollout/recorder.cpp
  cpp/src/rollout/simulate.cpp
  # urdf
)

set(SALTUS_BINDING_SOURCES
  # python/bindings/core.cpp
)

if(NOT SALTUS_SOURCES)
  message(FATAL_ERROR "cpp/sources.cmake lists no file yet: append the first .cpp to SALTUS_SOURCES")
endif()
