#include "reach/taylor_kernels.hpp"

#include "base/fast_paths.hpp"

namespace coordreq {

namespace portable_taylor {
extern const TaylorKernels kTaylorKernels;
}
#if COORDREQ_X86_KERNELS
namespace avx2_taylor {
extern const TaylorKernels kTaylorKernels;
}
#endif

const TaylorKernels& portable_taylor_kernels() {
  return portable_taylor::kTaylorKernels;
}

const TaylorKernels& taylor_kernels() {
#if COORDREQ_X86_KERNELS
  if (fast_paths().vector_instructions && __builtin_cpu_supports("avx2")) return avx2_taylor::kTaylorKernels;
#endif
  return portable_taylor::kTaylorKernels;
}

}  // namespace coordreq
