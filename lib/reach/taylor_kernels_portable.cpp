#define COORDREQ_KERNEL_NAMESPACE portable_taylor
#define COORDREQ_VECTOR_BYTES 16
#include "reach/taylor_kernels_impl.hpp"
