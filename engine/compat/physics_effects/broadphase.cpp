#include "compat/physics_effects/broadphase.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "compat/physics_effects/native.h"

namespace sce::PhysicsEffects {
namespace {

constexpr uint32_t kGrain = 64;       // bodies that one task takes
constexpr uint32_t kPairGrain = 512;  // pairs

bool finite(const PfxVector3& v) { return native(v).allFinite(); }

// Outwards, so that the grid box holds the bounds.
PfxUInt32 toGrid(double cell) {
  return static_cast<PfxUInt32>(std::clamp(cell, 0.0, double(SCE_PFX_PROXY_GRID_MAX_)));
}

void writeProxy(PfxBroadphaseProxy& proxy, const PfxRigidState& state, const pfx::Aabb& box, const PfxVector3& center,
                const PfxVector3& extent) {
  PfxUInt64 low = 0, high = 0;
  for (int k = 0; k < 3; ++k) {
    const double origin = double(center[k]) - extent[k], scale = SCE_PFX_PROXY_GRID_MAX_ / (2.0 * extent[k]);
    low |= PfxUInt64(toGrid(std::floor((box.min[k] - origin) * scale))) << 21 * k;
    high |= PfxUInt64(toGrid(std::ceil((box.max[k] - origin) * scale))) << 21 * k;
  }
  proxy.set32(0, static_cast<PfxUInt32>(low)), proxy.set32(1, static_cast<PfxUInt32>(low >> 32));
  proxy.set32(2, static_cast<PfxUInt32>(high)), proxy.set32(3, static_cast<PfxUInt32>(high >> 32));
  proxy.set32(4, 0);
  proxy.set16(8, state.getRigidBodyId());
  proxy.set8(18, state.getMotionMask());
  proxy.set32(5, state.getContactFilterSelf());
  proxy.set32(6, state.getContactFilterTarget());
}

// Sorted from the lower end by lower ends, from the upper end by upper ends.
void writeKey(PfxBroadphaseProxy& proxy, PfxUInt32 axis) {
  pfxSetKey(proxy, axis < 3 ? pfxGetXYZMin(proxy, axis) : SCE_PFX_PROXY_GRID_MAX_ - pfxGetXYZMax(proxy, axis - 3));
}

bool isWorld(const PfxVector3& center, const PfxVector3& extent) {
  return finite(center) && finite(extent) && minElem(extent) > 0.0f;
}

// The bounds; those that are not finite shrink to the corner of the world, where they are reported as outside.
struct Bounds {
  pfx::Aabb box;
  bool outside;
};
Bounds boundsIn(const PfxRigidState& state, const PfxCollidable& collidable, const PfxVector3& center,
                const PfxVector3& extent) {
  const pfx::Aabb box = bodyAabb(state, collidable);
  const pfx::Vec3 lower = native(center - extent), upper = native(center + extent);
  if (!box.min.allFinite() || !box.max.allFinite()) return {{lower, lower}, true};
  return {box, !box.overlaps({lower, upper})};
}

void leaveWorld(PfxRigidState& state, PfxUInt32 behavior) {
  if (!(behavior & SCE_PFX_OUT_OF_WORLD_BEHAVIOR_FIX_MOTION)) return;
  state.setMotionType(kPfxMotionTypeFixed);
  state.setLinearVelocity(PfxVector3(0.0f));
  state.setAngularVelocity(PfxVector3(0.0f));
}

bool overlap(const PfxBroadphaseProxy& a, const PfxBroadphaseProxy& b) {
  for (int k = 0; k < 3; ++k)
    if (pfxGetXYZMin(a, k) > pfxGetXYZMax(b, k) || pfxGetXYZMin(b, k) > pfxGetXYZMax(a, k)) return false;
  return true;
}

bool mayPair(const PfxBroadphaseProxy& a, const PfxBroadphaseProxy& b) {
  return pfx::detectsCollision(motionTypeOf(pfxGetMotionMask(a)), motionTypeOf(pfxGetMotionMask(b))) &&
         pfx::filtersMatch(pfxGetSelf(a), pfxGetTarget(a), pfxGetSelf(b), pfxGetTarget(b));
}

PfxBroadphasePair makePair(const PfxBroadphaseProxy& a, const PfxBroadphaseProxy& b) {
  const bool swap = pfxGetRigidBodyId(a) > pfxGetRigidBodyId(b);
  const PfxBroadphaseProxy &first = swap ? b : a, &second = swap ? a : b;
  PfxBroadphasePair pair = {};
  pfxSetRigidBodyIdA(pair, pfxGetRigidBodyId(first));
  pfxSetRigidBodyIdB(pair, pfxGetRigidBodyId(second));
  pfxSetMotionMaskA(pair, pfxGetMotionMask(first));
  pfxSetMotionMaskB(pair, pfxGetMotionMask(second));
  pfxSetActive(pair, true);
  pfxSetKey(pair, pfxCalcUniqueKey(pfxGetRigidBodyId(first), pfxGetRigidBodyId(second)));
  return pair;
}

bool isSorted(const PfxBroadphasePair* pairs, PfxUInt32 count, pfx::TaskManager* tasks) {
  std::atomic<bool> sorted = true;
  pfx::parallelFor(tasks, count, kPairGrain, [&](pfx::TaskRange range) {
    for (PfxUInt32 i = std::max(range.begin, 1u); i < range.end; ++i)
      if (pairs[i].key() < pairs[i - 1].key()) sorted.store(false, std::memory_order_relaxed);
  });
  return sorted;
}

PfxUInt32 blocks(PfxUInt32 count, PfxUInt32 grain) { return (count + grain - 1) / grain; }

}  // namespace

PfxInt32 pfxApplyExternalForce(PfxRigidState& state, const PfxRigidBody& body, const PfxVector3& force,
                               const PfxVector3& torque, PfxFloat timeStep) {
  if (!(timeStep > 0.0f) || !finite(force) || !finite(torque)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!pfx::isDynamic(native(state).motion_type) || state.isAsleep()) return SCE_PFX_OK;
  const PfxQuat q = state.getOrientation();
  const PfxVector3 turn = rotate(q, body.getInertiaInv() * rotate(conj(q), torque));
  PfxVector3 v = state.getLinearVelocity() + force * (body.getMassInv() * timeStep);
  PfxVector3 w = state.getAngularVelocity() + turn * timeStep;
  const PfxFloat speed = length(v), spin = length(w);
  if (speed > state.getMaxLinearVelocity()) v *= state.getMaxLinearVelocity() / speed;
  if (spin > state.getMaxAngularVelocity()) w *= state.getMaxAngularVelocity() / spin;
  state.setLinearVelocity(v);
  state.setAngularVelocity(w);
  return SCE_PFX_OK;
}

PfxInt32 pfxUpdateBroadphaseProxy(PfxBroadphaseProxy& proxy, const PfxRigidState& state, const PfxCollidable& collidable,
                                  const PfxVector3& center, const PfxVector3& extent, PfxUInt32 axis) {
  if (axis > 5 || !isWorld(center, extent)) return SCE_PFX_ERR_INVALID_VALUE;
  const Bounds bounds = boundsIn(state, collidable, center, extent);
  writeProxy(proxy, state, bounds.box, center, extent);
  writeKey(proxy, axis);
  return bounds.outside ? SCE_PFX_ERR_OUT_OF_WORLD : SCE_PFX_OK;
}

PfxInt32 pfxUpdateBroadphaseProxy(PfxBroadphaseProxy& x, PfxBroadphaseProxy& y, PfxBroadphaseProxy& z, const PfxRigidState& state,
                                  const PfxCollidable& collidable, const PfxVector3& center, const PfxVector3& extent) {
  const PfxInt32 code = pfxUpdateBroadphaseProxy(x, state, collidable, center, extent, 0);
  if (code == SCE_PFX_ERR_INVALID_VALUE) return code;
  y = z = x;
  writeKey(y, 1), writeKey(z, 2);
  return code;
}

PfxInt32 pfxUpdateBroadphaseProxy(PfxBroadphaseProxy& x, PfxBroadphaseProxy& y, PfxBroadphaseProxy& z, PfxBroadphaseProxy& xb,
                                  PfxBroadphaseProxy& yb, PfxBroadphaseProxy& zb, const PfxRigidState& state,
                                  const PfxCollidable& collidable, const PfxVector3& center, const PfxVector3& extent) {
  const PfxInt32 code = pfxUpdateBroadphaseProxy(x, y, z, state, collidable, center, extent);
  if (code == SCE_PFX_ERR_INVALID_VALUE) return code;
  xb = yb = zb = x;
  writeKey(xb, 3), writeKey(yb, 4), writeKey(zb, 5);
  return code;
}

namespace {

// A block of bodies, kept in the place of its first one in the work buffer.
struct ProxyBlock {
  PfxUInt32 count;    // of proxies
  PfxUInt32 outside;  // bodies
  PfxUInt32 first;    // place of its first proxy in the arrays
};
static_assert(sizeof(ProxyBlock) <= sizeof(PfxBroadphaseProxy));

bool removes(const PfxUpdateBroadphaseProxiesParam& p) {
  return (p.outOfWorldBehavior & SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY) != 0;
}

Bounds boundsOf(const PfxUpdateBroadphaseProxiesParam& p, PfxUInt32 i) {
  return boundsIn(p.offsetRigidStates[i], p.offsetCollidables[i], p.worldCenter, p.worldExtent);
}

ProxyBlock countProxies(const PfxUpdateBroadphaseProxiesParam& p, pfx::TaskRange range) {
  ProxyBlock block = {range.end - range.begin, 0, 0};
  for (PfxUInt32 i = range.begin; i < range.end; ++i) {
    if (!boundsOf(p, i).outside) continue;
    leaveWorld(p.offsetRigidStates[i], p.outOfWorldBehavior);
    ++block.outside;
  }
  if (removes(p)) block.count -= block.outside;
  return block;
}

void writeProxies(const PfxUpdateBroadphaseProxiesParam& p, pfx::TaskRange range, PfxUInt32 at) {
  PfxBroadphaseProxy* const arrays[] = {p.proxiesX, p.proxiesY, p.proxiesZ, p.proxiesXb, p.proxiesYb, p.proxiesZb};
  for (PfxUInt32 i = range.begin; i < range.end; ++i) {
    const Bounds bounds = boundsOf(p, i);
    if (bounds.outside && removes(p)) continue;
    PfxBroadphaseProxy proxy;
    writeProxy(proxy, p.offsetRigidStates[i], bounds.box, p.worldCenter, p.worldExtent);
    for (PfxUInt32 axis = 0; axis < 6; ++axis) {
      if (arrays[axis] == nullptr) continue;
      writeKey(proxy, axis);
      arrays[axis][at] = proxy;
    }
    ++at;
  }
}

}  // namespace

PfxUInt32 pfxGetWorkBytesOfUpdateBroadphaseProxies(PfxUInt32 numRigidBodies, PfxUInt32) {
  return sizeof(PfxBroadphaseProxy) * std::max(numRigidBodies, 1u);
}

PfxInt32 pfxUpdateBroadphaseProxies(PfxUpdateBroadphaseProxiesParam& param, PfxUpdateBroadphaseProxiesResult& result,
                                    PfxTaskManager* taskManager) {
  result = {};
  PfxBroadphaseProxy* const arrays[] = {param.proxiesX,  param.proxiesY,  param.proxiesZ,
                                        param.proxiesXb, param.proxiesYb, param.proxiesZb};
  const PfxUInt32 n = param.numRigidBodies;
  if (param.workBuff == nullptr || !isWorld(param.worldCenter, param.worldExtent)) return SCE_PFX_ERR_INVALID_VALUE;
  if (n > 0 && (param.offsetRigidStates == nullptr || param.offsetCollidables == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(param.workBuff)) return SCE_PFX_ERR_INVALID_ALIGN;
  for (const PfxBroadphaseProxy* a : arrays)
    if (!aligned16(a)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (param.workBytes < pfxGetWorkBytesOfUpdateBroadphaseProxies(n)) return SCE_PFX_ERR_OUT_OF_BUFFER;

  auto* work = static_cast<PfxBroadphaseProxy*>(param.workBuff);
  const auto blockAt = [&](PfxUInt32 body) -> ProxyBlock& { return reinterpret_cast<ProxyBlock&>(work[body]); };
  pfx::TaskManager* tasks = poolOf(taskManager);
  pfx::parallelFor(tasks, n, kGrain, [&](pfx::TaskRange range) { blockAt(range.begin) = countProxies(param, range); });
  PfxUInt32 count = 0, outside = 0;
  for (PfxUInt32 i = 0; i < n; i += kGrain) {
    ProxyBlock& block = blockAt(i);
    block.first = count;
    count += block.count, outside += block.outside;
  }
  pfx::parallelFor(tasks, n, kGrain, [&](pfx::TaskRange range) { writeProxies(param, range, blockAt(range.begin).first); });
  for (PfxBroadphaseProxy* a : arrays)
    if (a != nullptr) pfxParallelSort(a, count, param.workBuff, param.workBytes, taskManager);
  result.numOutOfWorldProxies = static_cast<PfxInt32>(outside);
  result.numProxies = static_cast<PfxInt32>(count);
  return SCE_PFX_OK;
}

PfxUInt32 pfxGetWorkBytesOfFindPairs(PfxUInt32 maxPairs, PfxUInt32) {
  return sizeof(PfxBroadphasePair) * std::max(maxPairs, 1u);
}
PfxUInt32 pfxGetPairBytesOfFindPairs(PfxUInt32 maxPairs) { return sizeof(PfxBroadphasePair) * std::max(maxPairs, 1u); }

PfxInt32 pfxFindPairs(PfxFindPairsParam& param, PfxFindPairsResult& result, PfxTaskManager* taskManager) {
  result = {};
  if (param.workBuff == nullptr || param.pairBuff == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if (param.numProxies > 0 && param.proxies == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if (param.axis < 0 || param.axis > 2) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(param.workBuff) || !aligned16(param.pairBuff) || !aligned16(param.proxies)) return SCE_PFX_ERR_INVALID_ALIGN;
  if (param.workBytes < pfxGetWorkBytesOfFindPairs(param.maxPairs)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  if (param.pairBytes < pfxGetPairBytesOfFindPairs(param.maxPairs)) return SCE_PFX_ERR_OUT_OF_BUFFER;

  auto* pairs = static_cast<PfxBroadphasePair*>(param.pairBuff);
  const bool ordered = std::is_sorted(param.proxies, param.proxies + param.numProxies, [&](const auto& a, const auto& b) {
    return pfxGetXYZMin(a, param.axis) < pfxGetXYZMin(b, param.axis);
  });
  // Workers append in any order; the order of the result is that of the keys, which are all different.
  std::atomic<PfxUInt32> count = 0;
  pfx::parallelFor(poolOf(taskManager), param.numProxies, kGrain, [&](pfx::TaskRange range) {
    for (PfxUInt32 i = range.begin; i < range.end; ++i) {
      const PfxBroadphaseProxy& a = param.proxies[i];
      const PfxUInt32 end = pfxGetXYZMax(a, param.axis);
      for (PfxUInt32 j = i + 1; j < param.numProxies; ++j) {
        const PfxBroadphaseProxy& b = param.proxies[j];
        if (ordered && pfxGetXYZMin(b, param.axis) > end) break;
        if (!overlap(a, b) || !mayPair(a, b)) continue;
        const PfxUInt32 at = count.fetch_add(1, std::memory_order_relaxed);
        if (at >= param.maxPairs) return;
        pairs[at] = makePair(a, b);
      }
    }
  });
  if (count > param.maxPairs) return SCE_PFX_ERR_OUT_OF_MAX_PAIRS;
  result.pairs = pairs;
  result.numPairs = count;
  return pfxParallelSort(pairs, count, param.workBuff, param.workBytes, taskManager);
}

namespace {

// A run of keys in both lists of pairs, and how many pairs of it are kept, new and gone: numbers, then places.
struct PairBlock {
  PfxUInt32 prev_begin, prev_end, cur_begin, cur_end;
  PfxUInt32 kept, fresh, gone;
};

// Walks both lists in the order of the keys.
template <class Kept, class Fresh, class Gone>
void compare(const PfxDecomposePairsParam& lists, const PairBlock& b, Kept&& kept, Fresh&& fresh, Gone&& gone) {
  PfxUInt32 p = b.prev_begin, c = b.cur_begin;
  while (p < b.prev_end && c < b.cur_end) {
    const PfxBroadphasePair &prev = lists.previousPairs[p], &cur = lists.currentPairs[c];
    if (prev.key() == cur.key()) kept(prev, cur), ++p, ++c;
    else if (prev.key() < cur.key()) gone(prev), ++p;
    else fresh(cur), ++c;
  }
  for (; p < b.prev_end; ++p) gone(lists.previousPairs[p]);
  for (; c < b.cur_end; ++c) fresh(lists.currentPairs[c]);
}

// Where block `index` begins in both lists: at every kPairGrain-th pair of the longer one.
void beginOf(const PfxDecomposePairsParam& lists, PfxUInt32 index, PfxUInt32& prev, PfxUInt32& cur) {
  const bool by_current = lists.numCurrentPairs >= lists.numPreviousPairs;
  const PfxBroadphasePair *longer = by_current ? lists.currentPairs : lists.previousPairs,
                          *other = by_current ? lists.previousPairs : lists.currentPairs;
  const PfxUInt32 length = std::max(lists.numCurrentPairs, lists.numPreviousPairs), other_length = std::min(lists.numCurrentPairs, lists.numPreviousPairs);
  const PfxUInt32 at = std::min(index * kPairGrain, length);
  PfxUInt32 other_at = at == 0 ? 0 : other_length;
  if (at > 0 && at < length)
    other_at = static_cast<PfxUInt32>(std::lower_bound(other, other + other_length, longer[at].key(), [](const auto& a, PfxUInt32 key) { return a.key() < key; }) - other);
  prev = by_current ? other_at : at, cur = by_current ? at : other_at;
}

PairBlock countBlock(const PfxDecomposePairsParam& lists, PfxUInt32 index) {
  PairBlock b = {};
  beginOf(lists, index, b.prev_begin, b.cur_begin);
  beginOf(lists, index + 1, b.prev_end, b.cur_end);
  compare(lists, b, [&](const auto&, const auto&) { ++b.kept; }, [&](const auto&) { ++b.fresh; }, [&](const auto&) { ++b.gone; });
  return b;
}

void writeBlock(const PfxDecomposePairsParam& lists, const PairBlock& b, const PfxDecomposePairsResult& out) {
  PfxBroadphasePair *kept = out.outKeepPairs + b.kept, *fresh = out.outNewPairs + b.fresh, *gone = out.outRemovePairs + b.gone;
  const auto keep = [&](const PfxBroadphasePair& prev, const PfxBroadphasePair& cur) {
    *kept = cur;
    pfxSetContactId(*kept++, pfxGetContactId(prev));
  };
  compare(lists, b, keep, [&](const auto& cur) { *fresh++ = cur; }, [&](const auto& prev) { *gone++ = prev; });
}

}  // namespace

PfxUInt32 pfxGetWorkBytesOfDecomposePairs(PfxUInt32 numPreviousPairs, PfxUInt32 numCurrentPairs, PfxUInt32) {
  return static_cast<PfxUInt32>(SCE_PFX_BYTES_ALIGN16(sizeof(PairBlock) * std::max(1u, blocks(std::max(numPreviousPairs, numCurrentPairs), kPairGrain))));
}
PfxUInt32 pfxGetPairBytesOfDecomposePairs(PfxUInt32 numPreviousPairs, PfxUInt32 numCurrentPairs) {
  return sizeof(PfxBroadphasePair) * std::max(numPreviousPairs + numCurrentPairs, 1u);
}

PfxInt32 pfxDecomposePairs(PfxDecomposePairsParam& param, PfxDecomposePairsResult& result, PfxTaskManager* taskManager) {
  result = {};
  const PfxUInt32 num_prev = param.numPreviousPairs, num_cur = param.numCurrentPairs;
  const PfxBroadphasePair *prev = param.previousPairs, *cur = param.currentPairs;
  if (param.workBuff == nullptr || param.pairBuff == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if ((num_prev > 0 && prev == nullptr) || (num_cur > 0 && cur == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(param.workBuff) || !aligned16(param.pairBuff) || !aligned16(prev) || !aligned16(cur))
    return SCE_PFX_ERR_INVALID_ALIGN;
  if (param.workBytes < pfxGetWorkBytesOfDecomposePairs(num_prev, num_cur)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  if (param.pairBytes < pfxGetPairBytesOfDecomposePairs(num_prev, num_cur)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  pfx::TaskManager* tasks = poolOf(taskManager);
  if (!isSorted(prev, num_prev, tasks) || !isSorted(cur, num_cur, tasks)) return SCE_PFX_ERR_INVALID_VALUE;

  auto* block = static_cast<PairBlock*>(param.workBuff);
  const PfxUInt32 num_blocks = blocks(std::max(num_prev, num_cur), kPairGrain);
  pfx::parallelFor(tasks, num_blocks, 1, [&](pfx::TaskRange range) {
    for (PfxUInt32 i = range.begin; i < range.end; ++i) block[i] = countBlock(param, i);
  });
  PfxDecomposePairsResult r;
  for (PfxUInt32 i = 0; i < num_blocks; ++i) {
    r.numOutKeepPairs += std::exchange(block[i].kept, r.numOutKeepPairs);
    r.numOutNewPairs += std::exchange(block[i].fresh, r.numOutNewPairs);
    r.numOutRemovePairs += std::exchange(block[i].gone, r.numOutRemovePairs);
  }
  r.outKeepPairs = static_cast<PfxBroadphasePair*>(param.pairBuff);
  r.outNewPairs = r.outKeepPairs + r.numOutKeepPairs;
  r.outRemovePairs = r.outNewPairs + r.numOutNewPairs;
  pfx::parallelFor(tasks, num_blocks, 1, [&](pfx::TaskRange range) {
    for (PfxUInt32 i = range.begin; i < range.end; ++i) writeBlock(param, block[i], r);
  });
  result = r;
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
