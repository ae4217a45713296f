// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/mesh/vertex_attributes.h"
#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A square of 2 units by 1, 3 units above the ground.
const std::string collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g" name="Apron"><mesh>
<source id="p"><float_array id="pa" count="12">0 0 3 2 0 3 2 1 3 0 1 3</float_array><technique_common>
<accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<polylist count="1"><input semantic="VERTEX" source="#v" offset="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n" name="Apron"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

/// The same in FBX, as text: `unit` centimetres each, with the axis of that number up, and a shape key that
/// raises its last corner by 1.
std::string fbx(double unit, int up) {
  return "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7300\n}\nGlobalSettings:  "
         "{\n\tVersion: 1000\n"
         "\tProperties70:  {\n\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\"," +
         std::to_string(up) +
         "\n\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\",1\n\t\tP: \"FrontAxis\", \"int\", \"Integer\", "
         "\"\"," +
         std::to_string(up == 1 ? 2 : 1) + "\n\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\"," +
         (up == 1 ? "1" : "-1") +
         "\n\t\tP: \"CoordAxis\", \"int\", \"Integer\", \"\",0\n\t\tP: \"CoordAxisSign\", \"int\", "
         "\"Integer\", \"\",1\n"
         "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," +
         std::to_string(unit) + "\n\t}\n}\n" +
         R"(Objects:  {
	Geometry: 10, "Geometry::Apron", "Mesh" {
		Vertices: *12 {
			a: 0,0,3,2,0,3,2,1,3,0,1,3
		}
		PolygonVertexIndex: *4 {
			a: 0,1,2,-4
		}
		GeometryVersion: 124
	}
	Geometry: 11, "Geometry::Raised", "Shape" {
		Version: 100
		Indexes: *1 {
			a: 3
		}
		Vertices: *3 {
			a: 0,0,1
		}
		Normals: *3 {
			a: 0,0,0
		}
	}
	Model: 20, "Model::Apron", "Mesh" {
		Version: 232
	}
	Deformer: 30, "Deformer::Keys", "BlendShape" {
		Version: 100
	}
	Deformer: 31, "SubDeformer::Raised", "BlendShapeChannel" {
		Version: 100
		DeformPercent: 0
		FullWeights: *1 {
			a: 100
		}
	}
}
Connections:  {
	C: "OO",20,0
	C: "OO",10,20
	C: "OO",30,10
	C: "OO",31,30
	C: "OO",11,31
}
)";
}

void check_square(const Mesh& mesh, double unit, bool y_up) {
  REQUIRE(mesh.number_of_vertices() == 4);
  REQUIRE(mesh.number_of_faces() == 2);
  const std::array<Vector, 4> corners = {Vector(0, 0, 3), Vector(2, 0, 3), Vector(2, 1, 3), Vector(0, 1, 3)};
  for (const Vector& c : corners) {
    const Point wanted = CGAL::ORIGIN + unit * (y_up ? c : Vector(c.x(), c.z(), -c.y()));
    double least = 1;
    for (const Point& p : mesh.points())
      least = std::min(least, std::sqrt(CGAL::squared_distance(p, wanted)));
    CHECK(least < 1e-6 * unit);
  }
}

}  // namespace

TEST_CASE("COLLADA: a mesh is read in its unit and axis, by assimp") {
  TemporaryFolder folder;
  spit(folder / "a.dae", collada);
  const io::MeshFile file = io::read_mesh(folder / "a.dae");
  check_square(file.mesh, 0.01, false);
  CHECK(file.group_names == std::vector<std::string>{"Apron"});
}

TEST_CASE("FBX: a mesh is read in its unit and axis with its shape keys, which a GLB gets") {
  TemporaryFolder folder;
  for (const double unit : {1., 100.})
    for (const int up : {1, 2}) {
      INFO(unit << " " << up);
      spit(folder / "a.fbx", fbx(unit, up));
      const io::MeshFile file = io::read_mesh(folder / "a.fbx");
      check_square(file.mesh, unit / 100, up == 1);
      io::write_mesh(folder / "b.glb", file);
      const io::MeshFile back = io::read_mesh(folder / "b.glb");
      check_square(back.mesh, unit / 100, up == 1);
      REQUIRE(shape_key_names(back.mesh) == std::vector<std::string>{"Raised"});
      Vector sum(0, 0, 0);
      for (const Vector& move : shape_key(back.mesh, "Raised")) sum += move;
      const Vector wanted = unit / 100 * (up == 1 ? Vector(0, 0, 1) : Vector(0, 1, 0));
      CHECK((sum - wanted).squared_length() < 1e-12 * unit);
    }
}

TEST_CASE("FBX and COLLADA: what is none is refused, and none is written") {
  TemporaryFolder folder;
  for (const char* name : {"a.fbx", "a.dae"}) {
    spit(folder / name, "no mesh at all");
    CHECK_THROWS_WITH(io::read_mesh(folder / name), Catch::Contains(std::string(name) + ": ") &&
                                                        Catch::Contains("export it as GLB or OBJ"));
    CHECK_THROWS_WITH(io::write_mesh(folder / name, read_from(cube_obj, io::MeshFormat::obj)),
                      Catch::Contains(".glb"));
  }
}
