#include "compat/physics_effects/shape.h"

#include <algorithm>

#include "compat/physics_effects/native.h"
#include "pfx/base_level/shape/collidable.h"

namespace sce::PhysicsEffects {

void PfxShape::reset() {
  set(kPfxShapeSphere, 1.0f);
  setOffsetPosition(PfxVector3(0.0f));
  setOffsetOrientation(PfxQuat::identity());
  filter_self_ = filter_target_ = 0xffffffffu;
  user_data_ = nullptr;
}

pfx::Shape native(const PfxShape& shape) {
  pfx::Shape s;
  std::memcpy(static_cast<void*>(&s.offset), &shape, sizeof(pfx::Transform));
  switch (shape.getType()) {
    case kPfxShapeSphere: s.geometry = pfx::Sphere{shape.getSphere().m_radius}; break;
    case kPfxShapeBox: s.geometry = pfx::Box{native(shape.getBox().m_half)}; break;
    case kPfxShapeCapsule: s.geometry = pfx::Capsule{shape.getCapsule().m_halfLen, shape.getCapsule().m_radius}; break;
    case kPfxShapeCylinder: s.geometry = pfx::Cylinder{shape.getCylinder().m_halfLen, shape.getCylinder().m_radius}; break;
    case kPfxShapeConvexMesh: s.geometry = static_cast<const pfx::ConvexMesh*>(shape.getConvexMesh()->m_native); break;
    default: s.geometry = static_cast<const pfx::LargeMesh*>(shape.getLargeTriMesh()->m_native); break;
  }
  return s;
}

bool isValid(const PfxShape& shape) {
  switch (shape.getType()) {
    case kPfxShapeConvexMesh: return shape.getConvexMesh() != nullptr && shape.getConvexMesh()->m_native != nullptr;
    case kPfxShapeLargeTriMesh: return shape.getLargeTriMesh() != nullptr && shape.getLargeTriMesh()->m_native != nullptr;
    default: return shape.getType() < kPfxShapeCount;
  }
}

void PfxShape::getAabb(PfxVector3& aabbMin, PfxVector3& aabbMax, const PfxTransform3& transform) const {
  aabbMin = aabbMax = transform.getTranslation();
  if (!isValid(*this)) return;
  const pfx::Shape s = native(*this);
  const pfx::Transform body{native(transform.getTranslation()), native(PfxQuat(transform.getUpper3x3()))};
  const pfx::Aabb box = pfx::shapeAabb(s.geometry, body * s.offset);
  aabbMin = compat(box.min), aabbMax = compat(box.max);
}
void PfxShape::getAabb(PfxVector3& aabbMin, PfxVector3& aabbMax) const {
  getAabb(aabbMin, aabbMax, PfxTransform3::identity());
}

void PfxCollidable::reset() {
  own_shape_.reset();
  shapes_ = nullptr;
  num_shapes_ = 0;
  max_shapes_ = 1;
  std::fill(std::begin(shape_ids_), std::end(shape_ids_), PfxUInt16(0));
  setCenter(PfxVector3(0.0f));
  setHalf(PfxVector3(0.0f));
  user_data_ = nullptr;
}

PfxInt32 PfxCollidable::reset(PfxShape* shapes, const PfxUInt16* shapeIds, PfxUInt32 numShapes) {
  reset();
  if (shapes == nullptr || shapeIds == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if (numShapes == 0 || numShapes > SCE_PFX_MAX_SHAPES) return SCE_PFX_ERR_OUT_OF_RANGE;
  shapes_ = shapes;
  std::copy_n(shapeIds, numShapes, shape_ids_);
  max_shapes_ = static_cast<PfxUInt8>(numShapes);
  return SCE_PFX_OK;
}

PfxInt32 PfxCollidable::addShape(const PfxShape& shape) {
  if (num_shapes_ == max_shapes_) return SCE_PFX_ERR_OUT_OF_RANGE;
  getShape(num_shapes_++) = shape;
  return SCE_PFX_OK;
}

PfxInt32 PfxCollidable::finish() {
  setCenter(PfxVector3(0.0f));
  setHalf(PfxVector3(0.0f));
  if (num_shapes_ == 0) return SCE_PFX_ERR_INVALID_VALUE;
  pfx::Aabb box;
  for (PfxUInt32 i = 0; i < num_shapes_; ++i) {
    if (!isValid(getShape(i))) return SCE_PFX_ERR_INVALID_VALUE;
    pfx::Collidable one;
    one.inline_shape = native(getShape(i));
    if (one.finish() != pfx::Error::Ok) return SCE_PFX_ERR_INVALID_VALUE;
    const bool solid = getShape(i).getType() == kPfxShapeLargeTriMesh || one.half_extent.minCoeff() > 0.0f;
    if (!solid) return SCE_PFX_ERR_INVALID_VALUE;
    box.extend(pfx::Aabb{one.center - one.half_extent, one.center + one.half_extent});
  }
  setCenter(compat(box.center()));
  setHalf(compat(box.halfExtent()));
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
