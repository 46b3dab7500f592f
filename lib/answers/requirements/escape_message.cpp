#include "answers/requirements/escape_message.hpp"

#include <vector>

namespace coordreq {

Bytes escape_message(const EscapeProgress& progress, const EscapePath& path, std::size_t inputs,
                     std::size_t cells) {
  const bool has_step = path.joint_inputs.size() > inputs;
  std::vector<std::int64_t> numbers = {progress.goes_on ? 1 : 0,
                                       progress.has_more ? 1 : 0,
                                       progress.way,
                                       progress.reached.place.is_known ? 1 : 0,
                                       static_cast<std::int64_t>(progress.reached.place.kind),
                                       progress.reached.place.cell,
                                       progress.reached.is_inside ? 1 : 0,
                                       progress.reached.is_safe ? 1 : 0,
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

EscapeProgress read_escape_message(const Bytes& message, EscapePath& path) {
  MessageReader reader(message);
  EscapeProgress progress;
  progress.goes_on = reader.number() != 0;
  progress.has_more = reader.number() != 0;
  progress.way = reader.number();
  progress.reached.place.is_known = reader.number() != 0;
  progress.reached.place.kind = static_cast<Location::Kind>(reader.number());
  progress.reached.place.cell = reader.number();
  progress.reached.is_inside = reader.number() != 0;
  progress.reached.is_safe = reader.number() != 0;
  path.end = static_cast<EscapeEnd>(reader.number());
  const std::int64_t input = reader.number(), phase = reader.number(), cell = reader.number();
  if (input >= 0) path.joint_inputs.push_back(input);
  if (input >= 0) path.phases.push_back(static_cast<EscapePhase>(phase));
  if (cell >= 0) path.cells.push_back(cell);
  while (!reader.is_at_end()) {
    const auto dimension = static_cast<std::size_t>(reader.number());
    path.sides.push_back({dimension, reader.number() != 0});
  }
  return progress;
}

}  // namespace coordreq
