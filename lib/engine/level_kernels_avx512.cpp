#define COORDREQ_KERNEL_NAMESPACE avx512_kernels
#define COORDREQ_VECTOR_BYTES 64
#include "engine/bit_kernels_impl.hpp"
#include "engine/level_kernels_impl.hpp"
#include "engine/sum_kernels_impl.hpp"
