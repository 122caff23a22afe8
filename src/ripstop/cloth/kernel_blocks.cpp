// The kernels of the relaxation's blocks (blocks.h), for every instruction set as in kernel.cpp.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "ripstop/cloth/kernel_blocks.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "ripstop/cloth/kernel.h"

HWY_BEFORE_NAMESPACE();
namespace ripstop::inline cloth {
namespace HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using BlockTag = hn::CappedTag<double, lanes>;
using BlockVector = hn::Vec<BlockTag>;
constexpr BlockTag block_tag;
constexpr int block_stride = 3 * lanes;  // doubles from one vector of a row to the next

void SumBlocks(const BlockSums& row) {
  for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(block_tag)))
    for (int chunk = 0; chunk < row.chunks; ++chunk) {
      BlockVector x = hn::Zero(block_tag), y = x, z = x;
      for (int m = row.edge[chunk]; m < row.edge[chunk + 1]; ++m) {
        const double* f = row.f + m * block_stride + lane;
        const auto moves =
            hn::Gt(hn::Load(block_tag, row.inverse_mass + 2 * m * block_stride + lane), hn::Zero(block_tag));
        x = hn::Add(x, hn::IfThenElseZero(moves, hn::Load(block_tag, f)));
        y = hn::Add(y, hn::IfThenElseZero(moves, hn::Load(block_tag, f + lanes)));
        z = hn::Add(z, hn::IfThenElseZero(moves, hn::Load(block_tag, f + 2 * lanes)));
      }
      double* sum = row.sum + chunk * block_stride + lane;
      hn::Store(x, block_tag, sum);
      hn::Store(y, block_tag, sum + lanes);
      hn::Store(z, block_tag, sum + 2 * lanes);
    }
}

void MoveBlocks(const BlockMotion& row) {
  for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(block_tag)))
    for (int chunk = 0; chunk < row.chunks; ++chunk) {
      const double* motion = row.motion + chunk * block_stride + lane;
      const BlockVector u[3] = {hn::Load(block_tag, motion), hn::Load(block_tag, motion + lanes),
                                hn::Load(block_tag, motion + 2 * lanes)};
      for (int m = row.edge[chunk]; m < row.edge[chunk + 1]; ++m) {
        const auto moves =
            hn::Gt(hn::Load(block_tag, row.inverse_mass + 2 * m * block_stride + lane), hn::Zero(block_tag));
        double *x = row.x + m * block_stride + lane, *v = row.v + m * block_stride + lane;
        // Other lanes are not touched: another thread may be moving them.
        for (int axis = 0; axis < 3; ++axis, x += lanes, v += lanes) {
          hn::BlendedStore(hn::Add(hn::Load(block_tag, v), u[axis]), moves, block_tag, v);
          hn::BlendedStore(hn::Add(hn::Load(block_tag, x), u[axis]), moves, block_tag, x);
        }
      }
    }
}

void MultiplyBlocks(const BlockProduct& job, int begin, int end) {
  const std::size_t group = static_cast<std::size_t>(lanes) * job.padded;
  for (int i = begin; i < end; i += 2 * lanes)
    for (int lane = 0; lane < lanes; lane += static_cast<int>(hn::Lanes(block_tag))) {
      const double* a = job.inverse + i / lanes * group + lane;
      BlockVector sum[6] = {hn::Zero(block_tag), hn::Zero(block_tag), hn::Zero(block_tag),
                            hn::Zero(block_tag), hn::Zero(block_tag), hn::Zero(block_tag)};
      for (int j = 0; j < job.padded; ++j) {
        const BlockVector a0 = hn::Load(block_tag, a + j * lanes);
        const BlockVector a1 = hn::Load(block_tag, a + group + j * lanes);
        for (int axis = 0; axis < 3; ++axis) {
          const BlockVector r = hn::Set(block_tag, job.r[axis * job.padded + j]);
          sum[axis] = hn::MulAdd(a0, r, sum[axis]);
          sum[3 + axis] = hn::MulAdd(a1, r, sum[3 + axis]);
        }
      }
      for (int axis = 0; axis < 3; ++axis) {
        double* y = job.y + axis * job.padded + i + lane;
        hn::Store(sum[axis], block_tag, y);
        hn::Store(sum[3 + axis], block_tag, y + lanes);
      }
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace ripstop::inline cloth
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ripstop::inline cloth {

HWY_EXPORT(SumBlocks);
HWY_EXPORT(MoveBlocks);
HWY_EXPORT(MultiplyBlocks);

void sum_blocks(const BlockSums& row) {
  HWY_DYNAMIC_DISPATCH(SumBlocks)(row);
}
void move_blocks(const BlockMotion& row) {
  HWY_DYNAMIC_DISPATCH(MoveBlocks)(row);
}
void multiply_blocks(const BlockProduct& job, int begin, int end) {
  HWY_DYNAMIC_DISPATCH(MultiplyBlocks)(job, begin, end);
}

}  // namespace ripstop::inline cloth
#endif
