// Which shapes of a body may meet a box or a ray: through a tree when there are many of them.
#pragma once

#include "pfx/base_level/shape/collidable.h"
#include "pfx/low_level/broadphase/dynamic_tree.h"

namespace pfx {

// Bodies of more shapes than this are worth a tree; below, looking at all of them is as fast.
inline constexpr size_t kShapesWithoutTree = 16;

// The tree that Collidable::shape_tree refers to: bounds of the shapes in the body frame, by index.
DynamicTree makeShapeTree(std::span<const Shape> shapes);

// Calls visit(index) for shapes whose bounds overlap `box` (m, body frame). The order depends on the shapes alone.
template <class Visit>
void visitShapes(const Collidable& collidable, const Aabb& box, Visit&& visit) {
  if (collidable.shape_tree != nullptr) return collidable.shape_tree->overlap(box, visit);
  const auto shapes = collidable.shapes();
  for (uint32_t i = 0; i < shapes.size(); ++i)
    if (shapeAabb(shapes[i].geometry, shapes[i].offset).overlaps(box)) visit(i);
}

// Calls visit(index) for shapes that a ray or a swept box may meet on its way up to the fraction that visit() returned
// last (body frame).
template <class Visit>
void visitShapesAlong(const Collidable& collidable, const TreeRay& ray, Visit&& visit) {
  if (collidable.shape_tree != nullptr)
    return collidable.shape_tree->castRay(ray, [&](uint32_t i, float) { return visit(i); });
  for (uint32_t i = 0; i < collidable.shapes().size(); ++i) visit(i);
}

// A ray of the world in the frame of a body, wide enough for the rounding on its way there.
TreeRay toBody(const TreeRay& ray, const Transform& body);

}  // namespace pfx
