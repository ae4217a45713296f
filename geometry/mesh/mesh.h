// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

/// The half-edge structure that every operation of this folder works on, and the only names for CGAL's types.
/// Positions are in metres; faces are triangles and wind counter-clockwise seen from outside.
namespace furrow::geometry {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;    ///< [m]
using Vector = Kernel::Vector_3;  ///< not zero by default: initialise it
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

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
