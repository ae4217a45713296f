// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "geometry/mesh/mesh_fwd.h"

/// The half-edge structure that every operation of this folder works on: a CGAL::Surface_mesh over
/// Simple_cartesian<double>, filled by its add_vertex() and add_face(). mesh_fwd.h names it and its parts;
/// use those names rather than CGAL's. Positions are in metres. Faces are triangles and wind
/// counter-clockwise as seen from outside.
namespace furrow::geometry {

template <class Key, class T>
using Map = Mesh::Property_map<Key, T>;
template <class T>
using VertexMap = Map<Vertex, T>;
template <class T>
using EdgeMap = Map<Edge, T>;
template <class T>
using HalfedgeMap = Map<Halfedge, T>;
template <class T>
using FaceMap = Map<Face, T>;

}  // namespace furrow::geometry
