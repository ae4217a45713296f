// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/mannequin.h"

#include "meshes/surfaces.h"

namespace furrow::meshes {
namespace {

const Vec x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);
const Vec shoulder(0.160, 1.354, -0.024), down_arm(0.6, -0.8, 0), off_arm(0.8, 0.6, 0);

const Loft torso({0, 0, 0}, y_axis, x_axis, z_axis,
                 {{0.740, 0.030, 0.030, -0.006},
                  {0.765, 0.080, 0.062, -0.006},
                  {0.800, 0.135, 0.092, -0.008},
                  {0.840, 0.157, 0.107, -0.010},
                  {0.890, 0.163, 0.113, -0.009},
                  {0.950, 0.154, 0.108, -0.004},
                  {1.000, 0.138, 0.099, 0.002},
                  {1.060, 0.122, 0.093, 0.006},
                  {1.120, 0.125, 0.094, 0.004},
                  {1.180, 0.131, 0.096, -0.001},
                  {1.250, 0.143, 0.100, -0.008},
                  {1.320, 0.150, 0.094, -0.016},
                  {1.365, 0.150, 0.078, -0.024},
                  {1.395, 0.137, 0.062, -0.030},
                  {1.420, 0.103, 0.054, -0.032},
                  {1.450, 0.060, 0.050, -0.032}});
const Loft leg({0, 0, 0}, y_axis, x_axis, z_axis,
               {{0.04, 0.030, 0.038, -0.018, 0.083},
                {0.10, 0.032, 0.037, -0.018, 0.083},
                {0.18, 0.036, 0.041, -0.018, 0.084},
                {0.26, 0.046, 0.051, -0.018, 0.086},
                {0.33, 0.051, 0.057, -0.014, 0.088},
                {0.40, 0.050, 0.054, -0.003, 0.089},
                {0.46, 0.052, 0.057, 0.004, 0.090},
                {0.52, 0.057, 0.062, 0.004, 0.091},
                {0.62, 0.069, 0.074, 0.003, 0.094},
                {0.72, 0.076, 0.083, -0.002, 0.094},
                {0.80, 0.076, 0.089, -0.008, 0.091},
                {0.86, 0.070, 0.083, -0.010, 0.087},
                {0.92, 0.050, 0.062, -0.008, 0.088},
                {0.95, 0.024, 0.032, -0.006, 0.086}});
const Loft arm(shoulder, down_arm, off_arm, z_axis,
               {{-0.03, 0.022, 0.026},
                {0.02, 0.044, 0.048},
                {0.08, 0.044, 0.048},
                {0.16, 0.040, 0.043, -0.001},
                {0.24, 0.035, 0.037, -0.001},
                {0.28, 0.034, 0.036, 0.002},
                {0.33, 0.035, 0.036, 0.008},
                {0.40, 0.030, 0.031, 0.018},
                {0.47, 0.023, 0.023, 0.032},
                {0.52, 0.021, 0.021, 0.041}});
const Loft palm(shoulder, down_arm, off_arm, z_axis,
                {{0.490, 0.021, 0.022, 0.036},
                 {0.525, 0.020, 0.026, 0.041},
                 {0.565, 0.018, 0.037, 0.047},
                 {0.605, 0.016, 0.039, 0.051},
                 {0.645, 0.014, 0.034, 0.053},
                 {0.675, 0.012, 0.024, 0.054},
                 {0.693, 0.007, 0.010, 0.054}});

double foot(const Vec& p) {
  const Vec q(0.083 + (p.x() - 0.083) / 1.25, p.y(), p.z());  // wider than high
  const double heel = round_cone(q, {0.083, 0.032, -0.034}, {0.086, 0.022, 0.100}, 0.032, 0.026);
  const double toes = round_cone(q, {0.086, 0.022, 0.100}, {0.086, 0.012, 0.160}, 0.026, 0.016);
  const double instep = round_cone(p, {0.083, 0.075, -0.012}, {0.086, 0.030, 0.085}, 0.032, 0.024);
  return smooth_union(smooth_union(heel, toes, 0.02), instep, 0.03);
}

double arm_and_hand(const Vec& p) {
  const Vec root = shoulder + 0.545 * down_arm + 0.066 * z_axis,
            tip = shoulder + 0.605 * down_arm + 0.102 * z_axis;
  const double hand = smooth_union(palm(p), round_cone(p, root, tip, 0.014, 0.011), 0.015);
  return smooth_union(arm(p), hand, 0.01);
}

double head(const Vec& p) {
  const double skull = ellipsoid(p, {0, 1.608, -0.008}, {0.073, 0.092, 0.092});
  const double face = ellipsoid(p, {0, 1.555, 0.028}, {0.054, 0.074, 0.058});
  const double nose = round_cone(p, {0, 1.600, 0.080}, {0, 1.568, 0.098}, 0.008, 0.011);
  const double lips = round_cone(p, {-0.012, 1.537, 0.079}, {0.012, 1.537, 0.079}, 0.008, 0.008);
  const double chin = ellipsoid(p, {0, 1.498, 0.055}, {0.024, 0.018, 0.022});
  double d = smooth_union(skull, face, 0.03);
  d = smooth_union(d, chin, 0.03);
  d = smooth_union(d, nose, 0.012);
  return smooth_union(d, lips, 0.008);
}

}  // namespace

const Loft& left_arm() { return arm; }

double trunk(const Vec& p) {
  const double neck = round_cone(p, {0, 1.38, -0.038}, {0, 1.53, -0.006}, 0.053, 0.047);
  const double shoulders = with_mirror_image(p, 0.02, [](const Vec& q) {
    return ellipsoid(q, shoulder, {0.052, 0.048, 0.052});
  });
  const double bust = with_mirror_image(p, 0.015, [](const Vec& q) {
    return ellipsoid(q, {0.076, 1.232, 0.069}, {0.062, 0.064, 0.059});
  });
  const double seat = with_mirror_image(p, 0.02, [](const Vec& q) {
    return ellipsoid(q, {0.068, 0.865, -0.068}, {0.080, 0.085, 0.064});
  });
  double d = smooth_union(torso(p), neck, 0.04);
  d = smooth_union(d, shoulders, 0.06);
  d = smooth_union(d, bust, 0.03);
  return smooth_union(d, seat, 0.04);
}

double mannequin(const Vec& p) {
  const double legs = with_mirror_image(p, 0.015, leg);
  const double feet = with_mirror_image(p, 0.01, foot);
  const double arms = with_mirror_image(p, 0.01, arm_and_hand);
  double d = smooth_union(trunk(p), legs, 0.05);
  d = smooth_union(d, feet, 0.025);
  d = smooth_union(d, arms, 0.03);
  d = smooth_union(d, head(p), 0.02);
  return smooth_intersection(d, -p.y(), 0.006);  // flat soles
}

geometry::Mesh make_mannequin() {
  geometry::Mesh mesh = mesh_surface(mannequin, {-0.62, -0.02, -0.2}, {0.62, 1.74, 0.22}, 0.0176);
  stand_on_ground(mesh);
  return mesh;
}

}  // namespace furrow::meshes
