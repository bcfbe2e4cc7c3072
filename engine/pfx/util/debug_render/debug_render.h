// Draws the engine's data through callbacks. Knows no graphics library.
//
// Two kinds of callback:
//   immediate  - point, line, arc, axis-aligned box, oriented box: the five of the overview;
//   retained   - solid shapes: a geometry is announced once under a key (its content hash) and then drawn
//   with one
//                batched call per key and frame, with an instance for each body that wears it.
// A callback that is not set is skipped. Colours are 0xAARRGGBB.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "pfx/base_level/collision/contact_manifold.h"
#include "pfx/base_level/collision/pair.h"
#include "pfx/base_level/joint/joint.h"
#include "pfx/base_level/error.h"
#include "pfx/base_level/rigid_body/rigid_body.h"
#include "pfx/base_level/rigid_body/rigid_state.h"
#include "pfx/base_level/shape/collidable.h"

namespace pfx {

using Color = uint32_t;  // 0xAARRGGBB

// How a surface looks, so that the state of a body shows by finish as well as by hue.
enum class Finish : uint8_t { Soft, Matte, Glossy, Metallic, Dead, Translucent };

struct SolidInstance {
  Transform pose;  // shape frame to world
  Color color;     // of the surface
  Finish finish;
  uint32_t body;  // index of the body, for picking
};

struct DebugRenderCallbacks {
  void* context = nullptr;  // passed to every callback
  void (*point)(void*, const Vec3& position, Color) = nullptr;
  void (*line)(void*, const Vec3& from, const Vec3& to, Color) = nullptr;
  // Arc about `axis` from start to end (rad, counted from `direction`).
  void (*arc)(void*, const Vec3& center, const Vec3& axis, const Vec3& direction, float radius, float start,
              float end, Color) = nullptr;
  void (*aabb)(void*, const Vec3& center, const Vec3& half_extent, Color) = nullptr;
  void (*box)(void*, const Transform& pose, const Vec3& half_extent, Color) = nullptr;
  // Announces a geometry; called before the first drawSolids with this key.
  void (*define_solid)(void*, uint64_t key, const Geometry&) = nullptr;
  // Draws all instances of one geometry of this frame.
  void (*draw_solids)(void*, uint64_t key, std::span<const SolidInstance>) = nullptr;
};

// What to draw of a large mesh. Flags.
enum class MeshDraw : uint8_t {
  None = 0x00,
  Island = 0x01,     // a box round each island
  Edge = 0x02,       // three lines a triangle, coloured by what lies across: flat, convex, concave, nothing
  FacetAabb = 0x04,  // a box round each triangle
  Normal = 0x08,     // a line from the middle of each triangle
  Thickness = 0x10,  // with Edge: six more lines, the lower face and the sides
  All = 0x1f,
};
constexpr MeshDraw operator|(MeshDraw a, MeshDraw b) {
  return static_cast<MeshDraw>(static_cast<uint8_t>(a) | static_cast<uint8_t>(b));
}
constexpr bool has(MeshDraw flags, MeshDraw flag) {
  return (static_cast<uint8_t>(flags) & static_cast<uint8_t>(flag)) != 0;
}

// A half space, normal . x + offset >= 0 inside.
struct FrustumPlane {
  Vec3 normal = Vec3::UnitY();  // unit
  float offset = 0.0f;          // m
};

// A triangle of the (first) large mesh of a body.
struct MeshTriangleId {
  uint32_t body = 0;
  uint32_t island = 0;
  uint32_t triangle = 0;  // in the island
  auto operator<=>(const MeshTriangleId&) const = default;
};

// Draws what the stages work on. Immediate methods call back once per item; nothing is remembered between
// calls except which bodies are visible. Spans by body index have the length of `states`.
class DebugRender {
 public:
  explicit DebugRender(const DebugRenderCallbacks& callbacks_in = {}) : callbacks(callbacks_in) {}

  DebugRenderCallbacks callbacks;
  float scale = 1.0f;  // m, length of axes and normals

  // Makes bodies 0 .. count - 1 visible. Bodies that were never named are visible.
  void resetVisible(uint32_t count);
  void setVisible(uint32_t body, bool visible);
  bool getVisible(uint32_t body) const { return body >= hidden_.size() || !hidden_[body]; }

  // The box of the world: one aabb.
  void renderWorld(const Vec3& center, const Vec3& extent);
  // One aabb per visible body.
  void renderAabb(std::span<const RigidState> states, std::span<const Collidable> collidables);
  // Three lines per visible body: x red, y green, z blue.
  void renderLocalAxis(std::span<const RigidState> states);
  // One aabb around the visible ones among `bodies` (indices), in a colour of its own for each `island`.
  void renderIsland(uint32_t island, std::span<const uint32_t> bodies, std::span<const RigidState> states,
                    std::span<const Collidable> collidables);
  // One point and one line along the outward normal, for each contact point and visible body of the pair.
  void renderContact(std::span<const RigidState> states, const Pair& pair,
                     std::span<const ContactManifold> manifolds);
  // A line per contact point between the surfaces of A and B along the normal, `exaggeration` times as long as the gap
  // or overlap is, as millimetres would not be seen: one colour for gaps, another for overlaps.
  void renderContactDepth(std::span<const RigidState> states, const Pair& pair,
                          std::span<const ContactManifold> manifolds, float exaggeration);

  // Two points and six lines: anchors and frames of the joint in both bodies; a line for the range of each limited
  // translation, an arc for that of each limited rotation.
  void renderJoint(const Joint& joint, const Transform& body_a, const Transform& body_b);

  // The large meshes of all visible bodies.
  void renderLargeMesh(std::span<const RigidState> states, std::span<const Collidable> collidables,
                       MeshDraw what);
  // Of those, the islands whose bounding sphere touches the inside of all planes.
  void renderLargeMeshInFrustum(std::span<const RigidState> states, std::span<const Collidable> collidables,
                                MeshDraw what, std::span<const FrustumPlane> planes);
  // Of those, the islands whose bounding sphere touches a sphere.
  void renderLargeMeshInSphere(std::span<const RigidState> states, std::span<const Collidable> collidables,
                               MeshDraw what, const Vec3& center, float radius);
  // Of those, the triangles that setLargeMeshFlag has marked, each with its own flags.
  void renderLargeMeshByFlag(std::span<const RigidState> states, std::span<const Collidable> collidables);
  // Marks a triangle; None removes the mark. Error::NullPointer when the body has no large mesh,
  // Error::OutOfRange when the mesh has no such island or triangle.
  Error setLargeMeshFlag(const MeshTriangleId& triangle, const Collidable& collidable, MeshDraw what);
  // The same without a look at the mesh; marks of what is not there are not drawn.
  void setLargeMeshFlag(const MeshTriangleId& triangle, MeshDraw what);

  // The solid shapes of all visible bodies, coloured by bodyLook: one draw_solids call for each geometry in
  // use. Geometries keep their place and key from call to call. Does not allocate once every geometry was
  // seen.
  void renderSolids(std::span<const RigidState> states, std::span<const Collidable> collidables);
  // To be called when a mesh that was drawn has changed or gone, or the callbacks are others: geometries are
  // announced anew.
  void forgetSolids();

 private:
  // A geometry, its key, and the instances of this frame.
  struct Group {
    Geometry geometry;
    uint64_t key;
    std::vector<SolidInstance> instances;
  };

  struct MeshView;
  template <class Inside>
  void renderIslands(std::span<const RigidState> states, std::span<const Collidable> collidables,
                     MeshDraw what, Inside&& inside);
  void renderMeshIsland(const MeshView& view, uint32_t island);
  void renderTriangle(const MeshView& view, uint32_t facet, MeshDraw what);

  uint32_t groupOf(const Geometry& geometry);
  void addInstances(uint32_t body, const RigidState& state, std::span<const Shape> shapes,
                    std::span<uint32_t> groups);

  std::vector<bool> hidden_;  // by body
  std::map<MeshTriangleId, MeshDraw> mesh_flags_;
  std::vector<Group> groups_;  // in the order in which geometries were first seen
  std::unordered_map<uint64_t, uint32_t> group_of_identity_;
  std::vector<uint32_t> last_group_;  // by shape, those of a body in a row: its group in the last call
};

}  // namespace pfx
