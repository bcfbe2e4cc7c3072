// Taking and restoring snapshots.
//
// "PFXSNAP" and a zero, version (4 bytes), number of sections (4), then the sections in a fixed order: tag (4 bytes),
// length (8), XXH64 of the content (8), content.
#include "pfx/high_level/world/snapshot.h"

#include <cmath>

#include "pfx/high_level/pipeline/stages.h"
#include "pfx/high_level/world/snapshot_state.h"
#include "pfx/util/state_hash/state_hash.h"

namespace pfx {
namespace {

using namespace snapshot_format;

constexpr uint32_t kVersion = 4;
constexpr std::array<uint8_t, 8> kMagic = {'P', 'F', 'X', 'S', 'N', 'A', 'P', 0};
constexpr size_t kHeaderBytes = 16, kSectionBytes = 20;

// What the broad phase knows of a body.
struct Leaf {
  uint32_t body;
  Aabb bounds;
};

// What a directly solved joint remembers of a row besides its force.
struct RowMemory {
  RowState state = RowState::Off;
  bool held = false;
  uint8_t side = 1;  // of the bound that it is clamped to, plus one
};

struct Content {
  World::Impl& world;
  Vector<Leaf> leaves;
  Vector<RowMemory> rows;  // in the order of components, joints and rows
};

template <class Fn>
void forEachRow(World::Impl& w, Fn&& fn) {
  for (JointComponent& c : w.joint_components.components())
    for (DirectJoint& j : c.direct.joints())
      for (int k = 0; k < j.num_rows; ++k) fn(j.row[k]);
}

template <class A>
void ioWorld(A& a, Content& c) {
  WorldDef& d = c.world.def;
  io(a, d.gravity);
  ioEnum(a, d.pipeline, Pipeline::Stable);
  io(a, d.substeps);
  ioEnum(a, d.joint_solver, JointSolver::Soft);
  ioEnum(a, d.contact_solver, ContactSolver::Newton);
  ioEnum(a, d.friction_mixing, Mixing::Product), ioEnum(a, d.restitution_mixing, Mixing::Product);
  io(a, d.report_events), io(a, d.hit_speed);
  io(a, d.sleeping), io(a, d.sleep_velocity), io(a, d.sleep_steps), io(a, d.center), io(a, d.extent);
  io(a, c.world.dt), io(a, c.world.substep), io(a, c.world.step_count);
  if constexpr (A::kReads) a.require(d.substeps >= 1, "substeps are below 1");
}

template <class A>
void ioMeshes(A& a, Content& c) {
  ioList(a, c.world.convex_meshes, [](A& archive, ConvexMesh& m) { io(archive, m); });
  ioList(a, c.world.large_meshes, [](A& archive, LargeMesh& m) { io(archive, m); });
  ioList(a, c.world.mesh_motions, [&](A& archive, MeshMotion& m) {
    io(archive, m.mesh), io(archive, m.is_moving), io(archive, m.fastest), io(archive, m.farthest);
    io(archive, m.before), io(archive, m.now), io(archive, m.velocity);
    if constexpr (A::kReads) {
      archive.require(m.mesh < c.world.large_meshes.size(), "a mesh that moves is not there");
      const size_t n = c.world.large_meshes[m.mesh].num_source_vertices;
      archive.require(m.before.size() == n && m.now.size() == n && m.velocity.size() == n,
                      "a mesh that moves has another number of vertices");
    }
  });
}

template <class A>
void ioBodies(A& a, Content& c) {
  BodyStore& s = c.world.store;
  io(a, s.states), io(a, s.bodies), io(a, s.inertias), io(a, s.size), io(a, s.radius), io(a, s.names);
  io(a, s.surfaces);
  io(a, s.generations), io(a, s.free_slots);
  ioList(a, s.collidables, [](A& archive, Collidable& k) { io(archive, k.center), io(archive, k.half_extent); });
  KeptMeshes meshes{c.world.convex_meshes, c.world.large_meshes};
  ioList(a, s.shapes, [&](A& archive, Vector<Shape>& shapes) {
    ioList(archive, shapes, [&](A& inner, Shape& shape) { ioShape(inner, shape, meshes); });
  });
  io(a, c.world.keyframes), io(a, c.world.changed_bodies), io(a, c.world.reach);
  io(a, c.world.next_sleeper), io(a, c.world.has_woken), io(a, c.world.since_touch);
}

template <class A>
void ioJoints(A& a, Content& c) {
  JointStore& s = c.world.joint_store;
  io(a, s.joints), io(a, s.links), io(a, s.names), io(a, s.break_force), io(a, s.break_torque);
  io(a, s.generations), io(a, s.free_slots), io(a, c.world.broken_joints);
  Vector<uint64_t> apart(c.world.apart.keys().begin(), c.world.apart.keys().end());
  io(a, apart);
  if constexpr (A::kReads) c.world.apart.assign(std::move(apart));
}

// A removed system leaves its slot, and an empty definition.
template <class A>
void ioParticles(A& a, Content& c) {
  ParticleStore& store = c.world.particle_store;
  io(a, store.generations);
  auto& systems = store.systems;
  ioList(a, systems, [&](A& archive, std::unique_ptr<ParticleSystem>& system) {
    ParticleDef def;
    if constexpr (!A::kReads)
      if (system) def = system->def();
    io(archive, def);
    if constexpr (A::kReads) {
      if (def.positions.empty()) return;
      try {
        system = std::make_unique<ParticleSystem>(def, c.world.store.states);
      } catch (const std::invalid_argument& e) {
        archive.fail(e.what());
      }
      ++store.count;
    }
  });
  if constexpr (A::kReads) {
    bool fits = store.generations.size() == systems.size();
    for (size_t i = 0; fits && i < systems.size(); ++i) fits = (store.generations[i] % 2 == 1) == (systems[i] != nullptr);
    a.require(fits, "the slots of the systems are wrong");
  }
}

template <class A>
void ioContacts(A& a, Content& c) {
  ioPairs(a, c.world.pairs, c.world.contacts);
  ioPairs(a, c.world.sleeping_pairs, c.world.contacts);
  io(a, c.world.events.touching), io(a, c.world.events.next_fell_asleep), io(a, c.world.events.next_woke);
  ioList(a, c.leaves, [](A& archive, Leaf& leaf) { io(archive, leaf.body), io(archive, leaf.bounds); });
  ioList(a, c.rows, [](A& archive, RowMemory& row) {
    ioEnum(archive, row.state, RowState::Drive);
    io(archive, row.held), io(archive, row.side);
    if constexpr (A::kReads) archive.require(row.side <= 2, "a row of a joint is clamped to no side");
  });
}

template <class A>
struct Section {
  const char* name;
  char tag[5];
  void (*run)(A&, Content&);
};
template <class A>
constexpr Section<A> kSections[] = {{"world", "WRLD", ioWorld<A>},
                                    {"meshes", "MESH", ioMeshes<A>},
                                    {"bodies", "BODY", ioBodies<A>},
                                    {"joints", "JOIN", ioJoints<A>},
                                    {"contacts", "CONT", ioContacts<A>},
                                    {"particles", "PART", ioParticles<A>}};
constexpr uint32_t kNumSections = 6;

uint32_t tagOf(const char* tag) {
  uint32_t out = 0;
  for (int i = 0; i < 4; ++i) out |= uint32_t(static_cast<uint8_t>(tag[i])) << (8 * i);
  return out;
}

// The archives change nothing when they count or write.
Content contentOf(const World::Impl& world) {
  Content c{const_cast<World::Impl&>(world), {}, {}};
  for (uint32_t i = 0; i < world.store.states.size(); ++i)
    if (world.tree.contains(i)) c.leaves.push_back({i, world.tree.bounds(i)});
  forEachRow(c.world, [&](const DirectRow& r) {
    c.rows.push_back({r.state, r.held, static_cast<uint8_t>(r.clamped + 1)});
  });
  return c;
}

template <size_t... I>
std::array<size_t, sizeof...(I)> sectionSizes(Content& c, std::index_sequence<I...>) {
  const auto size = [&](auto run) {
    Counter counter;
    run(counter, c);
    return counter.size();
  };
  return {size(kSections<Counter>[I].run)...};
}
std::array<size_t, kNumSections> sectionSizes(Content& c) {
  return sectionSizes(c, std::make_index_sequence<kNumSections>());
}

[[noreturn]] void failWhole(const std::string& cause) { throw SnapshotError("snapshot: " + cause); }

struct SectionData {
  std::span<const std::byte> bytes;
  size_t begin;  // in the snapshot
};

// Checks header, lengths and hashes, so that nothing that was damaged by chance gets any further.
std::array<SectionData, kNumSections> checkedSections(std::span<const std::byte> in) {
  if (in.size() < kHeaderBytes) failWhole("too short for a header (" + std::to_string(in.size()) + " bytes)");
  Reader header(in.first(kHeaderBytes), 0, "header");
  std::array<uint8_t, 8> magic{};
  uint32_t version = 0, sections = 0;
  io(header, magic), io(header, version), io(header, sections);
  if (magic != kMagic) failWhole("these bytes are none (the header is wrong)");
  if (version != kVersion)
    failWhole("version " + std::to_string(version) + ", this program reads " + std::to_string(kVersion));
  if (sections != kNumSections) failWhole("header: the number of sections is wrong");
  std::array<SectionData, kNumSections> out;
  size_t at = kHeaderBytes;
  for (uint32_t i = 0; i < kNumSections; ++i) {
    const Section<Reader>& s = kSections<Reader>[i];
    Reader head(in.subspan(at, std::min(kSectionBytes, in.size() - at)), at, s.name);
    uint32_t tag = 0;
    uint64_t length = 0, hash = 0;
    io(head, tag), io(head, length), io(head, hash);
    head.require(tag == tagOf(s.tag), "its tag is wrong");
    at += kSectionBytes;
    head.require(length <= in.size() - at, "ends too early");
    out[i] = {in.subspan(at, static_cast<size_t>(length)), at};
    if (hashBytes(out[i].bytes) != hash) Reader(out[i].bytes, at, s.name).fail("is damaged");
    at += static_cast<size_t>(length);
  }
  if (at != in.size()) failWhole("something follows the last section (byte " + std::to_string(at) + ")");
  return out;
}

bool areBelow(std::span<const uint32_t> indices, size_t count) {
  return std::ranges::all_of(indices, [&](uint32_t i) { return i < count; });
}

// Sleeping bodies form rings: each is the next one of exactly one other.
bool areRings(const World::Impl& w) {
  Vector<uint8_t> reached(w.store.states.size());
  for (uint32_t i = 0; i < w.store.states.size(); ++i) {
    if (!w.store.states[i].asleep) continue;
    if (i >= w.next_sleeper.size()) return false;
    const uint32_t next = w.next_sleeper[i];
    if (next >= w.store.states.size() || !w.store.states[next].asleep || reached[next]++) return false;
  }
  return true;
}

void checkBodies(const Reader& r, const World::Impl& w) {
  const BodyStore& s = w.store;
  const size_t n = s.states.size();
  for (size_t size : {s.bodies.size(), s.inertias.size(), s.size.size(), s.radius.size(), s.names.size(),
                      s.generations.size(), s.collidables.size(), s.shapes.size()})
    r.require(size == n, "the arrays differ in length");
  r.require(areBelow(s.free_slots, n) && areBelow(w.changed_bodies, n), "a body is not there");
  r.require(w.reach.size() <= n && w.next_sleeper.size() <= n && w.since_touch.size() <= n, "the arrays differ in length");
  for (const BodyPose& k : w.keyframes) r.require(k.body < n, "a key frame moves a body that is not there");
  for (uint32_t i = 0; i < n; ++i) {
    r.require(s.states[i].body_id == i, "a body has the wrong number");
    r.require(!s.exists(i) || !s.shapes[i].empty(), "a body has no shape");
  }
  r.require(areRings(w), "the rings of sleeping bodies are broken");
}

void checkJoints(const Reader& r, const World::Impl& w) {
  const JointStore& s = w.joint_store;
  const size_t n = s.joints.size();
  for (size_t size : {s.links.size(), s.names.size(), s.break_force.size(), s.break_torque.size(), s.generations.size()})
    r.require(size == n, "the arrays differ in length");
  r.require(areBelow(s.free_slots, n), "a joint is not there");
  r.require(std::ranges::is_sorted(w.apart.keys()), "the pairs that are kept apart are not sorted");
  for (const JointLink& l : s.links)
    r.require(!l.exists || (std::max(l.body_a, l.body_b) < w.store.states.size() && l.body_a != l.body_b),
              "a joint links a body that is not there");
}

void checkContacts(const Reader& r, const World::Impl& w, std::span<const Leaf> leaves) {
  const size_t n = w.store.states.size();
  for (const auto* list : {&w.pairs, &w.sleeping_pairs}) {
    for (const Pair& p : *list) r.require(p.body_a < p.body_b && p.body_b < n, "a pair has a body that is not there");
    const auto not_ascending = [](const Pair& a, const Pair& b) { return a.key() >= b.key(); };
    r.require(std::adjacent_find(list->begin(), list->end(), not_ascending) == list->end(), "the pairs are not sorted");
  }
  for (const TouchingPair& t : w.events.touching)
    r.require(t.body_a.index < t.body_b.index && t.body_b.index < n, "a body that is not there touches");
  r.require(std::ranges::is_sorted(w.events.touching, {}, &TouchingPair::key), "what touches is not sorted");
  for (const Leaf& leaf : leaves) r.require(leaf.body < n, "the broad phase has a body that is not there");
}

// What of a snapshot belongs into stages that a restored world makes anew.
struct Memory {
  Vector<Leaf> leaves;
  Vector<RowMemory> rows;
};

// A world without threads, for reading into.
std::unique_ptr<World::Impl> readAll(std::span<const std::byte> in, Memory& memory) {
  const auto data = checkedSections(in);
  auto world = std::make_unique<World::Impl>(WorldDef{});
  Content content{*world, {}, {}};
  for (uint32_t i = 0; i < kNumSections; ++i) {
    Reader r(data[i].bytes, data[i].begin, kSections<Reader>[i].name);
    kSections<Reader>[i].run(r, content);
    r.require(r.atEnd(), "is longer than its content");
    if (i == 2) checkBodies(r, *world);
    if (i == 3) checkJoints(r, *world);
    if (i == 4) checkContacts(r, *world, content.leaves);
  }
  memory = {std::move(content.leaves), std::move(content.rows)};
  return world;
}

// Meshes keep their addresses, since others may hold them. Shapes of `from` are led to those of `to`.
template <class Mesh>
void moveMeshes(Deque<Mesh>& from, Deque<Mesh>& to, Deque<Vector<Shape>>& shapes) {
  Vector<std::pair<const Mesh*, const Mesh*>> moved;
  for (size_t i = 0; i < from.size(); ++i) {
    if (i == to.size()) to.emplace_back();
    to[i] = std::move(from[i]);
    moved.push_back({&from[i], &to[i]});
  }
  std::sort(moved.begin(), moved.end());
  for (auto& list : shapes)
    for (Shape& s : list)
      if (auto* mesh = std::get_if<const Mesh*>(&s.geometry))
        *mesh = std::lower_bound(moved.begin(), moved.end(), std::pair<const Mesh*, const Mesh*>{*mesh, nullptr})->second;
}

void restTree(World::Impl& w, std::span<const Leaf> leaves) {
  Vector<BroadphaseProxy> proxies;
  for (const Leaf& leaf : leaves) {
    const RigidState& s = w.store.states[leaf.body];
    proxies.push_back({.bounds = leaf.bounds,
                       .body = leaf.body,
                       .filter_self = s.filter_self,
                       .filter_target = s.filter_target,
                       .motion_type = s.motion_type});
  }
  w.tree = TreeBroadphase{};
  w.tree.rest(proxies);
}

// Makes the components of joints as the next step would, and gives their rows what they knew.
void rememberRows(World::Impl& w, std::span<const RowMemory> rows) {
  if (rows.empty()) return;
  w.solver_index.assign(w.store.states.size(), kNoSolverBody);
  stage::gatherJoints(w);
  w.free_components.clear();
  w.joint_step.clear();
  size_t count = 0;
  forEachRow(w, [&](const DirectRow&) { ++count; });
  if (count != rows.size()) return;  // joints were changed since the step that the rows are of
  size_t i = 0;
  forEachRow(w, [&](DirectRow& r) {
    r.state = rows[i].state;
    r.held = rows[i].held;
    r.clamped = static_cast<int8_t>(rows[i].side - 1);
    ++i;
  });
}

void takeOver(World::Impl& w, World::Impl& from, const Memory& memory) {
  from.def.workers = w.def.workers;
  from.def.simd = w.def.simd;
  w.def = from.def;
  w.dt = from.dt;
  w.substep = from.substep;
  w.step_count = from.step_count;
  moveMeshes(from.convex_meshes, w.convex_meshes, from.store.shapes);
  moveMeshes(from.large_meshes, w.large_meshes, from.store.shapes);
  w.store = std::move(from.store);
  for (uint32_t i = 0; i < w.store.states.size(); ++i) {
    const Vector<Shape>& shapes = w.store.shapes[i];
    if (shapes.empty() || !w.store.exists(i)) continue;
    w.store.attachShapes(i, w.store.collidables[i]);
  }
  w.keyframes = std::move(from.keyframes);
  w.changed_bodies = std::move(from.changed_bodies);
  w.reach = std::move(from.reach);
  w.next_sleeper = std::move(from.next_sleeper);
  w.has_woken = from.has_woken;
  w.joint_store = std::move(from.joint_store);
  if (!from.mesh_motions.empty() || !w.mesh_motions.empty()) ++w.num_deformations;
  w.mesh_motions = std::move(from.mesh_motions);
  w.particle_store = std::move(from.particle_store);
  w.broken_joints = std::move(from.broken_joints);
  w.apart = std::move(from.apart);
  w.events = std::move(from.events);
  w.pairs = std::move(from.pairs);
  w.sleeping_pairs = std::move(from.sleeping_pairs);
  w.contacts = std::move(from.contacts);
  restTree(w, memory.leaves);

  // Lists that point into what was replaced are made again in the next step.
  w.active_changed = true;
  w.constraints.clear();
  w.joint_constraints.clear();
  w.free_components.clear();
  w.joint_step.clear();
  w.joint_components = JointComponents{};
  w.islands = Islands{};
  w.island_links.clear();
  w.island_link_pairs.clear();
  w.island_pairs.clear();
  w.tree_is_current = false;
  w.forgetCounts();
  w.modified.clear();
  w.times.clear();
  rememberRows(w, memory.rows);
  w.since_touch = std::move(from.since_touch);
}

template <size_t... I>
void writeSections(Content& c, std::span<std::byte> out, std::index_sequence<I...>) {
  const auto sizes = sectionSizes(c);
  size_t at = kHeaderBytes;
  const auto write = [&](const Section<Writer>& s, size_t length) {
    const std::span<std::byte> content = out.subspan(at + kSectionBytes, length);
    Writer body(content);
    s.run(body, c);
    Writer head(out.subspan(at, kSectionBytes));
    uint32_t tag = tagOf(s.tag);
    uint64_t bytes = length, hash = hashBytes(content);
    io(head, tag), io(head, bytes), io(head, hash);
    at += kSectionBytes + length;
  };
  (write(kSections<Writer>[I], sizes[I]), ...);
}

void requireKept(const World::Impl& w) {
  const auto is_kept = [](const auto* mesh, const auto& kept) {
    return std::ranges::any_of(kept, [&](const auto& m) { return &m == mesh; });
  };
  for (uint32_t i = 0; i < w.store.states.size(); ++i) {
    if (!w.store.exists(i)) continue;
    for (const Shape& s : w.store.shapes[i]) {
      const auto* convex = std::get_if<const ConvexMesh*>(&s.geometry);
      const auto* large = std::get_if<const LargeMesh*>(&s.geometry);
      if ((convex && !is_kept(*convex, w.convex_meshes)) || (large && !is_kept(*large, w.large_meshes)))
        failWhole("body \"" + std::string(w.store.names[i]) + "\" has a mesh that the world does not keep");
    }
  }
}

}  // namespace

void snapshot_format::Reader::fail(const std::string& what) const {
  throw SnapshotError("snapshot: " + section_ + " (bytes " + std::to_string(begin_) + " to " +
                      std::to_string(begin_ + in_.size()) + "): " + what);
}

size_t World::snapshotBytes() const {
  Content c = contentOf(*impl_);
  size_t total = kHeaderBytes;
  for (size_t size : sectionSizes(c)) total += kSectionBytes + size;
  return total;
}

size_t World::snapshot(std::span<std::byte> out) const {
  requireKept(*impl_);
  const size_t needed = snapshotBytes();
  if (out.size() < needed)
    failWhole("the buffer has " + std::to_string(out.size()) + " bytes, " + std::to_string(needed) + " are needed");
  Writer header(out.first(kHeaderBytes));
  auto magic = kMagic;
  uint32_t version = kVersion, sections = kNumSections;
  io(header, magic), io(header, version), io(header, sections);
  Content c = contentOf(*impl_);
  writeSections(c, out, std::make_index_sequence<kNumSections>());
  return needed;
}

void World::restore(std::span<const std::byte> in) {
  const MemoryScope scope(impl_->memory);
  Memory memory;
  const std::unique_ptr<Impl> read = readAll(in, memory);
  takeOver(*impl_, *read, memory);
}

}  // namespace pfx
