#include "pfx/high_level/particles/particle_contacts.h"

#include <algorithm>
#include <cmath>

#include "pfx/base_level/ray/ray.h"
#include "pfx/high_level/particles/surface_distance.h"

namespace pfx {
namespace {

constexpr uint32_t kBlock = 32;    // particles that share bounds
constexpr uint32_t kGrain = 64;    // contacts a task
constexpr float kMaxPush = 3.0f;   // m/s, speed at which what overlaps at first is pushed apart

// One shape and where it is in the sub-step.
struct Obstacle {
  ParticleBody& body;
  const Shape& shape;
};

// The surface where a particle that went from `from` to `to` (shape frame) meets it.
template <class G>
SurfaceDistance meet(const G& geometry, const Vec3& from, const Vec3& to, float radius) {
  const Vec3 way = to - from;
  const float length2 = way.squaredNorm();
  if (length2 > radius * radius) {
    ShapeHit hit;
    const LocalRay ray{from.cast<double>(), way.cast<double>()};
    if constexpr (std::is_pointer_v<G>)
      hit = castRay(ray, *geometry);
    else
      hit = castRay(ray, geometry);
    if (hit.hit) {
      const Vec3 point = from + static_cast<float>(hit.fraction) * way;
      return {hit.normal.dot(to - point), hit.normal};
    }
  }
  return surfaceDistance(geometry, to, radius);
}

// Motion of the material point of the body that is at `point` now, since the start of the sub-step.
Vec3 surfaceMotion(const ParticleBody& b, const Vec3& point) {
  return point - b.before.apply(b.now.applyInverse(point));
}

template <class G>
void resolve(const G& geometry, const Obstacle& o, const ParticleContacts::SolveInput& in, uint32_t particle) {
  Vec3& x = in.particles.position[particle];
  const Vec3 &from = in.previous[particle], &offset = o.shape.offset.position;
  const Quat& turn = o.shape.offset.orientation;
  const auto toShape = [&](const Transform& body, const Vec3& p) {
    return Vec3(turn.conjugate() * (body.applyInverse(p) - offset));
  };
  const float radius = in.settings.radius;
  const SurfaceDistance s = meet(geometry, toShape(o.body.before, from), toShape(o.body.now, x), radius);
  float depth = radius - s.distance;
  const float w = o.body.yields_only ? 0.0f : in.particles.inverse_mass[particle];
  if (!(depth > 0.0f)) return;

  const Vec3 normal = o.body.now.orientation * (turn * s.normal);
  const Vec3 point = x - s.distance * normal;
  const float w_body = o.body.inverseMass(point, normal);
  if (!(w + w_body > 0.0f)) return;
  Vec3 slip = (x - from) - surfaceMotion(o.body, point);
  const float approach = -slip.dot(normal);
  depth = std::min(depth, std::max(approach, 0.0f) + kMaxPush * in.h);
  Vec3 impulse = depth / (w + w_body) * normal;

  slip += approach * normal;
  const float slipped = slip.norm();
  if (slipped > 0.0f) {
    const Vec3 direction = slip / slipped;
    const float friction = std::sqrt(in.settings.friction * o.body.friction);
    const float stop = slipped / (w + o.body.inverseMass(point, direction));
    impulse -= std::min(stop, friction * depth / (w + w_body)) * direction;
  }
  x += w * impulse;
  if (o.body.feels()) o.body.push(-impulse, point, in.h);
}

Aabb shapeWay(const ParticleSurroundings& around, uint32_t body, const Shape& shape) {
  Aabb box = shapeAabb(shape.geometry, around.states[body].pose() * shape.offset);
  box.extend(shapeAabb(shape.geometry, around.start_poses[body] * shape.offset));
  return box;
}

Aabb bodyWay(const ParticleSurroundings& around, uint32_t body) {
  const Collidable& c = around.collidables[body];
  Aabb box = transformedAabb(around.states[body].pose(), c.center, c.half_extent);
  box.extend(transformedAabb(around.start_poses[body], c.center, c.half_extent));
  return box;
}

bool mayTouch(const RigidState& s, const ParticleSettings& settings) {
  return s.motion_type != MotionType::Trigger &&
         filtersMatch(s.filter_self, s.filter_target, settings.filter_self, settings.filter_target);
}

}  // namespace

// A particle may be pulled farther than it would fly, so its way is taken to be half as long again.
void ParticleContacts::boundBlocks(const FindInput& in) {
  ways_.resize(in.position.size());
  blocks_.assign((in.position.size() + kBlock - 1) / kBlock, {});
  bounds_ = {};
  const Vec3 fall = in.settings.gravity_scale * in.dt * in.dt * in.gravity;
  for (uint32_t i = 0; i < in.position.size(); ++i) {
    Aabb& way = ways_[i] = {};
    way.extend(in.position[i]);
    way.extend(in.position[i] + 1.5f * in.dt * in.velocity[i] + fall);
    way = way.grown(2.0f * in.settings.radius);
    blocks_[i / kBlock].bounds.extend(way);
  }
  for (const Block& b : blocks_) bounds_.extend(b.bounds);
}

void ParticleContacts::listNear(const Aabb& box, const FindInput& in) {
  for (uint32_t b = 0; b < blocks_.size(); ++b) {
    if (!blocks_[b].bounds.overlaps(box)) continue;
    const auto end = std::min((b + 1) * kBlock, static_cast<uint32_t>(ways_.size()));
    for (uint32_t i = b * kBlock; i < end; ++i)
      if (!in.anchored[i] && ways_[i].overlaps(box)) near_.push_back(i);
  }
}

void ParticleContacts::find(const FindInput& in, std::vector<ParticleBody>& bodies) {
  groups_.clear(), near_.clear();
  boundBlocks(in);
  for (uint32_t body = 0; body < in.around.states.size(); ++body) {
    const Collidable& c = in.around.collidables[body];
    if (c.half_extent.isZero(0.0f) || !mayTouch(in.around.states[body], in.settings)) continue;
    if (!bodyWay(in.around, body).overlaps(bounds_)) continue;
    for (uint32_t k = 0; k < c.shapes().size(); ++k) {
      const auto first = static_cast<uint32_t>(near_.size());
      listNear(shapeWay(in.around, body, c.shapes()[k]), in);
      if (near_.size() == first) continue;
      auto found = std::find_if(bodies.begin(), bodies.end(), [&](const ParticleBody& b) { return b.body == body; });
      if (found == bodies.end()) found = bodies.insert(bodies.end(), ParticleBody(in.around, body));
      groups_.push_back({static_cast<uint32_t>(found - bodies.begin()), k, first,
                         static_cast<uint32_t>(near_.size()) - first});
    }
  }
}

void ParticleContacts::solve(const SolveInput& in, std::span<ParticleBody> bodies, TaskManager& tasks) {
  for (const Group& g : groups_) {
    ParticleBody& body = bodies[g.body];
    const Obstacle obstacle{body, in.around.collidables[body.body].shapes()[g.shape]};
    const auto particles = std::span<const uint32_t>(near_).subspan(g.first, g.count);
    std::visit(
        [&](const auto& geometry) {
          // A body that feels them is pushed by one particle after the other.
          tasks.parallelFor(g.count, body.feels() ? g.count : kGrain, [&](TaskRange r) {
            for (uint32_t i = r.begin; i < r.end; ++i) resolve(geometry, obstacle, in, particles[i]);
          });
        },
        obstacle.shape.geometry);
  }
}

}  // namespace pfx
