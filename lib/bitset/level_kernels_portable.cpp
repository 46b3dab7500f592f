#define COORDREQ_KERNEL_NAMESPACE portable_kernels
#define COORDREQ_VECTOR_BYTES 16
#include "bitset/bit_kernels_impl.hpp"
#include "bitset/level_kernels_impl.hpp"
#include "bitset/sum_kernels_impl.hpp"
