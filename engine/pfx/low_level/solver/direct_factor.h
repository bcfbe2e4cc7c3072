// Numeric part of the direct joint solver: block L D L^T over the structure, in double, for one block size.
//
// Every block is N x N, row by row; joints with fewer rows are padded with rows of the identity. Each
// function is a plain loop, so that the order of operations, and with it every bit, is that of the structure.
#pragma once

#include <cmath>
#include <span>

#include "pfx/low_level/solver/direct_structure.h"

namespace pfx {

// The blocks, N * N doubles each: diagonal by position, and one an entry of the structure.
struct DirectBlocks {
  std::span<double> diagonal;      // afterwards: inverses of D
  std::span<double> off_diagonal;  // afterwards: L
};

// Inverse of the symmetric positive definite m in place, by Cholesky. A pivot that is not positive (a row
// that the others determine already) is taken out, as if it were held by nothing.
template <int N>
void invertSymmetric(double* m) {
  double l[N][N], inverse[N][N];
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k <= i; ++k) {
      double s = m[i * N + k];
      for (int q = 0; q < k; ++q) s -= l[i][q] * l[k][q];
      if (k < i)
        l[i][k] = s * l[k][k];
      else
        l[i][i] = s > 1e-14 * m[i * N + i] ? 1.0 / std::sqrt(s) : 0.0;  // the reciprocal
    }
  }
  for (int c = 0; c < N; ++c) {
    for (int i = c; i < N; ++i) {
      double s = i == c ? 1.0 : 0.0;
      for (int q = c; q < i; ++q) s -= l[i][q] * inverse[q][c];
      inverse[i][c] = s * l[i][i];
    }
  }
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k <= i; ++k) {
      double s = 0.0;
      for (int q = i; q < N; ++q) s += inverse[q][i] * inverse[q][k];
      m[i * N + k] = m[k * N + i] = s;
    }
  }
}

// out = a * b, b symmetric
template <int N>
void multiply(const double* a, const double* b, double* out) {
  for (int i = 0; i < N; ++i) {
    double row[N] = {};
    for (int q = 0; q < N; ++q)
      for (int k = 0; k < N; ++k) row[k] += a[i * N + q] * b[q * N + k];
    for (int k = 0; k < N; ++k) out[i * N + k] = row[k];
  }
}

// out -= a * b^T
template <int N>
void subtractProduct(const double* a, const double* b, double* out) {
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < N; ++k) {
      double s = 0.0;
      for (int q = 0; q < N; ++q) s += a[i * N + q] * b[k * N + q];
      out[i * N + k] -= s;
    }
  }
}

// scratch: N * N doubles for each entry of the longest column.
template <int N>
void factorDirect(const DirectStructure& s, const DirectBlocks& blocks, std::span<double> scratch) {
  constexpr int kBlock = N * N;
  size_t update = 0;
  for (size_t p = 0; p + 1 < s.column_begin.size(); ++p) {
    double* d = &blocks.diagonal[p * kBlock];
    invertSymmetric<N>(d);
    const uint32_t begin = s.column_begin[p], end = s.column_begin[p + 1];
    for (uint32_t i = begin; i < end; ++i) {
      const double* a = &blocks.off_diagonal[size_t(i) * kBlock];
      double* product = &scratch[size_t(i - begin) * kBlock];
      multiply<N>(a, d, product);
      for (uint32_t k = begin; k <= i; ++k) {
        const uint32_t to = s.updates[update++];
        double* target = to == DirectStructure::kDiagonal
                             ? &blocks.diagonal[size_t(s.entries[i].row) * kBlock]
                             : &blocks.off_diagonal[size_t(to) * kBlock];
        subtractProduct<N>(product, &blocks.off_diagonal[size_t(k) * kBlock], target);
      }
    }
    for (uint32_t i = begin; i < end; ++i)
      for (int q = 0; q < kBlock; ++q)
        blocks.off_diagonal[size_t(i) * kBlock + q] = scratch[size_t(i - begin) * kBlock + q];
  }
}

// x (N doubles by position): right-hand side in, solution out.
template <int N>
void solveDirect(const DirectStructure& s, const DirectBlocks& blocks, std::span<double> x) {
  constexpr int kBlock = N * N;
  const size_t n = s.column_begin.size() - 1;
  for (size_t p = 0; p < n; ++p) {
    for (uint32_t e = s.column_begin[p]; e < s.column_begin[p + 1]; ++e) {
      const double* l = &blocks.off_diagonal[size_t(e) * kBlock];
      double* to = &x[size_t(s.entries[e].row) * N];
      for (int i = 0; i < N; ++i)
        for (int k = 0; k < N; ++k) to[i] -= l[i * N + k] * x[p * N + k];
    }
  }
  for (size_t p = n; p-- > 0;) {
    double y[N] = {};
    for (int i = 0; i < N; ++i)
      for (int k = 0; k < N; ++k) y[i] += blocks.diagonal[p * kBlock + i * N + k] * x[p * N + k];
    for (uint32_t e = s.column_begin[p]; e < s.column_begin[p + 1]; ++e) {
      const double* l = &blocks.off_diagonal[size_t(e) * kBlock];
      const double* from = &x[size_t(s.entries[e].row) * N];
      for (int i = 0; i < N; ++i)
        for (int k = 0; k < N; ++k) y[k] -= l[i * N + k] * from[i];
    }
    for (int i = 0; i < N; ++i) x[p * N + i] = y[i];
  }
}

}  // namespace pfx
