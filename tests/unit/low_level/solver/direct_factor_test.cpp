// The block-sparse factor against dense elimination, and its fill on trees.
#include "pfx/low_level/solver/direct_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace pfx {
namespace {

JointEnds link(uint32_t a, uint32_t b, bool moves_a = true) { return {{a, b}, {moves_a, true}}; }

// Random blocks J of N x 6 for each side, unit masses: A = sum over bodies of J J^T.
template <int N>
void expectSameAsDense(const std::vector<JointEnds>& joints, uint32_t num_bodies) {
  DirectStructure s;
  ASSERT_TRUE(buildDirectStructure(joints, num_bodies, 1u << 20, s));
  const size_t n = joints.size();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(n * N, num_bodies * 6);
  for (size_t i = 0; i < n; ++i)
    for (int side = 0; side < 2; ++side)
      for (int r = 0; r < N; ++r)
        for (int c = 0; c < 6; ++c)
          if (joints[i].moves[side]) j(i * N + r, joints[i].body[side] * 6 + c) = number(random);
  const Eigen::MatrixXd dense = j * j.transpose() + 0.1 * Eigen::MatrixXd::Identity(n * N, n * N);
  std::vector<double> diagonal(n * N * N), off(s.entries.size() * N * N), x(n * N), scratch(n * N * N);
  Eigen::VectorXd b(n * N);
  for (size_t p = 0; p < n; ++p) {
    for (int r = 0; r < N; ++r) {
      x[p * N + r] = b[s.order[p] * N + r] = number(random);
      for (int c = 0; c < N; ++c)
        diagonal[(p * N + r) * N + c] = dense(s.order[p] * N + r, s.order[p] * N + c);
    }
    for (uint32_t e = s.column_begin[p]; e < s.column_begin[p + 1]; ++e)
      for (int r = 0; r < N; ++r)
        for (int c = 0; c < N; ++c)
          off[(size_t(e) * N + r) * N + c] = dense(s.order[s.entries[e].row] * N + r, s.order[p] * N + c);
  }
  const DirectBlocks blocks{diagonal, off};
  factorDirect<N>(s, blocks, scratch);
  solveDirect<N>(s, blocks, x);
  const Eigen::VectorXd expected = dense.ldlt().solve(b);
  for (size_t p = 0; p < n; ++p)
    for (int r = 0; r < N; ++r)  // condition of the matrix is below 1e4
      EXPECT_NEAR(x[p * N + r], expected[s.order[p] * N + r], 1e-10);
}

std::vector<JointEnds> chain(uint32_t n) {
  std::vector<JointEnds> joints = {link(n, 0, false)};
  for (uint32_t i = 0; i + 1 < n; ++i) joints.push_back(link(i, i + 1));
  return joints;
}

TEST(DirectFactor, solvesChainsTreesAndLoopsLikeADenseSolver) {
  expectSameAsDense<3>(chain(12), 13);
  expectSameAsDense<5>({link(0, 1), link(0, 2), link(0, 3), link(3, 4), link(3, 5), link(5, 6)}, 7);
  auto ring = chain(8);
  ring.push_back(link(7, 0));
  ring.push_back(link(2, 6));
  expectSameAsDense<6>(ring, 9);
}

TEST(DirectStructure, addsNoBlockToATree) {
  DirectStructure s;
  ASSERT_TRUE(buildDirectStructure(chain(50), 51, 1000, s));
  EXPECT_EQ(s.entries.size(), 49u);
  // A hub with five arms of three links: each arm couples in a line, the five at the hub with each other.
  std::vector<JointEnds> hub;
  for (uint32_t arm = 0; arm < 5; ++arm)
    for (uint32_t i = 0; i < 3; ++i) hub.push_back(link(i == 0 ? 0 : 3 * arm + i, 3 * arm + i + 1));
  ASSERT_TRUE(buildDirectStructure(hub, 16, 1000, s));
  EXPECT_EQ(s.entries.size(), 5u * 2u + 10u);
}

TEST(DirectStructure, refusesWhatWouldCostTooMuch) {
  DirectStructure s;
  std::vector<JointEnds> star;
  for (uint32_t i = 1; i <= 60; ++i) star.push_back(link(0, i));
  EXPECT_FALSE(buildDirectStructure(star, 61, 1000, s));
  EXPECT_TRUE(s.entries.empty());
}

}  // namespace
}  // namespace pfx
