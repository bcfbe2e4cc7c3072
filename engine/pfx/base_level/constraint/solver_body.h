// What the solver keeps of one awake body: 96 dense bytes, three blocks of 32 that lanes load as rows.
//
// Velocities are those of the current sub-step; dp and dq are the motion since the start of the step. The
// inverse inertia follows the orientation from sub-step to sub-step. Fixed and key-frame bodies have inverse
// mass and inertia zero.
#pragma once

namespace pfx {

struct alignas(32) SolverBody {
  float v[3] = {0, 0, 0};  // m/s
  float inv_mass = 0;      // 1/kg
  float w[3] = {0, 0, 0};  // rad/s, world axes
  float pad0 = 0;

  float dp[3] = {0, 0, 0};  // m
  float pad1 = 0;
  float dq[4] = {0, 0, 0, 1};  // x, y, z, w

  float inv_inertia[6] = {0, 0, 0, 0, 0, 0};  // 1/(kg m^2), world axes: xx, xy, xz, yy, yz, zz
  float pad2[2] = {0, 0};
};
static_assert(sizeof(SolverBody) == 96);

}  // namespace pfx
