# Every .cpp file of the C++ tests, floor by floor: the files of SALTUS_TEST_<floor> make the program test_<floor>.
# A new file is appended here by whoever adds it, relative to tests/cpp; a floor without files makes no program.
set(SALTUS_TEST_spatial
  spatial/test_spatial.cpp
)
set(SALTUS_TEST_tree
  tree/test_kinematics.cpp
  tree/test_tree.cpp
)
set(SALTUS_TEST_lagrangian
  lagrangian/test_composite.cpp
  lagrangian/test_partials.cpp
)
set(SALTUS_TEST_collision
)
set(SALTUS_TEST_model
)
set(SALTUS_TEST_variational
)
set(SALTUS_TEST_rollout
)
set(SALTUS_TEST_urdf
)
