// One source, compiled once for every instruction set by Highway (foreach_target), see kernel.h.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ripstop/cloth/kernel.cpp"
#include "ripstop/cloth/kernel.h"

#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace ripstop::inline cloth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, lanes>;
using V = hn::Vec<Tag>;
constexpr Tag tag;

constexpr int vector_stride = 3 * lanes;  // doubles from one vector of a row to the next

struct Three {
  V x, y, z;
};
HWY_INLINE Three load(const double* p) {
  return {hn::Load(tag, p), hn::Load(tag, p + lanes), hn::Load(tag, p + 2 * lanes)};
}
HWY_INLINE void store(Three a, double* p) {
  hn::Store(a.x, tag, p);
  hn::Store(a.y, tag, p + lanes);
  hn::Store(a.z, tag, p + 2 * lanes);
}
// Other lanes are not touched: another thread may be reading them.
HWY_INLINE void store_where(hn::Mask<Tag> mask, Three a, double* p) {
  hn::BlendedStore(a.x, mask, tag, p);
  hn::BlendedStore(a.y, mask, tag, p + lanes);
  hn::BlendedStore(a.z, mask, tag, p + 2 * lanes);
}
HWY_INLINE Three zero() {
  return {hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
}
HWY_INLINE Three operator+(Three a, Three b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Three operator-(Three a, Three b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Three scaled(Three a, double factor) {
  const V s = hn::Set(tag, factor);
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE V dot(Three a, Three b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
HWY_INLINE Three add_scaled(Three a, V s, Three b) {
  return {hn::MulAdd(s, b.x, a.x), hn::MulAdd(s, b.y, a.y), hn::MulAdd(s, b.z, a.z)};
}
HWY_INLINE Three subtract_scaled(Three a, V s, Three b) {
  return {hn::NegMulAdd(s, b.x, a.x), hn::NegMulAdd(s, b.y, a.y), hn::NegMulAdd(s, b.z, a.z)};
}

struct Root {
  V value, inverse;
};
// sqrt and 1 / sqrt of q > 0 to the last bit or two.
HWY_INLINE Root root(V q) {
#if HWY_TARGET == HWY_AVX3
  // y0 = rsqrt14(q); r = 1 - q y0^2 < 2^-13;
  // 1/sqrt(q) = y0 (1 - r)^(-1/2) = y0 (1 + r/2 + 3/8 r^2 + 5/16 r^3), the next term is below 1e-16.
  // One step of fourth order in place of two of Newton's, one operation less.
  const V y = V{_mm512_rsqrt14_pd(q.raw)};
  const V s = hn::Mul(q, y);
  const V r = hn::NegMulAdd(s, y, hn::Set(tag, 1.0));
  const V c = hn::Mul(
      r, hn::MulAdd(r, hn::MulAdd(r, hn::Set(tag, 5.0 / 16), hn::Set(tag, 3.0 / 8)), hn::Set(tag, 0.5)));
  return {hn::MulAdd(s, c, s), hn::MulAdd(y, c, y)};
#else
  const V length = hn::Sqrt(q);
  return {length, hn::Div(hn::Set(tag, 1.0), length)};
#endif
}

// The force over the length of a spring from p toward q is g (q - p) with
//   e = |q - p| / L0 - 1,   T = w (both max(e, e_b) + sum c_k max(e, 0)^k),   g = (T + C (dv . d) / |d|) / |d|
// [NFM] Eq. 2, 3, with C = damping + share viscosity w / L0, and 0 where e <= e_b: wrinkled springs dissipate no
// energy. Springs with w = 0 have no damping either. `taken` gains the damper's power.
template <int degree, bool damped>
HWY_INLINE V pull(const PatchLayout& patch, int direction, const double* springs, V share, Three d, Three dv,
                  V& taken) {
  const double* own = springs + 2 * direction * lanes;
  const V inverse_rest = hn::Load(tag, own);
  const V width = hn::Load(tag, own + lanes);
  const FamilyLaw& law = patch.law[direction];
  // The 1e-60 m2 keeps two coincident nodes from making NaN: their force is 0, its direction unknown.
  const V square = hn::MulAdd(d.z, d.z, hn::MulAdd(d.y, d.y, hn::MulAdd(d.x, d.x, hn::Set(tag, 1e-60))));
  const Root length = root(square);
  const V strain = hn::MulSub(length.value, inverse_rest, hn::Set(tag, 1.0));
  const V stretch = hn::Max(strain, hn::Zero(tag));
  V sum;
  if constexpr (degree == 0) {  // any degree
    sum = hn::Set(tag, law.positive_part[patch.degree - 1]);
    for (int k = patch.degree - 2; k >= 0; --k)
      sum = hn::MulAdd(sum, stretch, hn::Set(tag, law.positive_part[k]));
  } else {
    sum = hn::Set(tag, law.positive_part[degree - 1]);
    if constexpr (degree > 2) sum = hn::MulAdd(sum, stretch, hn::Set(tag, law.positive_part[1]));
    if constexpr (degree > 1) sum = hn::MulAdd(sum, stretch, hn::Set(tag, law.positive_part[0]));
  }
  const V pushed = hn::Max(strain, hn::Set(tag, law.buckled));
  V tension = hn::Mul(width, hn::MulAdd(sum, stretch, hn::Mul(pushed, hn::Set(tag, law.both))));
  if constexpr (damped) {
    const V rate = hn::Mul(dot(d, dv), length.inverse);
    const V damping =
        hn::MulAdd(hn::Mul(width, inverse_rest), hn::Mul(share, hn::Set(tag, patch.viscosity[direction])),
                   hn::IfThenElseZero(hn::Gt(width, hn::Zero(tag)), hn::Set(tag, patch.damping[direction])));
    const V damper = hn::IfThenElseZero(hn::Gt(strain, hn::Set(tag, law.buckled)), hn::Mul(damping, rate));
    tension = hn::Add(damper, tension);
    taken = hn::MulAdd(damper, rate, taken);
  }
  return hn::Mul(tension, length.inverse);
}

// Long, for the forces of six springs wait in registers for the vectors that they act on.
template <int degree, bool damped, bool pressed>
double row_forces(const RowForces& row) {  // NOLINT(readability-function-size)
  const PatchLayout& patch = *row.patch;
  const int end = patch.vectors * vector_stride;
  alignas(64) double power[lanes] = {};
  for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(tag))) {
    const double* springs = row.springs + lane;
    V taken = hn::Zero(tag);
    // Force that waits for the next two vectors of this row and the next one of row + 1.
    Three wait1 = zero(), wait2 = zero(), wait_up = zero();
    for (int m = lane; m < end + lane; m += vector_stride, springs += PatchLayout::springs_per_vector) {
      const Three p = load(row.x0 + m);
      Three u = zero();
      V share = hn::Zero(tag);
      if constexpr (damped) {
        u = load(row.v0 + m);
        share = hn::Load(tag, row.damper_share + lane + (m - lane) / 3);
      }
      const auto speed = [&](const double* v) {
        if constexpr (damped)
          return load(v + m) - u;
        else
          return (void)v, zero();
      };
      Three own = load(row.f0 + m) + wait1;
      Three next = wait2;
      {
        const Three d = load(row.x2 + m) - p;
        const V g = pull<degree, damped>(patch, bend_column, springs, share, d, speed(row.v2), taken);
        own = add_scaled(own, g, d);
        store(subtract_scaled(zero(), g, d), row.f2 + m);
      }
      {
        const Three d = load(row.x0 + m + 2 * vector_stride) - p;
        const V g = pull<degree, damped>(patch, bend_row, springs, share, d,
                                         speed(row.v0 + 2 * vector_stride), taken);
        own = add_scaled(own, g, d);
        wait2 = subtract_scaled(zero(), g, d);
      }
      const Three right = load(row.x0 + m + vector_stride);
      {
        const Three d = right - p;
        const V g =
            pull<degree, damped>(patch, along_row, springs, share, d, speed(row.v0 + vector_stride), taken);
        own = add_scaled(own, g, d);
        next = subtract_scaled(next, g, d);
      }
      Three up = load(row.f1 + m) + wait_up;
      const Three above = load(row.x1 + m);
      {
        const Three d = above - p;
        const V g = pull<degree, damped>(patch, along_column, springs, share, d, speed(row.v1), taken);
        own = add_scaled(own, g, d);
        up = subtract_scaled(up, g, d);
      }
      const Three across = load(row.x1 + m + vector_stride) - p;
      {
        const V g = pull<degree, damped>(patch, shear_up, springs, share, across,
                                         speed(row.v1 + vector_stride), taken);
        own = add_scaled(own, g, across);
        wait_up = subtract_scaled(zero(), g, across);
      }
      const Three d = above - right;  // the other diagonal: from column + 1 to row + 1
      {
        Three dv = zero();
        if constexpr (damped) dv = load(row.v1 + m) - load(row.v0 + m + vector_stride);
        const V g = pull<degree, damped>(patch, shear_down, springs, share, d, dv, taken);
        next = add_scaled(next, g, d);
        up = subtract_scaled(up, g, d);
      }
      if constexpr (pressed) {
        // A quarter of dp times the area vector, half the cross product of the diagonals 0 -> 2 and 1 -> 3.
        const V q = hn::Load(tag, row.pressure + lane + (m - lane) / 3);
        const Three a{hn::Mul(q, across.x), hn::Mul(q, across.y), hn::Mul(q, across.z)};
        const Three load_each{hn::NegMulAdd(a.z, d.y, hn::Mul(a.y, d.z)),
                              hn::NegMulAdd(a.x, d.z, hn::Mul(a.z, d.x)),
                              hn::NegMulAdd(a.y, d.x, hn::Mul(a.x, d.y))};
        own = own + load_each;
        next = next + load_each;
        up = up + load_each;
        wait_up = wait_up + load_each;
      }
      store(own, row.f0 + m);
      store(up, row.f1 + m);
      wait1 = next;
    }
    const int ghost = end + lane;
    store(load(row.f0 + ghost) + wait1, row.f0 + ghost);
    store(load(row.f0 + ghost + vector_stride) + wait2, row.f0 + ghost + vector_stride);
    store(load(row.f1 + ghost) + wait_up, row.f1 + ghost);
    store(zero(), row.f2 + ghost);
    store(zero(), row.f2 + ghost + vector_stride);
    if constexpr (damped) hn::Store(taken, tag, power + lane);
  }
  double sum = 0;
  for (const double p : power) sum += p;
  return sum;
}

template <int degree>
double row_forces_of_degree(const RowForces& row) {
  if (row.v0 && row.pressure) return row_forces<degree, true, true>(row);
  if (row.v0) return row_forces<degree, true, false>(row);
  if (row.pressure) return row_forces<degree, false, true>(row);
  return row_forces<degree, false, false>(row);
}

// As pull(), with ends anywhere and the scale in the law's coefficients.
template <bool damped, bool recorded>
void pull_blocks(const SpringForces& job, int begin_block, int end_block) {
  const IrregularSprings& springs = *job.springs;
  const hn::RebindToSigned<Tag> index_tag;
  for (int block = begin_block; block < end_block; ++block) {
    for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(tag))) {
      const int s = block * lanes + lane, f = block * vector_stride + lane;
      const auto a = hn::LoadU(index_tag, springs.a.data() + s),
                 b = hn::LoadU(index_tag, springs.b.data() + s);
      const auto between = [&](const double* p) {
        return Three{hn::Sub(hn::GatherIndex(tag, p, b), hn::GatherIndex(tag, p, a)),
                     hn::Sub(hn::GatherIndex(tag, p + lanes, b), hn::GatherIndex(tag, p + lanes, a)),
                     hn::Sub(hn::GatherIndex(tag, p + 2 * lanes, b), hn::GatherIndex(tag, p + 2 * lanes, a))};
      };
      const Three d = between(job.x);
      const Root length =
          root(hn::MulAdd(d.z, d.z, hn::MulAdd(d.y, d.y, hn::MulAdd(d.x, d.x, hn::Set(tag, 1e-60)))));
      const V strain =
          hn::MulSub(length.value, hn::Load(tag, springs.inverse_rest.data() + s), hn::Set(tag, 1.0));
      const V stretch = hn::Max(strain, hn::Zero(tag));
      const double* law = springs.positive_part.data() + block * springs.degree * lanes + lane;
      V sum = hn::Zero(tag);
      for (int k = springs.degree - 1; k >= 0; --k)
        sum = hn::Mul(hn::Add(sum, hn::Load(tag, law + k * lanes)), stretch);
      const V buckled = hn::Load(tag, springs.buckled.data() + s);
      const V pushed = hn::Max(strain, buckled);
      V tension = hn::MulAdd(pushed, hn::Load(tag, springs.both.data() + s), sum);
      if constexpr (damped) {
        const Three dv = between(job.v);
        const V damping =
            hn::IfThenElseZero(hn::Gt(strain, buckled), hn::Load(tag, springs.damping.data() + s));
        const V rate = hn::Mul(dot(d, dv), length.inverse);
        tension = hn::MulAdd(damping, rate, tension);
        if constexpr (recorded) {
          const Three force = add_scaled(zero(), hn::Mul(hn::Mul(damping, rate), length.inverse), d);
          hn::Store(hn::MulAdd(hn::Set(tag, 0.5), dot(load(job.record.damper + f) + force, dv),
                               hn::Load(tag, job.record.taken + s)),
                    tag, job.record.taken + s);
          store(force, job.record.damper + f);
          hn::Store(hn::Max(hn::Load(tag, job.record.peak + s), tension), tag, job.record.peak + s);
        }
      }
      store(add_scaled(zero(), hn::Mul(tension, length.inverse), d), job.f + f);
    }
  }
}

enum class Damping { none, linear, quadratic };

template <Damping damping>
HWY_INLINE double motion(const RowMotion& row) {
  const V dt = hn::Set(tag, row.dt);
  // An accumulator for every lane of the row, so that every instruction set adds in the same order.
  alignas(64) double damped[lanes] = {};
  for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(tag))) {
    V damped_power = hn::Zero(tag);
    for (int m = 0; m < row.vectors; ++m) {
      const int i = m * lanes + lane, k = m * vector_stride + lane;
      const V inverse_mass = hn::Load(tag, row.inverse_mass + i);
      const auto moves = hn::Gt(inverse_mass, hn::Zero(tag));
      Three f = load(row.f + k);
      const Three old = load(row.v + k);
      V c;
      if constexpr (damping != Damping::none) {
        c = hn::Set(tag, row.linear);
        if constexpr (damping == Damping::quadratic)
          c = hn::MulAdd(hn::Set(tag, row.quadratic), hn::Sqrt(dot(old, old)), c);
        c = hn::Mul(c, hn::Load(tag, row.area + i));
        f = subtract_scaled(f, c, old);
      }
      const Three v = add_scaled(old, hn::Mul(dt, inverse_mass), f);
      if constexpr (damping != Damping::none)
        damped_power = hn::MulAdd(hn::Mul(hn::Set(tag, 0.5), c), dot(old, old + v), damped_power);
      store_where(moves, v, row.v + k);
      store_where(moves, add_scaled(load(row.x + k), dt, v), row.x + k);
    }
    hn::Store(damped_power, tag, damped + lane);
  }
  double total = 0;
  for (const double d : damped) total += d;
  return total;
}

RowSums RelaxRow(const RowRelaxation& row) {
  alignas(64) double squared[lanes] = {}, power[lanes] = {};
  const V kick = hn::Set(tag, row.kick);
  for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(tag))) {
    V force_squared = hn::Zero(tag), force_speed = hn::Zero(tag);
    for (int m = 0; m < row.vectors; ++m) {
      const int k = m * vector_stride + lane;
      const double* inverse = row.inverse_mass + 2 * m * vector_stride + lane;
      const Three diagonal = load(inverse), off = load(inverse + vector_stride);  // off: xy, xz, yz
      const auto moves = hn::Gt(diagonal.x, hn::Zero(tag));
      const Three f = load(row.f + k), old = load(row.v + k);
      // Column by column of W kick: for a mass alike along all directions to the last bit that of RowMotion.
      const Three xs{hn::Mul(kick, diagonal.x), hn::Mul(kick, off.x), hn::Mul(kick, off.y)};
      const Three ys{xs.y, hn::Mul(kick, diagonal.y), hn::Mul(kick, off.z)};
      const Three zs{xs.z, ys.z, hn::Mul(kick, diagonal.z)};
      Three v = scaled(old, row.keep);
      v = {hn::MulAdd(xs.x, f.x, v.x), hn::MulAdd(ys.y, f.y, v.y), hn::MulAdd(zs.z, f.z, v.z)};
      v = {hn::MulAdd(ys.x, f.y, v.x), hn::MulAdd(xs.y, f.x, v.y), hn::MulAdd(xs.z, f.x, v.z)};
      v = {hn::MulAdd(zs.x, f.z, v.x), hn::MulAdd(zs.y, f.z, v.y), hn::MulAdd(ys.z, f.y, v.z)};
      force_squared = hn::Add(force_squared, hn::IfThenElseZero(moves, dot(f, f)));
      force_speed = hn::Add(force_speed, hn::IfThenElseZero(moves, dot(f, old + v)));
      store_where(moves, v, row.v + k);
      store_where(moves, load(row.x + k) + v, row.x + k);
    }
    hn::Store(force_squared, tag, squared + lane);
    hn::Store(force_speed, tag, power + lane);
  }
  RowSums total;
  for (int lane = 0; lane < lanes; ++lane) total.force_squared += squared[lane], total.power += power[lane];
  return total;
}

double AddRowForces(const RowForces& row) {
  switch (row.patch->degree) {
    case 1:
      return row_forces_of_degree<1>(row);
    case 2:
      return row_forces_of_degree<2>(row);
    case 3:
      return row_forces_of_degree<3>(row);
    default:
      return row_forces_of_degree<0>(row);
  }
}
void PullSprings(const SpringForces& job, int begin_block, int end_block) {
  if (!job.v) return pull_blocks<false, false>(job, begin_block, end_block);
  if (!job.record.peak) return pull_blocks<true, false>(job, begin_block, end_block);
  pull_blocks<true, true>(job, begin_block, end_block);
}
void AddRow(int count, const double* a, double* f) {
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(tag)))
    hn::Store(hn::Add(hn::Load(tag, f + i), hn::Load(tag, a + i)), tag, f + i);
}
double MoveRow(const RowMotion& row) {
  if (!row.area) return motion<Damping::none>(row);
  if (row.quadratic == 0) return motion<Damping::linear>(row);
  return motion<Damping::quadratic>(row);
}
// q contains p / 8: q times the cross product of the diagonals of a cell is a quarter of its load.
double PressureWork(const RowWork& row) {
  alignas(64) double sum[lanes] = {};
  for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(tag))) {
    V work = hn::Zero(tag);
    for (int m = 0; m < row.vectors; ++m) {
      const int k = m * vector_stride + lane;
      const auto corners = [&](const double* r0, const double* r1) {
        return std::array{load(r0 + k), load(r0 + k + vector_stride), load(r1 + k + vector_stride),
                          load(r1 + k)};
      };
      const auto now = corners(row.x0, row.x1), before = corners(row.before0, row.before1);
      const auto area = [](const std::array<Three, 4>& x) {
        const Three a = x[2] - x[0], d = x[3] - x[1];
        return Three{hn::NegMulAdd(a.z, d.y, hn::Mul(a.y, d.z)), hn::NegMulAdd(a.x, d.z, hn::Mul(a.z, d.x)),
                     hn::NegMulAdd(a.y, d.x, hn::Mul(a.x, d.y))};
      };
      const Three moved =
          (now[0] - before[0]) + (now[1] - before[1]) + (now[2] - before[2]) + (now[3] - before[3]);
      const V q = hn::Mul(hn::Set(tag, 0.5), hn::Load(tag, row.pressure + m * lanes + lane));
      work = hn::MulAdd(q, dot(area(now) + area(before), moved), work);
    }
    hn::Store(work, tag, sum + lane);
  }
  double total = 0;
  for (const double s : sum) total += s;
  return total;
}
const char* Target() {
  switch (HWY_TARGET) {
    case HWY_AVX3:
      return "AVX-512";
    case HWY_AVX2:
      return "AVX2";
    case HWY_SSE4:
      return "SSE4";
    default:
      return "scalar";
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ripstop::inline cloth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ripstop::inline cloth {

HWY_EXPORT(AddRowForces);
HWY_EXPORT(PullSprings);
HWY_EXPORT(AddRow);
HWY_EXPORT(MoveRow);
HWY_EXPORT(RelaxRow);
HWY_EXPORT(PressureWork);
HWY_EXPORT(Target);

double add_row_forces(const RowForces& row) {
  return HWY_DYNAMIC_DISPATCH(AddRowForces)(row);
}
void pull_springs(const SpringForces& job, int begin_block, int end_block) {
  HWY_DYNAMIC_DISPATCH(PullSprings)(job, begin_block, end_block);
}
void add_row(int count, const double* a, double* f) {
  HWY_DYNAMIC_DISPATCH(AddRow)(count, a, f);
}
double move_row(const RowMotion& row) {
  return HWY_DYNAMIC_DISPATCH(MoveRow)(row);
}
RowSums relax_row(const RowRelaxation& row) {
  return HWY_DYNAMIC_DISPATCH(RelaxRow)(row);
}
double pressure_work(const RowWork& row) {
  return HWY_DYNAMIC_DISPATCH(PressureWork)(row);
}
const char* kernel_target() {
  return HWY_DYNAMIC_DISPATCH(Target)();
}

}  // namespace ripstop::inline cloth
#endif
