#pragma once

// The texts of an exported C header that do not depend on its tables, as format strings. $P stands for the
// prefix of its functions and tables, $M for that of its macros.
namespace coordreq::c_header {

inline constexpr char kOpening[] =
    R"c(/* Trigger table of "{name}", partition {partition}, written by coordreq.

   guarantee      {guarantee}
   spec SHA-256   {sha}
   states         {states}
{classes}
   C99, no library but <stdint.h>; hexadecimal floating-point constants are exact.
   Include it in one file only: the tables are static. */

#ifndef $M_H
#define $M_H

#include <stdint.h>
)c";

inline constexpr char kNumbers[] = R"c(
#define $M_STATES {dimensions}
#define $M_CELLS {cells}
#define $M_CLASSES {class_count}

/* Instead of a cell. */
#define $M_OUTSIDE (-1)     /* outside the domain: not covered by the results */
#define $M_LEFT_SAFELY (-2) /* beyond a side where the system is safe indefinitely */

/* Instead of a countdown in steps. */
#define $M_NEVER INT32_MAX             /* the classes never need to coordinate */
#define $M_NOT_INVARIANT (-1)          /* nothing keeps the system safe from here */
#define $M_NOT_SAFE (-2)               /* not safe now */
#define $M_CONNECTION_MUST_STAND (-3)  /* too late to connect */
)c";

inline constexpr char kCells[] = R"c(
/* The last of the `count` ascending bounds that is not above x; 0 if all are. */
static inline uint32_t $P_last_not_above(const double *bound, uint32_t count, double x) {{
  uint32_t low = 0, high = count;
  while (high - low > 1) {{
    const uint32_t middle = low + (high - low) / 2;
    if (bound[middle] <= x) {{
      low = middle;
    }} else {{
      high = middle;
    }}
  }}
  return low;
}}

/* Index of x in dimension i, -1 if it is beyond a side, -2 beyond a side that is safe. */
static inline int32_t $P_index(uint32_t i, double x) {{
  const double *bound = $P_bound + $P_bound_first[i];
  const uint32_t count = $P_bound_count[i];
  const uint32_t place = $P_last_not_above(bound, count, x);
  if (!(x >= bound[0])) return x < bound[0] && $P_safe_below[i] ? $M_LEFT_SAFELY : $M_OUTSIDE;
  if ($P_discrete[i]) {{
    if (x == bound[place]) return (int32_t)place;
    return x > bound[count - 1] && $P_safe_above[i] ? $M_LEFT_SAFELY : $M_OUTSIDE;
  }}
  if (place == count - 1) return $P_safe_above[i] ? $M_LEFT_SAFELY : $M_OUTSIDE;
  return $P_wraps[i] && place == $P_points[i] ? 0 : (int32_t)place;
}}

/* The cell of a measured state, $M_OUTSIDE or $M_LEFT_SAFELY. A periodic state must be given in its period
   [lower, upper); the double nearest to `lower` counts as in it. */
static inline int32_t $P_cell(const double state[$M_STATES]) {{
  int32_t cell = 0;
  int left = 0;
  uint32_t i;
  for (i = 0; i < $M_STATES; ++i) {{
    const int32_t index = $P_index(i, state[i]);
    if (index == $M_OUTSIDE) return $M_OUTSIDE;
    if (index == $M_LEFT_SAFELY) {{
      left = 1;
    }} else {{
      cell = cell * (int32_t)$P_points[i] + index;
    }}
  }}
  return left ? $M_LEFT_SAFELY : cell;
}}

/* Number of joint actions of class c; 0 if there is no such class. */
static inline uint32_t $P_action_count(uint32_t c) {{
  return c < $M_CLASSES ? $P_set_actions[c] : 0;
}}

/* The value of the j-th input of class c in its joint action a < $P_action_count(c): row-major, the last
   input fastest. */
static inline double $P_input(uint32_t c, uint32_t a, uint32_t j) {{
  uint32_t i = $P_class_first[c + 1] - 1;
  for (; i > $P_class_first[c] + j; --i) a /= $P_value_count[i];
  return $P_value[$P_value_first[i] + a % $P_value_count[i]];
}}
)c";

inline constexpr char kFunctions[] = R"c(
/* The entry of a cell, 0 <= cell < $M_CELLS. */
static inline uint32_t $P_entry_of(int32_t cell) {{
  uint32_t low = 0, high = $M_RUNS;
  while (high - low > 1) {{
    const uint32_t middle = low + (high - low) / 2;
    if ($P_start[middle] <= (uint32_t)cell) {{
      low = middle;
    }} else {{
      high = middle;
    }}
  }}
  return $P_entry[low];
}}

/* Steps until the agents must start to connect, or one of the numbers above. Of $M_LEFT_SAFELY it is
   $M_NEVER; of $M_OUTSIDE, and of any other number that is no cell, it is 0: connect now. */
static inline int32_t $P_countdown(int32_t cell) {{
  if (cell == $M_LEFT_SAFELY) return $M_NEVER;
  if (cell < 0 || cell >= $M_CELLS) return 0;
  return $P_entry_countdown[$P_entry_of(cell)];
}}

/* Whether class c may take its joint action a. In $M_LEFT_SAFELY every action is; in $M_OUTSIDE, and in any
   other number that is no cell, none is. */
static inline int $P_allowed(int32_t cell, uint32_t c, uint32_t a) {{
  uint32_t set;
  if (a >= $P_action_count(c)) return 0;
  if (cell == $M_LEFT_SAFELY) return 1;
  if (cell < 0 || cell >= $M_CELLS) return 0;
  set = $P_entry_set[$P_entry_of(cell) * $M_CLASSES + c];
  return $P_set_bits[$P_set_first[c] + set * $P_set_width[c] + a / 8] >> (a % 8) & 1;
}}
)c";

/// The function for a goal that ends the task.
inline constexpr char kTerminal[] = R"c(
/* Whether the task is over: in a cell of the goal, and in $M_LEFT_SAFELY. There nothing that follows matters, and
   what other functions say of actions is of no use. */
static inline int $P_is_over(int32_t cell) {{
  if (cell == $M_LEFT_SAFELY) return 1;
  if (cell < 0 || cell >= $M_CELLS) return 0;
  return $P_entry_over[$P_entry_of(cell)];
}}
)c";

/// The functions of a policy that does not hold everywhere.
inline constexpr char kPolicy[] = R"c(
/* {purpose} */
{codes}
/* {countdown} */
static inline int32_t $P_{policy}_countdown(int32_t cell) {{
  if (cell == $M_LEFT_SAFELY) return $M_NEVER;
  if (cell < 0 || cell >= $M_CELLS) return 0;
  return $P_entry_{policy}_countdown[$P_entry_of(cell)];
}}

/* {allowed} */
static inline int $P_{policy}_allowed(int32_t cell, uint32_t c, uint32_t a) {{
  uint32_t set;
  if (cell < 0 || cell >= $M_CELLS || a >= $P_action_count(c)) return $P_allowed(cell, c, a);
  set = $P_entry_{policy}_set[$P_entry_of(cell) * $M_CLASSES + c];
  return $P_set_bits[$P_set_first[c] + set * $P_set_width[c] + a / 8] >> (a % 8) & 1;
}}
)c";

inline constexpr char kMemory[] = R"c(
/* What memories keep are the last $M_KEPT states, all 0 at first. Their values before the next sample, as one
   number, row-major; negative if there is no such cell. */
static inline int32_t $P_remember(int32_t cell) {{
  uint32_t index[$M_STATES], i, k, rest = (uint32_t)cell;
  int32_t kept = 0;
  if (cell < 0 || cell >= $M_CELLS) return -1;
  for (i = $M_STATES; i-- > 0;) {{
    index[i] = rest % $P_points[i];
    rest /= $P_points[i];
  }}
  for (k = 0; k < $M_KEPT; ++k) {{
    uint32_t place = $P_next_first[k];
    for (i = 0; i < $M_STATES; ++i) place += index[i] * $P_next_stride[k * $M_STATES + i];
    kept = kept * (int32_t)$P_points[$M_STATES - $M_KEPT + k] + (int32_t)$P_next[place];
  }}
  return kept;
}}

/* The value of the k-th of these states, 0 <= k < $M_KEPT. */
static inline double $P_kept(int32_t kept, uint32_t k) {{
  uint32_t j = $M_KEPT - 1;
  for (; j > k; --j) kept /= (int32_t)$P_points[$M_STATES - $M_KEPT + j];
  return kept % (int32_t)$P_points[$M_STATES - $M_KEPT + k];
}}
)c";

/// Before all that an agent does not need who has nothing but silent tables.
inline constexpr char kSilentOnly[] = R"c(
/* With $M_SILENT_ONLY defined before this file is included there is nothing in it but $P_silent, and what that
   takes: all that a class needs that sees only some states, once it knows how many steps it may go on. */
#ifndef $M_SILENT_ONLY
)c";

inline constexpr char kSilent[] = R"c(
/* Whether class c may take its joint action a during silence, with this number of steps left ($M_NEVER:
   unlimited). Only the states that the class sees are read. Beyond a side where the system is safe indefinitely
   every action is permitted; with no step left, and outside the domain, none is. For a class that sees all
   states this is $P_allowed, which does not exist with $M_SILENT_ONLY. */
static inline int $P_silent(uint32_t c, const double state[$M_STATES], int32_t steps, uint32_t a) {{
  uint32_t i, place;
  int left = 0;
  if (c >= $M_CLASSES || a >= $P_set_actions[c] || steps <= 0) return 0;
  if ($P_silent_rows[c] == 0) {{
#ifndef $M_SILENT_ONLY
    return $P_allowed($P_cell(state), c, a);
#else
    return 0;
#endif
  }}
  place = $P_silent_first[c] + a / 8;
  place += ((uint32_t)steps < $P_silent_rows[c] ? (uint32_t)steps - 1 : $P_silent_rows[c] - 1) *
           $P_silent_stride[c * ($M_STATES + 1) + $M_STATES];
  for (i = 0; i < $M_STATES; ++i) {{
    const uint32_t stride = $P_silent_stride[c * ($M_STATES + 1) + i];
    const int32_t index = stride == 0 ? 0 : $P_index(i, state[i]);
    if (index == $M_OUTSIDE) return 0;
    if (index == $M_LEFT_SAFELY) {{
      left = 1;
    }} else {{
      place += (uint32_t)index * stride;
    }}
  }}
  return left ? 1 : $P_silent_bits[place] >> (a % 8) & 1;
}}
)c";

inline constexpr char kClosing[] = "\n#endif\n";

}  // namespace coordreq::c_header
