#include "derivatives/small_products.hpp"

#include <cmath>

#include "lagrangian/packed/lane.hpp"

namespace saltus {
namespace {

// Matrices are stored by rows: c, a row of C, is the sum of rows of B, each times a number of A's.

/// c_k += b_k A for four rows, two rows of A at a time. A has m rows of n.
SALTUS_CLONES void add_four(const double* A, const double* const* b, long n, long m,
                            double* const* c) {
  double *c0 = c[0], *c1 = c[1], *c2 = c[2], *c3 = c[3];
  long k = 0;
  for (; k + 1 < m; k += 2) {
    const double *a = A + k * n, *a2 = a + n;
    const double x0 = b[0][k], x1 = b[1][k], x2 = b[2][k], x3 = b[3][k];
    const double y0 = b[0][k + 1], y1 = b[1][k + 1], y2 = b[2][k + 1], y3 = b[3][k + 1];
    SALTUS_LANES
    for (long i = 0; i < n; ++i) {
      c0[i] += a[i] * x0 + a2[i] * y0;
      c1[i] += a[i] * x1 + a2[i] * y1;
      c2[i] += a[i] * x2 + a2[i] * y2;
      c3[i] += a[i] * x3 + a2[i] * y3;
    }
  }
  for (; k < m; ++k) {
    const double* a = A + k * n;
    SALTUS_LANES
    for (long i = 0; i < n; ++i) {
      c0[i] += a[i] * b[0][k];
      c1[i] += a[i] * b[1][k];
      c2[i] += a[i] * b[2][k];
      c3[i] += a[i] * b[3][k];
    }
  }
}

SALTUS_CLONES void add_one(const double* A, const double* b, long n, long m, double* c) {
  for (long k = 0; k < m; ++k) {
    const double x = b[k];
    const double* a = A + k * n;
    SALTUS_LANES
    for (long i = 0; i < n; ++i) c[i] += a[i] * x;
  }
}

/// Every row j but k: a_j -= a_k a_jk / pivot; a_k is scaled by 1 / pivot.
SALTUS_CLONES void eliminate(double* A, long n, long k) {
  double* own = A + k * n;
  const double inverse = 1 / own[k];
  for (long j = 0; j < n; ++j) {
    double* row = A + j * n;
    if (j == k || row[k] == 0) continue;
    const double factor = row[k] * inverse;
    row[k] = 0;
    SALTUS_LANES
    for (long i = 0; i < n; ++i) row[i] -= own[i] * factor;
    row[k] = -factor;
  }
  SALTUS_LANES
  for (long i = 0; i < n; ++i) own[i] *= inverse;
  own[k] = inverse;
}

}  // namespace

void add_product(const MatX& A, const MatX& B, MatX& C) {
  const long n = B.cols(), m = B.rows(), rows = A.rows();
  long j = 0;
  for (; j + 3 < rows; j += 4) {
    const double* a[4] = {&A(j, 0), &A(j + 1, 0), &A(j + 2, 0), &A(j + 3, 0)};
    double* c[4] = {&C(j, 0), &C(j + 1, 0), &C(j + 2, 0), &C(j + 3, 0)};
    add_four(B.data(), a, n, m, c);
  }
  for (; j < rows; ++j) add_one(B.data(), &A(j, 0), n, m, &C(j, 0));
}

bool invert(MatX& A) {
  for (long k = A.rows() - 1; k >= 0; --k) {
    if (!std::isfinite(A(k, k)) || A(k, k) == 0) return false;
    eliminate(A.data(), A.rows(), k);
  }
  return true;
}

}  // namespace saltus
