#define COORDREQ_KERNEL_NAMESPACE avx2_taylor
#define COORDREQ_VECTOR_BYTES 32
#include "reach/taylor_kernels_impl.hpp"
