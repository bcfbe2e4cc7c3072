#include "pfx/low_level/broadphase/shape_tree.h"

namespace pfx {

DynamicTree makeShapeTree(std::span<const Shape> shapes) {
  Vector<TreeLeaf> leaves;
  for (uint32_t i = 0; i < shapes.size(); ++i) leaves.push_back({shapeAabb(shapes[i].geometry, shapes[i].offset), i});
  Vector<DynamicTree::Location> locations(leaves.size(), DynamicTree::kNowhere);
  DynamicTree tree;
  tree.build(leaves, locations);
  return tree;
}

TreeRay toBody(const TreeRay& ray, const Transform& body) {
  constexpr float kRounding = 1e-6f;  // of all coordinates that take part
  const Mat3 to_body = body.orientation.conjugate().toRotationMatrix();
  const float size = ray.origin.cwiseAbs().maxCoeff() + body.position.cwiseAbs().maxCoeff() + ray.motion.norm();
  return {to_body * (ray.origin - body.position), to_body * ray.motion,
          to_body.cwiseAbs() * ray.half_extent + Vec3::Constant(kRounding * size), ray.max_fraction};
}

}  // namespace pfx
