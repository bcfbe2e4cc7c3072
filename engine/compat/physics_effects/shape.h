// Shapes, and the collidable that gives a body its shapes. Sizes are half lengths in m; capsule and cylinder lie along X.
#pragma once

#include "mesh.h"

namespace sce {
namespace PhysicsEffects {

// A ball about the origin.
struct PfxSphere {
  // Radius, m.
  PfxSphere() : m_radius(1.0f) {}
  PfxSphere(PfxFloat radius) : m_radius(radius) {}
  void set(PfxFloat radius) { m_radius = radius; }
  PfxFloat m_radius;
};

// A box about the origin.
struct PfxBox {
  // Half lengths along x, y and z, m.
  PfxBox() : m_half(1.0f) {}
  PfxBox(const PfxVector3& half) : m_half(half) {}
  PfxBox(PfxFloat x, PfxFloat y, PfxFloat z) : m_half(x, y, z) {}
  void set(const PfxVector3& half) { m_half = half; }
  void set(PfxFloat x, PfxFloat y, PfxFloat z) { m_half = PfxVector3(x, y, z); }
  PfxFloat get(int axis) const { return m_half[axis]; }
  PfxVector3 m_half;
};

// A segment along x with all points nearer to it than the radius.
struct PfxCapsule {
  // Half length of the core segment and radius, m.
  PfxCapsule() : m_halfLen(1.0f), m_radius(1.0f) {}
  PfxCapsule(PfxFloat halfLength, PfxFloat radius) : m_halfLen(halfLength), m_radius(radius) {}
  void set(PfxFloat halfLength, PfxFloat radius) { m_halfLen = halfLength, m_radius = radius; }
  PfxFloat m_halfLen;  // of the core segment, without the caps
  PfxFloat m_radius;
};

// A cylinder along x.
struct PfxCylinder {
  // Half length and radius, m.
  PfxCylinder() : m_halfLen(1.0f), m_radius(1.0f) {}
  PfxCylinder(PfxFloat halfLength, PfxFloat radius) : m_halfLen(halfLength), m_radius(radius) {}
  void set(PfxFloat halfLength, PfxFloat radius) { m_halfLen = halfLength, m_radius = radius; }
  PfxFloat m_halfLen;
  PfxFloat m_radius;
};

// Kinds of shapes.
enum ePfxShapeType {
  kPfxShapeSphere = 0,
  kPfxShapeBox,
  kPfxShapeCapsule,
  kPfxShapeCylinder,
  kPfxShapeConvexMesh,
  kPfxShapeLargeTriMesh,
  kPfxShapeCount  // of the kinds that there are
};

// One geometry placed in its body. Primitives are held by value, meshes by pointer: they must outlive the shape.
class PfxShape {
 public:
  // A sphere without a radius yet, at the origin of the body; filters all ones.
  PfxShape() { reset(); }
  void reset();

  // What the shape is.
  void setSphere(const PfxSphere& s) { set(kPfxShapeSphere, s.m_radius); }
  void setBox(const PfxBox& b) { set(kPfxShapeBox, b.m_half[0], b.m_half[1], b.m_half[2]); }
  void setCapsule(const PfxCapsule& c) { set(kPfxShapeCapsule, c.m_halfLen, c.m_radius); }
  void setCylinder(const PfxCylinder& c) { set(kPfxShapeCylinder, c.m_halfLen, c.m_radius); }
  void setConvexMesh(const PfxConvexMesh* mesh) { set(kPfxShapeConvexMesh), mesh_ = mesh; }
  void setLargeTriMesh(const PfxLargeTriMesh* mesh) { set(kPfxShapeLargeTriMesh), mesh_ = mesh; }

  // The kind (ePfxShapeType), and the sizes as this kind; NULL for a mesh of another kind.
  PfxUInt8 getType() const { return type_; }
  PfxSphere getSphere() const { return PfxSphere(size_[0]); }
  PfxBox getBox() const { return PfxBox(size_[0], size_[1], size_[2]); }
  PfxCapsule getCapsule() const { return PfxCapsule(size_[0], size_[1]); }
  PfxCylinder getCylinder() const { return PfxCylinder(size_[0], size_[1]); }
  const PfxConvexMesh* getConvexMesh() const {
    return type_ == kPfxShapeConvexMesh ? static_cast<const PfxConvexMesh*>(mesh_) : nullptr;
  }
  const PfxLargeTriMesh* getLargeTriMesh() const {
    return type_ == kPfxShapeLargeTriMesh ? static_cast<const PfxLargeTriMesh*>(mesh_) : nullptr;
  }

  // Pose in the body, m.
  PfxVector3 getOffsetPosition() const { return pfxReadVector3(position_); }
  PfxQuat getOffsetOrientation() const { return pfxReadQuat(orientation_); }
  PfxTransform3 getOffsetTransform() const { return PfxTransform3(getOffsetOrientation(), getOffsetPosition()); }
  void setOffsetPosition(const PfxVector3& v) { pfxStoreVector3(v, position_); }
  void setOffsetOrientation(const PfxQuat& q) { pfxStoreQuat(q, orientation_); }
  void setOffsetTransform(const PfxTransform3& t) {
    setOffsetPosition(t.getTranslation()), setOffsetOrientation(PfxQuat(t.getUpper3x3()));
  }

  // Of the shape, besides those of its body.
  PfxUInt32 getContactFilterSelf() const { return filter_self_; }
  PfxUInt32 getContactFilterTarget() const { return filter_target_; }
  void setContactFilterSelf(PfxUInt32 filter) { filter_self_ = filter; }
  void setContactFilterTarget(PfxUInt32 filter) { filter_target_ = filter; }
  void* getUserData() const { return user_data_; }
  void setUserData(void* data) { user_data_ = data; }

  // Bounds in the body frame.
  void getAabb(PfxVector3& aabbMin, PfxVector3& aabbMax) const;
  void getAabb(PfxVector3& aabbMin, PfxVector3& aabbMax, const PfxTransform3& transform) const;

 private:
  friend struct NativeLayout;
  friend struct PfxSerializeAccess;
  void set(ePfxShapeType type, PfxFloat a = 0.0f, PfxFloat b = 0.0f, PfxFloat c = 0.0f) {
    type_ = static_cast<PfxUInt8>(type), size_[0] = a, size_[1] = b, size_[2] = c, mesh_ = nullptr;
  }

  PfxFloat position_[3];
  PfxFloat orientation_[4];
  PfxFloat size_[3];
  PfxUInt32 filter_self_;
  PfxUInt32 filter_target_;
  PfxUInt8 type_;
  const void* mesh_;
  void* user_data_;
};

// The shapes of one body and their bounds in the body frame. A single shape is copied; several lie in an array of the
// application, which must outlive the collidable.
class PfxCollidable {
 public:
  // Without shapes yet.
  PfxCollidable() { reset(); }
  // One shape, held inside.
  void reset();
  // Up to `numShapes` (at most 64) shapes: the n-th that is added is copied to shapes[shapeIds[n]].
  // SCE_PFX_ERR_INVALID_VALUE for NULL, SCE_PFX_ERR_OUT_OF_RANGE for 0 or more than 64; the collidable then holds one.
  PfxInt32 reset(PfxShape* shapes, const PfxUInt16* shapeIds, PfxUInt32 numShapes = 1);
  // SCE_PFX_ERR_OUT_OF_RANGE when all places are taken.
  PfxInt32 addShape(const PfxShape& shape);
  // Place of the i-th shape in the array of the application; the shape that is held inside.
  PfxUInt16 getShapeId(PfxUInt32 i) const { return shape_ids_[i]; }
  const PfxShape& getDefShape() const { return own_shape_; }
  // Computes the bounds; to be called when all shapes are there. SCE_PFX_ERR_INVALID_VALUE: no shape, a size that is
  // not finite and positive, or a mesh that was not created. The bounds are empty then.
  PfxInt32 finish();

  // Shapes that were added and that have room, the shapes, the bounds in the body (m), and data of the application.
  PfxUInt32 getNumShapes() const { return num_shapes_; }
  PfxUInt32 getMaxNumShapes() const { return max_shapes_; }
  const PfxShape* getShapeArray() const { return shapes_; }  // of the application; NULL for a single shape
  const PfxShape& getShape(PfxUInt32 i) const { return shapes_ == nullptr ? own_shape_ : shapes_[shape_ids_[i]]; }
  PfxShape& getShape(PfxUInt32 i) { return shapes_ == nullptr ? own_shape_ : shapes_[shape_ids_[i]]; }
  PfxVector3 getCenter() const { return pfxReadVector3(center_); }
  PfxVector3 getHalf() const { return pfxReadVector3(half_); }
  void setCenter(const PfxVector3& center) { pfxStoreVector3(center, center_); }
  void setHalf(const PfxVector3& half) { pfxStoreVector3(half, half_); }
  void* getUserData() const { return user_data_; }
  void setUserData(void* data) { user_data_ = data; }

 private:
  friend struct PfxSerializeAccess;
  PfxShape own_shape_;
  PfxShape* shapes_;
  PfxUInt16 shape_ids_[SCE_PFX_MAX_SHAPES];
  PfxUInt8 num_shapes_, max_shapes_;
  PfxFloat center_[3], half_[3];
  void* user_data_;
};

// Walks over the shapes of a collidable: for (i = 0; i < getNumShapes(); ++i, ++iterator) use *iterator.
class PfxShapeIterator {
 public:
  // Begins at the first shape; * gives the shape, ++ goes on.
  explicit PfxShapeIterator(const PfxCollidable& collidable) : collidable_(collidable) {}
  PfxShapeIterator& operator++() { return ++at_, *this; }
  const PfxShape& operator*() const { return collidable_.getShape(at_); }

 private:
  const PfxCollidable& collidable_;
  PfxUInt32 at_ = 0;
};

}  // namespace PhysicsEffects
}  // namespace sce
