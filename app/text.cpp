#include "app/text.hpp"
#include "base/requires.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace coordreq {
namespace {

/// Bytes of the UTF-8 character that `text` begins with; 0 if it begins with none that may be printed.
std::size_t printable_length(std::string_view text) {
  const auto byte = [text](std::size_t i) -> std::uint32_t {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  const std::size_t length = lead >= 0xf0 && lead < 0xf5   ? 4
                             : lead >= 0xe0 && lead < 0xf0 ? 3
                             : lead >= 0xc2 && lead < 0xe0 ? 2
                                                           : 0;
  if (length == 0) return 0;
  std::uint32_t code = lead & (0x7fU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
    code = code << 6U | (byte(i) & 0x3fU);
  }
  constexpr std::uint32_t kFirstOfLength[] = {0, 0, 0xa0, 0x800, 0x10000};  // U+0080 to U+009F are controls
  const bool surrogate = code >= 0xd800 && code < 0xe000;
  return code >= kFirstOfLength[length] && code < 0x110000 && !surrogate ? length : 0;
}

std::string spelt_out(char c) {
  switch (c) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  }
}

/// Columns on the terminal, near enough: characters, whatever their width.
std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    result += length > 0 ? std::string(text.substr(0, length)) : spelt_out(text.front());
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::string shortened(std::string_view text, std::size_t most, std::size_t at_end) {
  REQUIRES(most > at_end + 3);
  if (text.size() <= most) return std::string(text);
  const auto is_inside = [text](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
  };
  std::size_t begin = most - at_end - 3;
  while (begin > 0 && is_inside(begin)) --begin;
  std::size_t end = text.size() - at_end;
  while (end < text.size() && is_inside(end)) ++end;
  return std::string(text.substr(0, begin)) + "..." + std::string(text.substr(end));
}

std::string echoed(std::string_view text) {
  constexpr std::size_t kMost = 200, kAtEnd = 20;
  return "'" + shortened(printable(text), kMost, kAtEnd) + "'";
}

std::string column_heading(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{} [{}]", name, printable(unit));
}

std::string cells(std::int64_t count) {
  REQUIRES(count >= 0);
  return grouped(count) + (count == 1 ? " cell" : " cells");
}

std::string byte_size(std::uint64_t bytes) {
  constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  auto size = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (size >= 1024 && unit + 1 < std::size(kUnits)) {
    size /= 1024;
    ++unit;
  }
  return unit == 0 ? fmt::format("{} bytes", bytes)
                   : fmt::format("{:.{}f} {}", size, size < 10 ? 1 : 0, kUnits[unit]);
}

std::string duration(std::int64_t steps, double period, std::string_view unit) {
  const std::string count = fmt::format("{} step{}", grouped(steps), steps == 1 ? "" : "s");
  if (unit.empty()) return count;
  return fmt::format("{} ({:.6g} {})", count, static_cast<double>(steps) * period, printable(unit));
}

std::string rough_amount(double value, std::string_view unit) {
  REQUIRES(value >= 0);
  constexpr double kAllDigits = 1e3, kWhole = 1e15;
  const std::string number = value < kAllDigits || value > kWhole
                                 ? fmt::format("{:.3g}", value)
                                 : grouped(static_cast<std::uint64_t>(std::llround(value)));
  return unit.empty() ? number : fmt::format("{} {}", number, printable(unit));
}

std::string time_span(double seconds) {
  REQUIRES(seconds >= 0);
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const double whole = std::round(seconds);
  if (whole < 60) return fmt::format("{:.0f} s", whole);
  const auto two = [](double number, double unit, const char* large, double small_unit, const char* small) {
    const double many = std::floor(number / unit);
    return fmt::format("{:.0f} {} {:.0f} {}", many, large, std::floor((number - many * unit) / small_unit),
                       small);
  };
  if (whole < 3600) return two(whole, 60, "min", 1, "s");
  if (whole < 2 * 86400) return two(whole, 3600, "h", 60, "min");
  return two(whole, 86400, "days", 3600, "h");
}

std::string guarantee_text(std::string_view guarantee) {
  const std::string name = printable(guarantee);
  if (guarantee == "samples") return name + ": at the sampling instants, for every point of a cell";
  if (guarantee == "samples-center")
    return name + ": at the sampling instants, where the centre of a cell is safe";
  if (guarantee == "continuous") return name + ": at all times, for every point of a cell";
  return name;
}

std::string shortened(const std::vector<std::int64_t>& numbers) {
  constexpr std::size_t kHead = 6, kTail = 3, kSaved = 3;
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers.size() >= kHead + kTail + kSaved && i == kHead) {
      text += " ...";
      i = numbers.size() - kTail;
    }
    text += (text.empty() ? "" : " ") + grouped(numbers[i]);
  }
  return text;
}

std::size_t Table::aligned(const std::vector<std::string>& row) const {
  return row.size() - (row.size() < columns_.size() ? 1 : 0);
}

void Table::add(std::vector<std::string> row) {
  widen(row);
  rows_.push_back(std::move(row));
}

void Table::widen(const std::vector<std::string>& row) {
  for (std::size_t i = 0; i < aligned(row); ++i) widths_[i] = std::max(widths_[i], character_count(row[i]));
}

std::string Table::line(const std::vector<std::string>& row) const {
  std::string line;
  for (std::size_t i = 0; i < aligned(row); ++i) {
    const std::size_t length = character_count(row[i]);
    const std::string padding(widths_[i] - std::min(length, widths_[i]), ' ');
    line += (i == 0 ? "" : "  ") + (columns_[i] == Align::left ? row[i] + padding : padding + row[i]);
  }
  if (aligned(row) < row.size()) line += (line.empty() ? "" : "  ") + row.back();
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::string Table::text() const {
  std::string text;
  for (const auto& row : rows_) text += line(row);
  return text;
}

}  // namespace coordreq
