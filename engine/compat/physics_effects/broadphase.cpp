#include "compat/physics_effects/broadphase.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "compat/physics_effects/native.h"

namespace sce::PhysicsEffects {
namespace {

constexpr uint32_t kGrain = 64;  // bodies that one task takes

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
  const auto type = [](const PfxBroadphaseProxy& p) {
    return static_cast<pfx::MotionType>(pfxGetMotionMask(p) & SCE_PFX_MOTION_MASK_TYPE);
  };
  return pfx::detectsCollision(type(a), type(b)) &&
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

template <class Record>
bool isSorted(const Record* records, PfxUInt32 count) {
  return std::is_sorted(records, records + count, [](const Record& a, const Record& b) { return a.key() < b.key(); });
}

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

  // When bodies outside are left out, the place of a proxy depends on those before it.
  const bool remove = param.outOfWorldBehavior & SCE_PFX_OUT_OF_WORLD_BEHAVIOR_REMOVE_PROXY;
  PfxUInt32 removed = 0;
  std::atomic<PfxInt32> outside = 0;
  pfx::parallelFor(remove ? nullptr : poolOf(taskManager), n, kGrain, [&](pfx::TaskRange range) {
    for (PfxUInt32 i = range.begin; i < range.end; ++i) {
      const Bounds bounds = boundsIn(param.offsetRigidStates[i], param.offsetCollidables[i], param.worldCenter, param.worldExtent);
      if (bounds.outside) {
        outside.fetch_add(1, std::memory_order_relaxed);
        leaveWorld(param.offsetRigidStates[i], param.outOfWorldBehavior);
        if (remove) {
          ++removed;
          continue;
        }
      }
      PfxBroadphaseProxy proxy;
      writeProxy(proxy, param.offsetRigidStates[i], bounds.box, param.worldCenter, param.worldExtent);
      for (PfxUInt32 axis = 0; axis < 6; ++axis) {
        if (arrays[axis] == nullptr) continue;
        writeKey(proxy, axis);
        arrays[axis][i - removed] = proxy;
      }
    }
  });
  const PfxUInt32 count = n - removed;
  for (PfxBroadphaseProxy* a : arrays)
    if (a != nullptr) pfxParallelSort(a, count, param.workBuff, param.workBytes, taskManager);
  result.numOutOfWorldProxies = outside;
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

PfxUInt32 pfxGetWorkBytesOfDecomposePairs(PfxUInt32, PfxUInt32, PfxUInt32) { return 16; }
PfxUInt32 pfxGetPairBytesOfDecomposePairs(PfxUInt32 numPreviousPairs, PfxUInt32 numCurrentPairs) {
  return sizeof(PfxBroadphasePair) * std::max(numPreviousPairs + numCurrentPairs, 1u);
}

PfxInt32 pfxDecomposePairs(PfxDecomposePairsParam& param, PfxDecomposePairsResult& result, PfxTaskManager*) {
  result = {};
  const PfxUInt32 num_prev = param.numPreviousPairs, num_cur = param.numCurrentPairs;
  const PfxBroadphasePair *prev = param.previousPairs, *cur = param.currentPairs;
  if (param.workBuff == nullptr || param.pairBuff == nullptr) return SCE_PFX_ERR_INVALID_VALUE;
  if ((num_prev > 0 && prev == nullptr) || (num_cur > 0 && cur == nullptr)) return SCE_PFX_ERR_INVALID_VALUE;
  if (!aligned16(param.workBuff) || !aligned16(param.pairBuff) || !aligned16(prev) || !aligned16(cur))
    return SCE_PFX_ERR_INVALID_ALIGN;
  if (param.workBytes < pfxGetWorkBytesOfDecomposePairs(num_prev, num_cur)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  if (param.pairBytes < pfxGetPairBytesOfDecomposePairs(num_prev, num_cur)) return SCE_PFX_ERR_OUT_OF_BUFFER;
  if (!isSorted(prev, num_prev) || !isSorted(cur, num_cur)) return SCE_PFX_ERR_INVALID_VALUE;

  // The new and the kept ones share the places of the current pairs: kept from the front, new from the back.
  auto* out = static_cast<PfxBroadphasePair*>(param.pairBuff);
  PfxBroadphasePair *kept = out, *fresh = out + num_cur, *removed = out + num_cur;
  PfxUInt32 p = 0, c = 0, num_kept = 0, num_new = 0, num_removed = 0;
  while (p < num_prev || c < num_cur) {
    const bool take_prev = c == num_cur || (p < num_prev && prev[p].key() <= cur[c].key());
    const bool take_cur = p == num_prev || (c < num_cur && cur[c].key() <= prev[p].key());
    if (take_prev && take_cur) {
      kept[num_kept] = cur[c++];
      pfxSetContactId(kept[num_kept++], pfxGetContactId(prev[p++]));
    } else if (take_prev) {
      removed[num_removed++] = prev[p++];
    } else {
      *(fresh - ++num_new) = cur[c++];
    }
  }
  std::reverse(fresh - num_new, fresh);
  result.outKeepPairs = kept, result.numOutKeepPairs = num_kept;
  result.outNewPairs = fresh - num_new, result.numOutNewPairs = num_new;
  result.outRemovePairs = removed, result.numOutRemovePairs = num_removed;
  return SCE_PFX_OK;
}

}  // namespace sce::PhysicsEffects
