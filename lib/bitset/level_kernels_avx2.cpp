#define COORDREQ_KERNEL_NAMESPACE avx2_kernels
#define COORDREQ_VECTOR_BYTES 32
#include "bitset/bit_kernels_impl.hpp"
#include "bitset/level_kernels_impl.hpp"
#include "bitset/sum_kernels_impl.hpp"
