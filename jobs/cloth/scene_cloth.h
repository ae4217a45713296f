// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/scene/scene.h"
#include "jobs/base/read_inputs.h"
#include "jobs/body/world_body.h"

/// The pieces of a scene's run that write nothing.
namespace furrow::jobs {

/// The scene's garment before the first line, refined as the scene says.
io::MeshFile begin_garment(const io::Scene& scene, const Context& context, Chains chains = Chains::refused);

/// Warns of boxes that do not touch: mostly a body in another unit, or with another axis up.
void warn_if_apart(const io::Scene& scene, const WorldBody& body, const geometry::Mesh& garment,
                   const Context& context);

/// The same, and of a garment that starts inside the body.
void warn_of_start(const io::Scene& scene, const WorldBody& body, const geometry::Mesh& garment,
                   const Context& context);

/// Pins the vertices, and doubles the hinges of clamps. The simulation moves pins only as the scene says, so
/// with a body (null: none) those that lie inside it at `time` [s] are put on its surface; warns of them.
void pin_cloth(physics::Cloth& cloth, const std::vector<std::vector<int>>& pins, const WorldBody* body,
               double time, const Context& context);

/// With the bending law `plate`, once the cloth is pinned: makes its hinges one plate; warns of triangles
/// that are too thin to bend exactly, if `tell`. Whether there are any.
bool couple_cloth(const io::MeshFile& file, const io::Scene& scene, physics::Cloth& cloth,
                  const Context& context, bool tell = true);

/// The cloth of a complete garment: gathered from its springs, pinned (pin_cloth()) and coupled. The membrane
/// `patches` is one of triangles here; warns of it. Throws as bridge::gather() does, naming the scene's
/// garment.
physics::Cloth cloth_of(const io::MeshFile& file, const io::Scene& scene,
                        const std::vector<std::vector<int>>& pins, const WorldBody* body, double time,
                        const Context& context);

/// Body (null: none), wind and led pins; the body must outlive the world.
physics::World world_of(const io::Scene& scene, const WorldBody* body,
                        const std::vector<std::vector<int>>& pins);

/// The scene's threads, or as many as pay for so many vertices; the result does not depend on them.
int threads_of(const io::Scene& scene, std::size_t vertices);

/// A scene at its time 0, ready for physics::simulate.
struct SceneCloth {
  io::MeshFile file;  ///< complete, with the lines of time 0
  std::vector<std::vector<int>> pins;
  std::shared_ptr<WorldBody> body;   ///< null: none
  physics::Cloth cloth;              ///< pinned
  physics::SimulateOptions options;  ///< the scene's, with gap and threads; without stop_at
  int near_body = 0;                 ///< vertices within 2 cm of the body
  double seconds = 0;                ///< until the end, or the first lines that come later [s]
  bool ends_at_lines = false;

  physics::World world(const io::Scene& scene) const { return world_of(scene, body.get(), pins); }
};

/// Reads garment, strokes and body, draws the lines of time 0, builds the field. Writes nothing; warns as a
/// run does. Throws as a run does. `body`: the scene's, if it is built already.
SceneCloth prepare_scene(const io::Scene& scene, const Context& context,
                         std::shared_ptr<WorldBody> body = nullptr, Chains chains = Chains::refused);

}  // namespace furrow::jobs
