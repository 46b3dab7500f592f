#include "answers/requirements/escape_news.hpp"

#include <vector>

namespace coordreq {

Bytes escape_message(const EscapeNews& news, const EscapePath& path, std::size_t inputs, std::size_t cells) {
  const bool has_step = path.joint_inputs.size() > inputs;
  std::vector<std::int64_t> numbers = {news.goes_on ? 1 : 0,
                                       news.has_more ? 1 : 0,
                                       news.way,
                                       news.reached.place.is_known ? 1 : 0,
                                       static_cast<std::int64_t>(news.reached.place.kind),
                                       news.reached.place.cell,
                                       news.reached.is_inside ? 1 : 0,
                                       news.reached.is_safe ? 1 : 0,
                                       static_cast<std::int64_t>(path.end),
                                       has_step ? path.joint_inputs.back() : -1,
                                       has_step ? static_cast<std::int64_t>(path.phases.back()) : -1,
                                       path.cells.size() > cells ? path.cells.back() : -1};
  for (const DomainSide& side : path.sides)
    numbers.insert(numbers.end(), {static_cast<std::int64_t>(side.dimension), side.above ? 1 : 0});
  Bytes message;
  put_numbers<std::int64_t>(message, numbers);
  return message;
}

EscapeNews read_escape_message(const Bytes& message, EscapePath& path) {
  MessageReader reader(message);
  EscapeNews news;
  news.goes_on = reader.number() != 0;
  news.has_more = reader.number() != 0;
  news.way = reader.number();
  news.reached.place.is_known = reader.number() != 0;
  news.reached.place.kind = static_cast<Location::Kind>(reader.number());
  news.reached.place.cell = reader.number();
  news.reached.is_inside = reader.number() != 0;
  news.reached.is_safe = reader.number() != 0;
  path.end = static_cast<EscapeEnd>(reader.number());
  const std::int64_t input = reader.number(), phase = reader.number(), cell = reader.number();
  if (input >= 0) path.joint_inputs.push_back(input);
  if (input >= 0) path.phases.push_back(static_cast<EscapePhase>(phase));
  if (cell >= 0) path.cells.push_back(cell);
  while (!reader.is_at_end()) {
    const auto dimension = static_cast<std::size_t>(reader.number());
    path.sides.push_back({dimension, reader.number() != 0});
  }
  return news;
}

}  // namespace coordreq
