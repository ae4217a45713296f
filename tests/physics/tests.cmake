# SPDX-License-Identifier: GPL-3.0-or-later
furrow_add_tests(physics LIBRARIES furrow::physics SOURCES
  animated_body_test.cpp
  compensation_test.cpp
  contact_test.cpp
  damping_sweep_test.cpp
  euler_step_test.cpp
  hanging_chain_test.cpp
  leapfrog_step_test.cpp
  moved_pins_test.cpp
  packed_cloth_test.cpp
  pins_test.cpp
  push_out_test.cpp
  residual_force_test.cpp
  rigid_contact_test.cpp
  rigid_motion_test.cpp
  simulate_state_test.cpp
  simulate_test.cpp
  spring_forces_test.cpp
  stable_step_test.cpp
  stepper_test.cpp
  stepper_contact_test.cpp
  stepper_stability_test.cpp
  strain_test.cpp
  sweep_order_test.cpp
  thread_pool_test.cpp
  wind_test.cpp
)
