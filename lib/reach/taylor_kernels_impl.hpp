// The kernels of Taylor series, compiled once for each width of vectors. COORDREQ_KERNEL_NAMESPACE is a
// namespace of its own, COORDREQ_VECTOR_BYTES that width. Nothing inline of other headers may be used: the
// linker would take one of its copies for all.
//
// The operations are those of Ball, one for one, so that a lane has the numbers that it would have alone; but
// terms that are zero are left out of sums.

#include "reach/taylor_kernels.hpp"

namespace coordreq::COORDREQ_KERNEL_NAMESPACE {
namespace {

typedef double Lanes __attribute__((vector_size(COORDREQ_VECTOR_BYTES)));
typedef long long Mask __attribute__((vector_size(COORDREQ_VECTOR_BYTES)));
constexpr size_t kWidth = COORDREQ_VECTOR_BYTES / sizeof(double);
static_assert(kWidth >= 2 && BallLanes::kLanes % kWidth == 0);

#define COORDREQ_INLINE inline __attribute__((always_inline))

// As in Ball.
constexpr double kRounding = 0x1.01p-53;
constexpr double kSlack = 1.0 + 0x1p-48;
constexpr double kTiny = 0x1p-1000;

struct Balls {
  Lanes middle;
  Lanes radius;
};

COORDREQ_INLINE Lanes all(double value) {
  return Lanes{} + value;
}
COORDREQ_INLINE Lanes masked(Lanes a, Mask mask) {
  return (Lanes)((Mask)a & mask);
}
COORDREQ_INLINE Lanes chosen(Mask mask, Lanes a, Lanes b) {
  return (Lanes)(((Mask)a & mask) | ((Mask)b & ~mask));
}
COORDREQ_INLINE Lanes magnitude(Lanes a) {
  return masked(a, Mask{} + 0x7fffffffffffffffLL);
}
COORDREQ_INLINE Mask nonzero(Balls a) {
  return (Lanes)((Mask)a.middle | (Mask)a.radius) != Lanes{};
}
/// Each lane of a mask has all its bits or none.
COORDREQ_INLINE bool any(Mask mask) {
#if defined(__AVX__) && COORDREQ_VECTOR_BYTES == 32
  return __builtin_ia32_movmskpd256((Lanes)mask) != 0;
#else
  long long all = 0;
  for (size_t lane = 0; lane < kWidth; ++lane) all |= mask[lane];
  return all != 0;
#endif
}

COORDREQ_INLINE Balls negated(Balls a) {
  return {-a.middle, a.radius};
}
COORDREQ_INLINE Balls plus(Balls a, Balls b) {
  const Lanes sum = a.middle + b.middle;
  return {sum, (a.radius + b.radius + kRounding * magnitude(sum)) * kSlack};
}
COORDREQ_INLINE Balls minus(Balls a, Balls b) {
  return plus(a, negated(b));
}
COORDREQ_INLINE Balls times(Balls a, Balls b) {
  const Mask mask = nonzero(a) & nonzero(b);
  const Lanes product = a.middle * b.middle;
  const Lanes spread = (magnitude(a.middle) + a.radius) * b.radius + magnitude(b.middle) * a.radius;
  const Lanes radius = (spread + kRounding * magnitude(product) + kTiny) * kSlack;
  return {masked(product, mask), masked(radius, mask)};
}
COORDREQ_INLINE Balls divided(Balls a, Balls b) {
  const Lanes least = (magnitude(b.middle) - b.radius) * (1.0 - 0x1p-48);
  const Mask bounded = least > Lanes{};
  const Lanes quotient = a.middle / b.middle;
  const Lanes residual = kRounding * magnitude(quotient) * magnitude(b.middle) + kTiny;
  const Lanes spread = a.radius + magnitude(quotient) * b.radius + residual;
  const Lanes radius = (spread / least + kTiny) * kSlack;
  const Mask mask = nonzero(a);
  return {masked(quotient, bounded & mask), masked(chosen(bounded, radius, all(__builtin_inf())), mask)};
}
COORDREQ_INLINE Balls exactly(size_t value) {
  return {all(static_cast<double>(value)), Lanes{}};
}
/// sum + term, where the term is not zero.
COORDREQ_INLINE Balls with_term(Balls sum, Balls term) {
  const Balls more = plus(sum, term);
  const Mask mask = nonzero(term);
  return {chosen(mask, more.middle, sum.middle), chosen(mask, more.radius, sum.radius)};
}

COORDREQ_INLINE size_t smaller(size_t a, size_t b) {
  return a < b ? a : b;
}
COORDREQ_INLINE size_t larger(size_t a, size_t b) {
  return a > b ? a : b;
}

/// The series in one block of the lanes.
struct LaneBlock {
  const SeriesMemory& memory;
  size_t block;

  COORDREQ_INLINE Balls read(const BallLanes& from) const {
    return {*reinterpret_cast<const Lanes*>(from.middle + block * kWidth),
            *reinterpret_cast<const Lanes*>(from.radius + block * kWidth)};
  }
  COORDREQ_INLINE void write(Balls value, BallLanes& to) const {
    *reinterpret_cast<Lanes*>(to.middle + block * kWidth) = value.middle;
    *reinterpret_cast<Lanes*>(to.radius + block * kWidth) = value.radius;
  }
  COORDREQ_INLINE Balls at(size_t node, size_t k) const {
    return read(memory.coefficients[node * memory.stride + k]);
  }
  COORDREQ_INLINE Balls weighted(size_t node, size_t k) const {
    return read(memory.weighted[node * memory.stride + k]);
  }
  COORDREQ_INLINE Balls of(size_t node, bool moves, size_t k) const {
    return k == 0 || moves ? at(node, k) : Balls{};
  }
  COORDREQ_INLINE size_t last(size_t node, bool moves) const {
    return moves ? memory.last_nonzero[block * memory.tape_size + node] : 0;
  }

  /// sum of p_j q_{k-j} over first <= j <= last.
  Balls convolution(size_t p, size_t p_last, size_t q, size_t q_last, size_t k, size_t first,
                    size_t to) const {
    const size_t from = larger(first, k > q_last ? k - q_last : 0);
    to = smaller(to, smaller(p_last, k));
    Balls sum{};
    for (size_t j = from; j <= to; ++j) sum = with_term(sum, times(at(p, j), at(q, k - j)));
    return sum;
  }
  Balls product(const SeriesNode& node, size_t k) const {
    const size_t p_last = last(node.p, node.p_moves);
    if (node.p == node.q) return square(node.p, p_last, k);
    return convolution(node.p, p_last, node.q, last(node.q, node.q_moves), k, 0, k);
  }
  Balls square(size_t p, size_t p_last, size_t k) const {
    Balls sum{};
    for (size_t j = k > p_last ? k - p_last : 0; 2 * j < k; ++j)
      sum = with_term(sum, times(at(p, j), at(p, k - j)));
    sum = plus(sum, sum);
    if (k % 2 == 1 || k / 2 > p_last) return sum;
    return with_term(sum, times(at(p, k / 2), at(p, k / 2)));
  }
  /// q r = p.
  Balls quotient(const SeriesNode& node, size_t k) const {
    const Balls known =
        convolution(node.q, last(node.q, node.q_moves), node.self, last(node.self, true), k, 1, k);
    return divided(minus(of(node.p, node.p_moves, k), known), at(node.q, 0));
  }
  /// k r_k = sum of j p_j q_{k-j} over j >= 1.
  Balls chain(const SeriesNode& node, size_t k) const {
    const size_t q_last = last(node.q, node.q_moves);
    const size_t to = smaller(k, last(node.p, node.p_moves));
    Balls sum{};
    for (size_t j = larger(1, k > q_last ? k - q_last : 0); j <= to; ++j)
      sum = with_term(sum, times(weighted(node.p, j), at(node.q, k - j)));
    return divided(sum, exactly(k));
  }
  /// k q_0 r_k = k p_k - sum of j r_j q_{k-j} over 1 <= j < k.
  Balls inverse_chain(const SeriesNode& node, size_t k) const {
    const size_t q_last = last(node.q, node.q_moves);
    Balls sum = times(exactly(k), of(node.p, node.p_moves, k));
    for (size_t j = larger(1, k > q_last ? k - q_last : 0); j < k; ++j)
      sum = with_term(sum, negated(times(weighted(node.self, j), at(node.q, k - j))));
    return divided(sum, times(exactly(k), at(node.q, 0)));
  }
  /// r^2 = p.
  Balls root(const SeriesNode& node, size_t k) const {
    const size_t r_last = last(node.self, true);
    const Balls known = convolution(node.self, r_last, node.self, r_last, k, 1, k - 1);
    return divided(minus(of(node.p, node.p_moves, k), known), times(exactly(2), at(node.self, 0)));
  }
  /// p r' = q r p' for a fixed exponent q: k p_0 r_k = sum of ((q + 1) j - k) p_j r_{k-j} over 1 <= j <= k.
  Balls power(const SeriesNode& node, size_t k) const {
    const Balls exponent = plus(at(node.q, 0), exactly(1));
    const size_t to = smaller(k, last(node.p, node.p_moves));
    Balls sum{};
    for (size_t j = 1; j <= to; ++j) {
      const Balls factor = minus(times(exponent, exactly(j)), exactly(k));
      sum = with_term(sum, times(times(factor, at(node.p, j)), at(node.self, k - j)));
    }
    return divided(sum, times(exactly(k), at(node.p, 0)));
  }
  /// s = p^2 + q^2: k s_0 r_k = sum of j (p_j q_{k-j} - q_j p_{k-j}) over 1 <= j <= k, less the sum of j r_j
  /// s_{k-j} over 1 <= j < k.
  Balls angle(const SeriesNode& node, size_t k) const {
    Balls sum{};
    for (size_t j = 1; j <= k; ++j) {
      Balls term = minus(times(of(node.p, node.p_moves, j), of(node.q, node.q_moves, k - j)),
                         times(of(node.q, node.q_moves, j), of(node.p, node.p_moves, k - j)));
      if (j < k) term = minus(term, times(at(node.self, j), of(node.square, node.square_moves, k - j)));
      sum = with_term(sum, times(exactly(j), term));
    }
    return divided(sum, times(exactly(k), at(node.square, 0)));
  }

  Balls next(const SeriesNode& node, size_t k) const {
    switch (node.step) {
      case SeriesStep::zero:
        break;
      case SeriesStep::input:
        return read(memory.states[node.p * memory.stride + k]);
      case SeriesStep::same:
        return of(node.p, node.p_moves, k);
      case SeriesStep::sum:
        return plus(of(node.p, node.p_moves, k), of(node.q, node.q_moves, k));
      case SeriesStep::difference:
        return minus(of(node.p, node.p_moves, k), of(node.q, node.q_moves, k));
      case SeriesStep::negation:
        return negated(of(node.p, node.p_moves, k));
      case SeriesStep::product:
        return product(node, k);
      case SeriesStep::quotient:
        return quotient(node, k);
      case SeriesStep::chain:
        return chain(node, k);
      case SeriesStep::inverse_chain:
        return inverse_chain(node, k);
      case SeriesStep::root:
        return root(node, k);
      case SeriesStep::power:
        return power(node, k);
      case SeriesStep::angle:
        return angle(node, k);
    }
    return Balls{};
  }

  void extend_nodes(size_t k) const {
    for (size_t n = 0; n < memory.node_count; ++n) {
      const SeriesNode& node = memory.nodes[n];
      const Balls value = next(node, k);
      write(value, memory.coefficients[node.self * memory.stride + k]);
      if (any(nonzero(value)))
        memory.last_nonzero[block * memory.tape_size + node.self] = static_cast<uint32_t>(k);
      if (node.weighted) write(times(exactly(k), value), memory.weighted[node.self * memory.stride + k]);
    }
  }

  void extend_states(size_t k) const {
    for (size_t i = 0; i < memory.state_count; ++i) {
      const SeriesOutput& output = memory.outputs[i];
      Balls value{};
      if (!output.held && (k == 1 || output.moves)) value = at(output.node, k - 1);
      if (k > 1) value = divided(value, exactly(k));
      write(value, memory.states[i * memory.stride + k]);
    }
  }
};

void extend(const SeriesMemory& memory, size_t k) {
  for (size_t block = 0; block * kWidth < memory.lanes; ++block) {
    const LaneBlock lanes{memory, block};
    if (k > 0) lanes.extend_nodes(k);
    lanes.extend_states(k + 1);
  }
}

void polynomial(const SeriesMemory& memory, size_t state, size_t order, const BallLanes& h, BallLanes& sum) {
  for (size_t block = 0; block * kWidth < memory.lanes; ++block) {
    const LaneBlock lanes{memory, block};
    const Balls duration = lanes.read(h);
    Balls value{};
    for (size_t k = order; k-- > 0;) {
      const Balls coefficient = lanes.read(memory.states[state * memory.stride + k]);
      const Balls next = plus(times(value, duration), coefficient);
      const Mask mask = nonzero(value);
      value = {chosen(mask, next.middle, coefficient.middle), chosen(mask, next.radius, coefficient.radius)};
    }
    lanes.write(value, sum);
  }
}

#undef COORDREQ_INLINE

}  // namespace

extern const TaylorKernels kTaylorKernels;
const TaylorKernels kTaylorKernels{extend, polynomial};

}  // namespace coordreq::COORDREQ_KERNEL_NAMESPACE
