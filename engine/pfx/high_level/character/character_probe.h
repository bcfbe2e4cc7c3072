// What a character asks of the world around it. All queries pass the character's own body.
#pragma once

#include <optional>

#include "pfx/high_level/character/character.h"

namespace pfx {

// Bodies that do not give way, and bodies that do.
inline constexpr uint8_t kRigidObstacles =
    motionTypeBit(MotionType::Fixed) | motionTypeBit(MotionType::Keyframe);
inline constexpr uint8_t kMovableObstacles = motionTypeBit(MotionType::Active);
inline constexpr uint8_t kAllObstacles = kRigidObstacles | kMovableObstacles;

// A step that can be taken.
struct StepUp {
  float rise;  // m, of its top above the feet
};

class CharacterProbe {
 public:
  CharacterProbe(const World& world, const Character& character);

  const Vec3& center() const { return center_; }  // m, of the capsule
  float feetHeight() const { return center_.y() - 0.5f * height_; }
  bool canWalkOn(const Vec3& normal) const { return normal.y() >= min_normal_y_; }

  // The capsule moved from `start` by `motion`.
  ShapeCastOutput cast(const Vec3& start, const Vec3& motion, uint8_t types) const;

  // What is below the capsule when it is at `center`, down to `reach` below its feet.
  CharacterSupport findSupport(const Vec3& center, float reach) const;

  // Whether `hit`, met by the capsule at `center` on its way along the unit vector `direction`, is a step
  // that it can take: a top that can be walked on, not too high, with room above.
  std::optional<StepUp> findStep(const Vec3& center, const ShapeCastOutput& hit, const Vec3& direction) const;

  // Whether the capsule, which crouches, has room to stand up.
  bool hasHeadroom() const;

 private:
  struct Surface {
    Vec3 point, normal;
  };
  // The surface of a body that does not overlap the start, straight below a point.
  std::optional<Surface> surfaceBelow(const Vec3& start, float depth, uint8_t types) const;
  ShapeCastOutput castGeometry(const Geometry& geometry, const Vec3& start, const Vec3& motion,
                               uint8_t types) const;

  const World& world_;
  const CharacterParams& params_;
  const RigidState& state_;
  uint32_t body_;
  float height_;
  Vec3 center_;
  float min_normal_y_;
};

}  // namespace pfx
