// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace furrow::io {
namespace {

using Eigen::Vector3d;

RTCDevice new_device() {
  const RTCDevice device = rtcNewDevice("threads=1,user_threads=0,set_affinity=0");
  if (!device) throw std::runtime_error("render: Embree cannot start on this machine");
  return device;
}

RTCScene new_scene(RTCDevice device) {
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

void* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t stride,
                 std::size_t count) {
  void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, stride, count);
  if (!buffer) throw std::runtime_error("render: Embree has no memory for the scene");
  return buffer;
}

void attach(RTCScene scene, RTCGeometry geometry, unsigned id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
}

/// A geometry that is released even if filling it throws; the scene keeps its own reference.
struct Geometry {
  RTCGeometry handle;
  Geometry(RTCDevice device, RTCGeometryType type) : handle(rtcNewGeometry(device, type)) {}
  ~Geometry() { rtcReleaseGeometry(handle); }
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;
};

void add_mesh(RTCDevice device, RTCScene scene, const PreparedMesh& mesh, unsigned id) {
  if (mesh.triangles.empty()) return;
  const Geometry geometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(new_buffer(geometry.handle, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), mesh.vertices.size()));
  for (const Vector3d& p : mesh.vertices) {
    for (int i = 0; i < 3; ++i) *vertices++ = float(p[i]);
  }
  auto* indices = static_cast<unsigned*>(new_buffer(geometry.handle, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                                    3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int v : t) *indices++ = unsigned(v);
  }
  attach(scene, geometry.handle, id);
}

/// An end of a segment for Embree: its place and radius, wider by so many pixels.
float* put_end(float* at, const PreparedScene& scene, const PreparedSegment& segment, int end, double wider) {
  const Vector3d& p = segment.ends[std::size_t(end)];
  for (int i = 0; i < 3; ++i) *at++ = float(p[i]);
  *at++ = float(segment.radii[std::size_t(end)] + wider * scene.camera.pixel_at(p));
  return at;
}

/// The first `tubes` segments as geometry 0, the balls after them as geometry 1: a tube that is as short as a
/// ball would be a dash, as Embree is single. `wider`: by so many pixels.
void add_segments(RTCDevice device, RTCScene tree, const PreparedScene& scene, std::size_t tubes,
                  double wider) {
  const std::vector<PreparedSegment>& segments = scene.segments;
  if (tubes > 0) {
    const Geometry geometry(device, RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    auto* vertices = static_cast<float*>(
        new_buffer(geometry.handle, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 2 * tubes));
    auto* indices = static_cast<unsigned*>(
        new_buffer(geometry.handle, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, sizeof(unsigned), tubes));
    for (std::size_t s = 0; s < tubes; ++s) {
      for (int end = 0; end < 2; ++end) vertices = put_end(vertices, scene, segments[s], end, wider);
      indices[s] = unsigned(2 * s);
    }
    attach(tree, geometry.handle, 0);
  }
  if (tubes == segments.size()) return;
  const Geometry geometry(device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
  auto* vertices = static_cast<float*>(new_buffer(geometry.handle, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4,
                                                  4 * sizeof(float), segments.size() - tubes));
  for (std::size_t s = tubes; s < segments.size(); ++s)
    vertices = put_end(vertices, scene, segments[s], 0, wider);
  attach(tree, geometry.handle, 1);
}

RTCRay new_ray(const Vector3d& origin, const Vector3d& direction, double max_distance) {
  RTCRay ray{};
  ray.org_x = float(origin.x());
  ray.org_y = float(origin.y());
  ray.org_z = float(origin.z());
  ray.dir_x = float(direction.x());
  ray.dir_y = float(direction.y());
  ray.dir_z = float(direction.z());
  ray.tfar = float(max_distance);
  ray.mask = ~0u;
  return ray;
}

std::optional<RTCRayHit> intersect(RTCScene scene, const RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit query{};
  query.ray = ray;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::nullopt : std::optional(query);
}

}  // namespace

void RayScene::Release::operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
void RayScene::Release::operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }

RayScene::RayScene(const PreparedScene& scene) : device_(new_device()), surfaces_(new_scene(device_.get())) {
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    add_mesh(device_.get(), surfaces_.get(), scene.meshes[i], unsigned(i));
  }
  rtcCommitScene(surfaces_.get());
  if (!scene.segments.empty()) {
    tubes_ =
        std::size_t(std::ranges::find_if(scene.segments, &PreparedSegment::is_ball) - scene.segments.begin());
    for (auto* tree : {&lines_, &wide_lines_}) {
      tree->reset(new_scene(device_.get()));
      add_segments(device_.get(), tree->get(), scene, tubes_, tree == &lines_ ? 0 : thin_reach);
      rtcCommitScene(tree->get());
    }
  }
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
    throw std::runtime_error("render: Embree cannot build the scene");
  }
}

std::optional<SurfaceHit> RayScene::nearest_surface(const Vector3d& origin, const Vector3d& direction) const {
  const auto found =
      intersect(surfaces_.get(), new_ray(origin, direction, std::numeric_limits<float>::infinity()));
  if (!found) return std::nullopt;
  return SurfaceHit{int(found->hit.geomID), int(found->hit.primID),
                    std::clamp(double(found->hit.u), 0.0, 1.0), std::clamp(double(found->hit.v), 0.0, 1.0),
                    found->ray.tfar};
}

std::optional<LineHit> RayScene::nearest_line(const Vector3d& origin, const Vector3d& direction,
                                              double max_distance) const {
  if (!lines_) return std::nullopt;
  const auto found = intersect(lines_.get(), new_ray(origin, direction, max_distance));
  if (!found) return std::nullopt;
  const Vector3d normal(found->hit.Ng_x, found->hit.Ng_y, found->hit.Ng_z);
  const double length = normal.norm();
  const std::size_t segment = found->hit.primID + (found->hit.geomID == 0 ? 0 : tubes_);
  return LineHit{int(segment), found->ray.tfar,
                 length > 0 ? Vector3d(normal / length) : Vector3d(-direction)};
}

bool RayScene::is_line_near(const Vector3d& origin, const Vector3d& direction, double max_distance) const {
  return wide_lines_ && intersect(wide_lines_.get(), new_ray(origin, direction, max_distance));
}

BundleValues RayScene::blocked(const Vector3d& origin, const Bundle& directions, float max_distance) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay16 rays{};
  BundleValues::Map(rays.org_x).setConstant(float(origin.x()));
  BundleValues::Map(rays.org_y).setConstant(float(origin.y()));
  BundleValues::Map(rays.org_z).setConstant(float(origin.z()));
  BundleValues::Map(rays.dir_x) = directions.col(0);
  BundleValues::Map(rays.dir_y) = directions.col(1);
  BundleValues::Map(rays.dir_z) = directions.col(2);
  BundleValues::Map(rays.tfar).setConstant(max_distance);
  std::fill_n(rays.mask, 16, ~0u);
  alignas(64) int valid[16];
  std::fill_n(valid, 16, -1);
  rtcOccluded16(valid, surfaces_.get(), &context, &rays);
  return (BundleValues::Map(rays.tfar) < 0).cast<float>();
}

}  // namespace furrow::io
