// What the kernels are written with: values of one lane, and loops over lanes.
#pragma once

#include <cmath>

#include "saltus/lagrangian/packed_tree.hpp"

// One library for every machine: GCC compiles a kernel for each of these instruction sets and picks
// at load time. Elsewhere (other compilers and processors, sanitizers, which do not bear functions
// that are chosen before they are ready) the plain version is compiled.
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && __GNUC__ >= 12 && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SALTUS_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SALTUS_CLONES
#endif

// Lanes do not depend on each other.
#if defined(__clang__)
#define SALTUS_LANES _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define SALTUS_LANES _Pragma("GCC ivdep")
#else
#define SALTUS_LANES
#endif

#if defined(__GNUC__)
#define SALTUS_INLINE inline __attribute__((always_inline))
#define SALTUS_INLINE_LAMBDA __attribute__((always_inline))
#else
#define SALTUS_INLINE inline
#define SALTUS_INLINE_LAMBDA
#endif

namespace saltus::packed {

struct V3 {
  double x, y, z;
};

SALTUS_INLINE V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
SALTUS_INLINE V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
SALTUS_INLINE V3 operator*(double k, V3 a) { return {k * a.x, k * a.y, k * a.z}; }
SALTUS_INLINE double dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
SALTUS_INLINE V3 cross(V3 a, V3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Sum of absolute values: a norm without a root.
SALTUS_INLINE double size(V3 a) { return std::abs(a.x) + std::abs(a.y) + std::abs(a.z); }

/// k a, rounded before it is added to anything: kernels are compiled with fused sums.
SALTUS_INLINE V3 rounded_product(double k, V3 a) {
#if defined(__GNUC__) && !defined(__clang__) && __GNUC__ >= 12
  return {__builtin_assoc_barrier(k * a.x), __builtin_assoc_barrier(k * a.y),
          __builtin_assoc_barrier(k * a.z)};
#else
  return k * a;
#endif
}

/// By columns.
struct M3 {
  V3 x, y, z;
};

SALTUS_INLINE V3 operator*(const M3& A, V3 b) { return b.x * A.x + b.y * A.y + b.z * A.z; }
SALTUS_INLINE M3 operator*(const M3& A, const M3& B) { return {A * B.x, A * B.y, A * B.z}; }

SALTUS_INLINE M3 operator+(const M3& A, const M3& B) { return {A.x + B.x, A.y + B.y, A.z + B.z}; }
SALTUS_INLINE M3 operator-(const M3& A, const M3& B) { return {A.x - B.x, A.y - B.y, A.z - B.z}; }
SALTUS_INLINE M3 operator*(double k, const M3& A) { return {k * A.x, k * A.y, k * A.z}; }
SALTUS_INLINE M3 transpose(const M3& A) {
  return {{A.x.x, A.y.x, A.z.x}, {A.x.y, A.y.y, A.z.y}, {A.x.z, A.y.z, A.z.z}};
}
/// A^T b.
SALTUS_INLINE V3 dot(const M3& A, V3 b) { return {dot(A.x, b), dot(A.y, b), dot(A.z, b)}; }
/// a b^T.
SALTUS_INLINE M3 outer(V3 a, V3 b) { return {b.x * a, b.y * a, b.z * a}; }
/// [f]: the matrix of f x.
SALTUS_INLINE M3 cross_matrix(V3 f) { return {{0, f.z, -f.y}, {-f.z, 0, f.x}, {f.y, -f.x, 0}}; }
SALTUS_INLINE M3 scalar_matrix(double k) { return {{k, 0, 0}, {0, k, 0}, {0, 0, k}}; }

/// Symmetric.
struct S3 {
  double xx, xy, xz, yy, yz, zz;
};

SALTUS_INLINE V3 operator*(const S3& A, V3 b) {
  return {A.xx * b.x + A.xy * b.y + A.xz * b.z, A.xy * b.x + A.yy * b.y + A.yz * b.z,
          A.xz * b.x + A.yz * b.y + A.zz * b.z};
}

struct V6 {
  V3 w, v;  ///< angular, linear
};

SALTUS_INLINE V6 operator+(V6 a, V6 b) { return {a.w + b.w, a.v + b.v}; }
SALTUS_INLINE V6 operator-(V6 a, V6 b) { return {a.w - b.w, a.v - b.v}; }
SALTUS_INLINE V6 operator*(double k, V6 a) { return {k * a.w, k * a.v}; }
SALTUS_INLINE double dot(V6 a, V6 b) { return dot(a.w, b.w) + dot(a.v, b.v); }
SALTUS_INLINE V6 cross_motion(V6 a, V6 b) {
  return {cross(a.w, b.w), cross(a.w, b.v) + cross(a.v, b.w)};
}
SALTUS_INLINE V6 cross_force(V6 a, V6 f) {
  return {cross(a.w, f.w) + cross(a.v, f.v), cross(a.w, f.v)};
}

/// Momentum wrench of a body: mass, first moment h, inertia I about O.
SALTUS_INLINE V6 momentum(double mass, V3 h, const S3& I, V6 twist) {
  return {I * twist.w + cross(h, twist.v), mass * twist.v - cross(h, twist.w)};
}

// Numbers c, c + 1, ... of the lane that x points to.
SALTUS_INLINE V3 load3(const double* x, int c) {
  return {x[c * lanes], x[(c + 1) * lanes], x[(c + 2) * lanes]};
}
SALTUS_INLINE V6 load6(const double* x, int c) { return {load3(x, c), load3(x, c + 3)}; }
SALTUS_INLINE M3 load9(const double* x, int c) {
  return {load3(x, c), load3(x, c + 3), load3(x, c + 6)};
}
SALTUS_INLINE S3 load_symmetric(const double* x, int c) {
  return {x[c * lanes],       x[(c + 1) * lanes], x[(c + 2) * lanes],
          x[(c + 3) * lanes], x[(c + 4) * lanes], x[(c + 5) * lanes]};
}
SALTUS_INLINE void store(double* x, int c, V3 a) {
  x[c * lanes] = a.x;
  x[(c + 1) * lanes] = a.y;
  x[(c + 2) * lanes] = a.z;
}
SALTUS_INLINE void store(double* x, int c, V6 a) {
  store(x, c, a.w);
  store(x, c + 3, a.v);
}
SALTUS_INLINE void store(double* x, int c, const M3& A) {
  store(x, c, A.x);
  store(x, c + 3, A.y);
  store(x, c + 6, A.z);
}
SALTUS_INLINE void store(double* x, int c, const S3& A) {
  store(x, c, V3{A.xx, A.xy, A.xz});
  store(x, c + 3, V3{A.yy, A.yz, A.zz});
}

/// Adds C numbers of every joint to its parent's, from the leaves to the root.
template <int C, int B>
SALTUS_INLINE void add_up(const PackedGroup& g, Blocks<B>& x, int first) {
  for (int k = g.positions - 1; k > 0; --k) {
    const double* child = at(x, g.slot(k)) + first * lanes;
    double* parent = at(x, g.slot(g.parent[k])) + first * lanes;
    if (g.width == 1) {
      for (int c = 0; c < C; ++c) parent[c * lanes] += child[c * lanes];
      continue;
    }
    for (int b = 0; b < g.width / lanes; ++b) {
      for (int c = 0; c < C; ++c) {
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          parent[(b * B + c) * lanes + l] += child[(b * B + c) * lanes + l];
        }
      }
    }
  }
}

/// Adds C numbers of every joint's parent to its own, from the root to the leaves.
template <int C, int B>
SALTUS_INLINE void add_down(const PackedGroup& g, Blocks<B>& x, int first) {
  for (int k = 1; k < g.positions; ++k) {
    double* child = at(x, g.slot(k)) + first * lanes;
    const double* parent = at(x, g.slot(g.parent[k])) + first * lanes;
    if (g.width == 1) {
      for (int c = 0; c < C; ++c) child[c * lanes] += parent[c * lanes];
      continue;
    }
    for (int b = 0; b < g.width / lanes; ++b) {
      for (int c = 0; c < C; ++c) {
        SALTUS_LANES
        for (int l = 0; l < lanes; ++l) {
          child[(b * B + c) * lanes + l] += parent[(b * B + c) * lanes + l];
        }
      }
    }
  }
}

}  // namespace saltus::packed
