// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What a step costs, so that a choice between settings is the same on every machine: never from a clock.
/// Measured on one thread of an AMD EPYC (g++ 12, -O2), beside other builds: processor seconds of
/// `furrow simulate --json --threads 1` on meshes/sheet.obj (3,038 and 11,933 vertices, pinned above, 0.2 to
/// 0.5 s) with each integrator and each kind of element, divided by what the report counts;
/// bench/integrator_bench prints the same for a sheet of 2,500. A body that changes its shape:
/// meshes/shirt.obj for 0.2 s on meshes/mannequin.obj that sways in 25 frames a second, less the same at
/// rest, with leapfrog's and half its steps; since its distances are exact, by bench/motion/deforming.
/// Iterations: a T-shirt of MakeHuman in cotton on its body, in a wind, of 808, 3,150 and 12,414 vertices,
/// beside leapfrog. Only the ratios matter.
namespace furrow::jobs {

struct Work {                ///< counts of a run
  double vertices = 0;       ///< of the cloth
  double steps = 0;          ///< by `vertex_step`
  double springs = 0;        ///< evaluations of a spring's force
  double triangles = 0;      ///< of a membrane triangle's
  double hinges = 0;         ///< of a hinge's
  double queries = 0;        ///< of a rigid body's distance at a vertex
  double frame_queries = 0;  ///< of the distance of one that changes its shape
  double refitted = 0;       ///< triangles of all its frames
  double iterations = 0;     ///< of Newton's method, in steps that solve contact
  double sweeps = 0;         ///< XPBD's, times springs
};

struct CostTable {                  ///< [s]
  double vertex_step = 33e-9;       ///< kicks, drag, spring damping, drift of a vertex: leapfrog's and alike
  double rk4_vertex_step = 120e-9;  ///< the same four times
  double spring = 2.6e-9;
  double triangle = 13.6e-9;
  double hinge = 15.7e-9;
  double query = 45e-9;
  double frame_query = 1.2e-6;  ///< with its share of the closest points
  double refit = 1.5e-6;
  double sweep = 8.5e-9;            ///< of XPBD, a spring
  double iteration = 1.9e-6;        ///< of implicit steps, a vertex: assembly, factors of single precision
  double iteration_fill = 1.3e-10;  ///< and times vertices^2: the factor fills in
};
constexpr CostTable costs;

/// Seconds of one thread. `vertex_step`: one of the table's, as the integrator needs.
constexpr double cost_of(const Work& w, double vertex_step) {
  const CostTable& c = costs;
  return w.vertices * w.steps * vertex_step + w.springs * c.spring + w.triangles * c.triangle +
         w.hinges * c.hinge + w.queries * c.query + w.frame_queries * c.frame_query + w.refitted * c.refit +
         w.sweeps * c.sweep + w.iterations * w.vertices * (c.iteration + c.iteration_fill * w.vertices);
}

}  // namespace furrow::jobs
