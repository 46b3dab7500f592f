#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/json.hpp"
#include "numeric/rational.hpp"
#include "spec/json_text.hpp"
#include "spec/read_tables.hpp"
#include "spec/set_value.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Node = JsonDocument::Node;
using Texts = std::vector<std::string>;

constexpr std::uintmax_t kMostBytesOfTable = std::uintmax_t{1} << 20U;

/// A number as it stands in a file, and what it is.
struct Cell {
  std::string text;
  Rational value;
  bool operator<(const Cell& other) const { return value < other.value; }
};

/// A number as JSON may have it in a spec: one that is typed in another way is a text.
std::string as_json(const Cell& cell) {
  return is_json(cell.text) ? cell.text : '"' + cell.text + '"';
}

template <class Cells>
std::string list_of(const Cells& cells) {
  Texts texts;
  for (const Cell& cell : cells) texts.push_back(as_json(cell));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

/// Lines of numbers below a line with the names of the columns: x and value, or x, y and value.
class TableFile {
 public:
  TableFile(std::string path, std::string pointer) : path_(std::move(path)), pointer_(std::move(pointer)) {
    std::istringstream text(read());
    for (std::string line; std::getline(text, line);) {
      ++line_;
      if (line_ == 1) line = std::string(without_byte_order_mark(line));
      if (trimmed(line).empty() || line.front() == '#') continue;
      if (columns_.empty()) {
        columns_ = csv_columns(line, refusal());
        find_columns();
      } else {
        add(csv_values(line, columns_.size(), refusal()));
      }
    }
    if (columns_.empty()) fail("expected a line with the columns 'x' and 'value', found nothing");
  }

  /// "x", "y" and "value" of a table, as JSON.
  [[nodiscard]] std::string members() const {
    if (!has_y_) return fmt::format(R"("x": {}, "value": {})", list_of(x_), list_of(value_));
    std::map<Cell, std::map<Cell, Cell>> rows;  // by y, then x
    std::map<Cell, bool> axis;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      axis.emplace(x_[i], true);
      if (!rows[y_[i]].emplace(x_[i], value_[i]).second)
        fail(fmt::format("the value at x = {}, y = {} stands there twice", x_[i].text, y_[i].text));
    }
    std::vector<Cell> x, y;
    for (const auto& [cell, unused] : axis) x.push_back(cell);
    Texts lists;
    for (const auto& [cell, row] : rows) {
      y.push_back(cell);
      lists.push_back(list_of(complete(row, x, cell)));
    }
    return fmt::format(R"("x": {}, "y": {}, "value": [{}])", list_of(x), list_of(y), fmt::join(lists, ", "));
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw SpecError(fmt::format("{}: {}", one_line(path_), what), pointer_);
  }
  [[noreturn]] void fail_at_line(const std::string& what) const {
    fail(fmt::format("line {}, {}", line_, what));
  }

  [[nodiscard]] RefuseLine refusal() const {
    return [this](const std::string& what) { fail_at_line(what); };
  }

  [[nodiscard]] std::string read() const {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path_, error);
    if (status.type() == std::filesystem::file_type::not_found) fail("no such file");
    if (!std::filesystem::is_regular_file(status)) fail("is no file, expected one with a table");
    if (std::filesystem::file_size(path_, error) > kMostBytesOfTable)
      fail("longer than 1 MiB, expected a table");
    errno = 0;
    std::ifstream file(path_, std::ios::binary);
    std::ostringstream text;
    if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    if (!file.is_open() || file.bad())
      fail("cannot be read: " + std::generic_category().message(errno == 0 ? EIO : errno));
    if (!is_utf8(text.str())) fail("is no UTF-8 text, expected a table");
    return text.str();
  }

  [[nodiscard]] std::size_t column(const std::string& name) const {
    const auto found = std::find(columns_.begin(), columns_.end(), name);
    return static_cast<std::size_t>(found - columns_.begin());
  }

  void find_columns() {
    for (const char* name : {"x", "value"}) {
      if (column(name) == columns_.size())
        fail_at_line(
            fmt::format("expected a column {}, found {}", quote_text(name), quote_list(columns_, "and")));
    }
    has_y_ = column("y") < columns_.size();
  }

  void add(const Texts& cells) {
    const Cell x = number(cells[column("x")]);
    if (!has_y_ && !x_.empty() && x.value <= x_.back().value)
      fail_at_line(fmt::format("expected x > {}, found {}", x_.back().text, x.text));
    x_.push_back(x);
    if (has_y_) y_.push_back(number(cells[column("y")]));
    value_.push_back(number(cells[column("value")]));
  }

  [[nodiscard]] Cell number(std::string_view field) const {
    const std::string text(trimmed(field));
    const std::optional<Rational> value = parse_decimal(text);
    if (!value) fail_at_line("expected a number, found " + quote_text(text));
    return {text, *value};
  }

  [[nodiscard]] std::vector<Cell> complete(const std::map<Cell, Cell>& row, const std::vector<Cell>& x,
                                           const Cell& y) const {
    std::vector<Cell> values;
    for (const Cell& column : x) {
      const auto found = row.find(column);
      if (found == row.end()) fail(fmt::format("no value at x = {}, y = {}", column.text, y.text));
      values.push_back(found->second);
    }
    return values;
  }

  std::string path_;
  std::string pointer_;
  std::size_t line_ = 0;
  Texts columns_;
  bool has_y_ = false;
  std::vector<Cell> x_, y_, value_;
};

/// Whether there is a file to read. What the schema will refuse is left as it is.
bool has_file(const Node& table) {
  if (!table.is_object() || !table.has("file") || !table["file"].is_text()) return false;
  const Texts keys = table.keys();
  return std::ranges::all_of(keys, [](const std::string& key) {
    return key == "file" || key == "outside" || key == "x" || key == "y" || key == "value";
  });
}

/// The table as JSON, with its values. @param path of its file
std::string with_values(const Node& table, const std::string& path) {
  for (const char* key : {"x", "y", "value"}) {
    if (table.has(key))
      throw SpecError(fmt::format("expected no {} beside 'file'", quote_text(key)), table[key].pointer());
  }
  const TableFile content(path, table["file"].pointer());
  std::string members = content.members();
  if (table.has("outside")) members += fmt::format(R"(, "outside": {})", table["outside"].json());
  return "{" + members + "}";
}

}  // namespace

SpecWithTables with_table_files(const SpecSource& source) {
  SpecWithTables spec{source.text, {}};
  if (source.text.find("\"tables\"") == std::string::npos) return spec;
  const JsonDocument document = JsonDocument::parse(source.text, source.name);
  const Node root = document.root();
  if (!root.is_object() || !root.has("tables") || !root["tables"].is_object()) return spec;
  for (const std::string& name : root["tables"].keys()) {
    const Node table = root["tables"][name];
    if (!has_file(table)) continue;
    spec.files.push_back((std::filesystem::path(source.folder) / table["file"].text()).string());
    spec.text =
        with_setting(spec.text, source.name, {table.pointer(), with_values(table, spec.files.back())});
  }
  return spec;
}

}  // namespace coordreq
