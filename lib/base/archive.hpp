#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "base/thread_team.hpp"

namespace coordreq {

enum class NumberKind : std::uint8_t { unsigned_integer, signed_integer, real };

/// Rows of numbers where they stand in memory, without what lies between the rows.
struct NumberRows {
  std::byte* first = nullptr;  ///< of the first row
  std::ptrdiff_t stride = 0;   ///< bytes from one row to the next
  std::int64_t rows = 0;
  std::int64_t row_length = 0;  ///< numbers
  NumberKind kind = NumberKind::unsigned_integer;
  std::int64_t number_bytes = 1;
  const std::uint32_t* slots = nullptr;  ///< [row] its number in memory; null: the row itself

  [[nodiscard]] std::byte* row(std::int64_t r) const {
    return first + (slots == nullptr ? r : std::int64_t{slots[r]}) * stride;
  }
  [[nodiscard]] std::int64_t row_bytes() const { return row_length * number_bytes; }

  /// The rows [begin, end).
  [[nodiscard]] NumberRows range(std::int64_t begin, std::int64_t end) const {
    NumberRows result = *this;
    result.rows = end - begin;
    if (slots == nullptr) {
      result.first = row(begin);
    } else {
      result.slots += begin;
    }
    return result;
  }
};

template <class Number>
[[nodiscard]] constexpr NumberKind kind_of_number() {
  static_assert(std::is_arithmetic_v<Number>);
  if constexpr (std::is_floating_point_v<Number>) return NumberKind::real;
  return std::is_signed_v<Number> ? NumberKind::signed_integer : NumberKind::unsigned_integer;
}

/// Rows of `row_length` numbers, `stride` numbers apart. What is only saved is not changed, const or not.
template <class Number>
[[nodiscard]] NumberRows number_rows(const Number* first, std::int64_t stride, std::int64_t rows,
                                     std::int64_t row_length) {
  void* address = const_cast<Number*>(first);
  return {static_cast<std::byte*>(address),
          static_cast<std::ptrdiff_t>(stride) * static_cast<std::ptrdiff_t>(sizeof(Number)),
          rows,
          row_length,
          kind_of_number<Number>(),
          sizeof(Number),
          nullptr};
}

/// Saves or loads the state of an object. Its serialise() hands the same lists to an archive in the same
/// order whether they are to be saved or loaded.
///
/// Loaded numbers are not trusted. Lists have their sizes before they are loaded, and an archive with another
/// number of numbers, or numbers of another kind, is refused. Which values are possible is up to serialise(),
/// which checks them by expect().
class Archive {
 public:
  virtual ~Archive() = default;
  [[nodiscard]] virtual bool is_loading() const = 0;

  /// Saves the numbers, or loads them to where they stand.
  virtual void rows(const NumberRows& rows) = 0;
  /// rows() for rows of a grid that several processes may have divided between them.
  /// @param local_rows the rows that this process answers for @param held the rows that it has to know,
  /// ascending
  virtual void grid_rows(const NumberRows& all, ThreadTeam::Range /*local_rows*/,
                         std::span<const ThreadTeam::Range> /*held*/) {
    rows(all);
  }

  template <class Number>
  void number(Number& number) {
    rows(number_rows(&number, 1, 1, 1));
  }
  template <class Number>
  void list(std::vector<Number>& list) {
    const auto count = static_cast<std::int64_t>(list.size());
    if (count > 0) rows(number_rows(list.data(), count, 1, count));
  }
  /// @param what is wrong otherwise: "a level is too high"; only looked at when loading
  void expect(bool holds, std::string_view what) {
    if (is_loading() && !holds) refuse(what);
  }

 protected:
  [[noreturn]] virtual void refuse(std::string_view what) const = 0;
};

}  // namespace coordreq
