#define COORDREQ_KERNEL_NAMESPACE avx512_kernels
#define COORDREQ_VECTOR_BYTES 64
#include "bitset/bit_kernels_impl.hpp"
#include "bitset/level_kernels_impl.hpp"
#include "bitset/sum_kernels_impl.hpp"
