#define COORDREQ_KERNEL_NAMESPACE portable_kernels
#define COORDREQ_VECTOR_BYTES 16
#include "engine/bit_kernels_impl.hpp"
#include "engine/level_kernels_impl.hpp"
#include "engine/sum_kernels_impl.hpp"
