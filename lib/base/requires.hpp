#pragma once

#include <cassert>

/// A precondition, at the top of the body of a function: checked where assertions are on (`dev`, and under
/// sanitisers), and ends the program where it does not hold. In a release the condition is compiled and never
/// evaluated.
///
/// In docstrings `@pre` says it as text, and `@pre unchecked:` what cannot be checked cheaply, such as that
/// an argument outlives an object.
#ifdef NDEBUG
#define REQUIRES(...) static_cast<void>(sizeof(static_cast<bool>(__VA_ARGS__)))
#else
#define REQUIRES(...) assert((__VA_ARGS__))
#endif
