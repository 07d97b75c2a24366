# Every .cpp file of the library and of the Python module, floor by floor from the ground up.
# A new file is appended here by whoever adds it; a listed file that does not exist stops CMake.
set(SALTUS_SOURCES
  # spatial
  cpp/src/spatial/rotation.cpp
  # tree
  cpp/src/tree/coordinates.cpp
  cpp/src/tree/kinematics.cpp
  cpp/src/tree/tree.cpp
  # lagrangian
  cpp/src/lagrangian/mass_model.cpp
  cpp/src/lagrangian/packed/arc_rate.cpp
  cpp/src/lagrangian/packed/ball_arc.cpp
  cpp/src/lagrangian/packed/ball_matrix.cpp
  cpp/src/lagrangian/packed/ball_place.cpp
  cpp/src/lagrangian/packed/lu.cpp
  cpp/src/lagrangian/packed/matrix.cpp
  cpp/src/lagrangian/packed/pack.cpp
  cpp/src/lagrangian/packed/passes.cpp
  cpp/src/lagrangian/packed/place.cpp
  cpp/src/lagrangian/packed/products.cpp
  cpp/src/lagrangian/packed/rows.cpp
  cpp/src/lagrangian/packed/shadow.cpp
  cpp/src/lagrangian/packed/sweep.cpp
  cpp/src/lagrangian/packed/turn.cpp
  cpp/src/lagrangian/partials.cpp
  # collision
  cpp/src/collision/shapes/box.cpp
  cpp/src/collision/shapes/capsule.cpp
  cpp/src/collision/shapes/convex.cpp
  cpp/src/collision/shapes/cylinder.cpp
  cpp/src/collision/shapes/ellipsoid.cpp
  cpp/src/collision/shapes/facets.cpp
  cpp/src/collision/shapes/features.cpp
  cpp/src/collision/shapes/half_space.cpp
  cpp/src/collision/shapes/hull.cpp
  cpp/src/collision/shapes/hull_flaw.cpp
  cpp/src/collision/shapes/shapes.cpp
  cpp/src/collision/shapes/sphere.cpp
  cpp/src/collision/gap/curvature.cpp
  cpp/src/collision/gap/pair.cpp
  cpp/src/collision/convex/convex_gap.cpp
  cpp/src/collision/convex/epa.cpp
  cpp/src/collision/convex/gjk.cpp
  cpp/src/collision/convex/lay_flat.cpp
  cpp/src/collision/convex/meeting.cpp
  cpp/src/collision/pairs/capsule_capsule.cpp
  cpp/src/collision/pairs/dispatch.cpp
  cpp/src/collision/parts/corner.cpp
  cpp/src/collision/parts/crossing.cpp
  cpp/src/collision/parts/parts.cpp
  cpp/src/collision/parts/rim.cpp
  cpp/src/collision/parts/rim_crossing.cpp
  cpp/src/collision/parts/whole.cpp
  cpp/src/collision/contact/contact.cpp
  cpp/src/collision/contact/slip.cpp
  cpp/src/collision/watch/ball_tree.cpp
  cpp/src/collision/watch/broad_phase.cpp
  cpp/src/collision/watch/pair_table.cpp
  cpp/src/collision/chord/chord.cpp
  cpp/src/collision/chord/chord_bounds.cpp
  cpp/src/collision/chord/chord_path.cpp
  # model
  cpp/src/model/assembly.cpp
  cpp/src/model/configuration.cpp
  cpp/src/model/filter.cpp
  cpp/src/model/masses.cpp
  cpp/src/model/materials.cpp
  cpp/src/model/merge.cpp
  cpp/src/model/model.cpp
  cpp/src/model/model_builder.cpp
  cpp/src/model/motion.cpp
  cpp/src/model/pairs.cpp
  cpp/src/model/scene.cpp
  cpp/src/model/shape_checks.cpp
  cpp/src/model/solids.cpp
  cpp/src/model/topology.cpp
  cpp/src/model/unsaid.cpp
  # variational
  cpp/src/variational/terms/options.cpp
  cpp/src/variational/law/cascade.cpp
  cpp/src/variational/law/contact_problem.cpp
  cpp/src/variational/law/contact_qp.cpp
  cpp/src/variational/law/coulomb.cpp
  cpp/src/variational/law/friction.cpp
  cpp/src/variational/law/friction_scratch.cpp
  cpp/src/variational/law/friction_together.cpp
  cpp/src/variational/law/generalized_reflections.cpp
  cpp/src/variational/law/pile.cpp
  cpp/src/variational/law/pile_island.cpp
  cpp/src/variational/uniqueness/certificate.cpp
  cpp/src/variational/uniqueness/coxeter.cpp
  cpp/src/variational/uniqueness/outcomes.cpp
  cpp/src/variational/overlap/overlap.cpp
  cpp/src/variational/node/contact_vector.cpp
  cpp/src/variational/node/delassus.cpp
  cpp/src/variational/node/contacts.cpp
  cpp/src/variational/node/node.cpp
  cpp/src/variational/node/pair_pool.cpp
  cpp/src/variational/node/scene.cpp
  cpp/src/variational/arc/arc.cpp
  cpp/src/variational/arc/closing_arc.cpp
  cpp/src/variational/arc/energy_meter.cpp
  cpp/src/variational/arc/finish.cpp
  cpp/src/variational/arc/launch_line.cpp
  cpp/src/variational/arc/memory.cpp
  cpp/src/variational/arc/row_blocks.cpp
  cpp/src/variational/arc/rows.cpp
  cpp/src/variational/arc/solve.cpp
  cpp/src/variational/impact/certify.cpp
  cpp/src/variational/impact/custom_law.cpp
  cpp/src/variational/impact/impact.cpp
  cpp/src/variational/flight/first_hit.cpp
  cpp/src/variational/flight/flight.cpp
  cpp/src/variational/flight/impact_time.cpp
  cpp/src/variational/flight/launch.cpp
  cpp/src/variational/step/acceptance.cpp
  cpp/src/variational/step/contact_report.cpp
  cpp/src/variational/step/lift.cpp
  cpp/src/variational/step/start_overlap.cpp
  cpp/src/variational/step/step_errors.cpp
  cpp/src/variational/step/stepper.cpp
  cpp/src/variational/step/unlocated.cpp
  # rollout
  cpp/src/rollout/batch.cpp
  cpp/src/rollout/batch_trajectory.cpp
  cpp/src/rollout/recorder.cpp
  cpp/src/rollout/run.cpp
  cpp/src/rollout/simulate.cpp
  # urdf
  cpp/src/urdf/attributes.cpp
  cpp/src/urdf/collision_meshes.cpp
  cpp/src/urdf/document.cpp
  cpp/src/urdf/element_checks.cpp
  cpp/src/urdf/extension.cpp
  cpp/src/urdf/geometry.cpp
  cpp/src/urdf/load_urdf.cpp
  cpp/src/urdf/mesh_file.cpp
  cpp/src/urdf/mesh_path.cpp
  cpp/src/urdf/numbers.cpp
  cpp/src/urdf/parse.cpp
  cpp/src/urdf/rewrite.cpp
  cpp/src/urdf/schema.cpp
  cpp/src/urdf/schema_checks.cpp
  cpp/src/urdf/shape_elements.cpp
  cpp/src/urdf/source.cpp
  cpp/src/urdf/srdf.cpp
  cpp/src/urdf/tree_checks.cpp
)

set(SALTUS_BINDING_SOURCES
  python/bindings/argument_errors.cpp
  python/bindings/arguments.cpp
  python/bindings/core.cpp
  python/bindings/bind_errors.cpp
  # spatial
  python/bindings/bind_spatial.cpp
  # lagrangian
  python/bindings/bind_lagrangian.cpp
  # collision
  python/bindings/bind_collision.cpp
  python/bindings/bind_configuration.cpp
  # model
  python/bindings/bind_model.cpp
  python/bindings/bind_model_builder.cpp
  python/bindings/bind_motion.cpp
  python/bindings/pickle.cpp
  # urdf
  python/bindings/bind_urdf.cpp
  # variational
  python/bindings/bind_contact_space.cpp
  python/bindings/bind_report.cpp
  python/bindings/bind_resolve_impact.cpp
  python/bindings/bind_stepper.cpp
  python/bindings/step_options.cpp
  python/bindings/bind_variational.cpp
  # rollout
  python/bindings/bind_rollout.cpp
  python/bindings/bind_batch.cpp
)
