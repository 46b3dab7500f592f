#define COORDREQ_KERNEL_NAMESPACE avx2_kernels
#define COORDREQ_VECTOR_BYTES 32
#include "engine/bit_kernels_impl.hpp"
#include "engine/level_kernels_impl.hpp"
#include "engine/sum_kernels_impl.hpp"
