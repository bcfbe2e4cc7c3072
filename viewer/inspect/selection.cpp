#include "viewer/inspect/selection.h"

#include "viewer/inspect/island_facts.h"

namespace viewer {

using pfx::World;

Selection selectBody(const World& world, uint32_t body) {
  if (body >= world.states().size() || !world.bodyId(body)) return {};
  return {.kind = PickKind::Body, .body = world.bodyId(body)};
}

Selection selectTriangle(const World& world, uint32_t body, uint32_t facet) {
  const auto placed = meshOfBody(world, body);
  if (!placed || facet >= placed->mesh->numFacets()) return {};
  return {.kind = PickKind::Triangle, .body = world.bodyId(body), .facet = facet};
}

Selection selectContact(const World& world, const pfx::Pair& pair) {
  return {.kind = PickKind::Contact, .body = world.bodyId(pair.body_a), .other = world.bodyId(pair.body_b)};
}

Selection selectJoint(const World& world, uint32_t joint) {
  return {.kind = PickKind::Joint, .joint = world.jointId(joint)};
}

Selection selectIsland(const World& world, uint32_t island) {
  return {.kind = PickKind::Island, .body = world.bodyId(world.island(island).bodies.front())};
}

Selection selectPicked(const World& world, uint32_t id, const Ray& ray) {
  const uint32_t index = pickIndex(id);
  switch (pickKind(id)) {
    case PickKind::Body:
      if (const auto placed = meshOfBody(world, index))
        if (const auto facet = pickTriangle(*placed, ray)) return selectTriangle(world, index, *facet);
      return selectBody(world, index);
    case PickKind::Contact:
      return index < world.contactPairs().size() ? selectContact(world, world.contactPairs()[index]) : Selection{};
    case PickKind::Joint:
      return index < world.jointLinks().size() ? selectJoint(world, index) : Selection{};
    case PickKind::Island:
      return index < world.numIslands() ? selectIsland(world, index) : Selection{};
    default:
      return {};
  }
}

namespace {

std::optional<uint32_t> pairOf(const World& world, const Selection& s) {
  return findPair(world, s.body.index, s.other.index);
}

}  // namespace

Selection stillThere(const World& world, const Selection& s) {
  switch (s.kind) {
    case PickKind::Body:
      return world.isValid(s.body) ? s : Selection{};
    case PickKind::Triangle: {
      const auto placed = world.isValid(s.body) ? meshOfBody(world, s.body.index) : std::nullopt;
      return placed && s.facet < placed->mesh->numFacets() ? s : Selection{};
    }
    case PickKind::Contact:
      return world.isValid(s.body) && world.isValid(s.other) ? s : Selection{};
    case PickKind::Joint:
      return world.isValid(s.joint) ? s : Selection{};
    case PickKind::Island:
      return world.isValid(s.body) && islandOfBody(world, s.body.index) ? s : Selection{};
    default:
      return {};
  }
}

uint32_t pickOf(const World& world, const Selection& s) {
  if (s.kind == PickKind::Body) return pickId(PickKind::Body, s.body.index);
  if (s.kind == PickKind::Joint) return pickId(PickKind::Joint, s.joint.index);
  if (s.kind == PickKind::Contact)
    if (const auto pair = pairOf(world, s)) return pickId(PickKind::Contact, *pair);
  if (s.kind == PickKind::Island)
    if (const auto island = islandOfBody(world, s.body.index)) return pickId(PickKind::Island, *island);
  return 0;
}

std::string titleOf(const World& world, const Selection& s) {
  switch (s.kind) {
    case PickKind::Body:
      return bodyTitle(world, s.body.index);
    case PickKind::Triangle:
      return "triangle " + std::to_string(s.facet) + " of " + bodyTitle(world, s.body.index);
    case PickKind::Contact:
      return bodyTitle(world, s.body.index) + " on " + bodyTitle(world, s.other.index);
    case PickKind::Joint: {
      const std::string_view name = world.jointName(s.joint.index);
      return name.empty() ? "joint " + std::to_string(s.joint.index) : "joint " + std::string(name);
    }
    case PickKind::Island: {
      const auto island = islandOfBody(world, s.body.index);
      return island ? "island " + std::to_string(*island) : "";
    }
    default:
      return "";
  }
}

FactSheet factsOf(const World& world, const Selection& s) {
  switch (s.kind) {
    case PickKind::Body:
      return bodyFacts(world, s.body.index);
    case PickKind::Triangle:
      return triangleFacts(world, s.body.index, s.facet);
    case PickKind::Contact:
      if (const auto pair = pairOf(world, s)) return contactFacts(world, world.contactPairs()[*pair]);
      return {};
    case PickKind::Joint:
      return jointFacts(world, s.joint.index);
    default:
      return {};
  }
}

std::vector<uint32_t> bodiesOf(const World& world, const Selection& s) {
  switch (s.kind) {
    case PickKind::Body:
    case PickKind::Triangle:
      return {s.body.index};
    case PickKind::Contact:
      return {s.body.index, s.other.index};
    case PickKind::Joint: {
      const pfx::JointLink& link = world.jointLinks()[s.joint.index];
      return {link.body_a, link.body_b};
    }
    case PickKind::Island: {
      const auto island = islandOfBody(world, s.body.index);
      if (!island) return {};
      const auto bodies = world.island(*island).bodies;
      return {bodies.begin(), bodies.end()};
    }
    default:
      return {};
  }
}

pfx::Aabb boundsOf(const World& world, const Selection& s) {
  pfx::Aabb box;
  const auto around = [&](const pfx::Vec3& p, float radius) { box.extend(pfx::Aabb{p, p}.grown(radius)); };
  if (s.kind == PickKind::Triangle) {
    const auto placed = meshOfBody(world, s.body.index);
    if (!placed) return box;
    for (const pfx::Vec3& v : pfx::facetVertices(*placed->mesh, s.facet)) box.extend(placed->pose.apply(v));
  } else if (s.kind == PickKind::Contact) {
    if (const auto pair = pairOf(world, s))
      for (const pfx::ContactManifold& m : world.manifolds(world.contactPairs()[*pair]))
        for (int k = 0; k < m.num_points; ++k)
          around(world.states()[s.body.index].pose().apply(m.points[size_t(k)].local_a), 0.3f);
  } else if (s.kind == PickKind::Joint) {
    const pfx::JointLink& link = world.jointLinks()[s.joint.index];
    around(world.states()[link.body_a].pose().apply(world.joints()[s.joint.index].anchor_a), 0.7f);
  } else {
    for (uint32_t body : bodiesOf(world, s)) {
      const pfx::Collidable& c = world.collidables()[body];
      box.extend(pfx::transformedAabb(world.states()[body].pose(), c.center, c.half_extent));
    }
  }
  return box;
}

}  // namespace viewer
