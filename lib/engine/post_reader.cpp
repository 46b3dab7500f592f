#include "engine/post_reader.hpp"

#include <algorithm>
#include <utility>

namespace coordreq {

template <class Level>
PostReader<Level>::Common::Common(const RowEngine& engine)
    : patches(engine.posts().is_cut() ? nullptr : std::make_shared<SumPatches<Level>>(engine)) {}

template <class Level>
PostReader<Level>::PostReader(const RowEngine& engine, const LevelRows<Level>& levels)
    : PostReader(engine, levels, std::make_shared<Common>(engine)) {}

template <class Level>
PostReader<Level>::PostReader(const PostReader& other)
    : PostReader(other.engine_, *other.levels_, other.common_) {}

template <class Level>
PostReader<Level>::PostReader(const RowEngine& engine, const LevelRows<Level>& levels,
                              std::shared_ptr<Common> common)
    : engine_(engine),
      levels_(&levels),
      common_(std::move(common)),
      boxes_(engine, engine.posts(), engine.outer(), levels) {
  if (common_->patches) sums_.emplace(engine, common_->patches);
  for (const RowEngine::Demand& demand : engine.demands())
    tubes_.emplace_back(engine, demand.family, 0, *demand.inside);
  if (tubes_.empty()) return;
  one_.resize(engine.row_words());
  lanes_.resize(boxes_.lanes());
  result_.resize(boxes_.lanes());
}

template <class Level>
void PostReader<Level>::forget() const {
  ++common_->epoch;
  if (common_->patches) common_->patches->forget();
}

template <class Level>
void PostReader<Level>::for_each_local_row(ThreadTeam& team, const ThreadTeam::Body& body) const {
  constexpr std::int64_t kMostRows = 64;
  const RowShare::Range local = local_rows(engine_.share(), engine_.rows());
  const std::int64_t units = std::min(units_at_once(team.size()), engine_.rows() / engine_.unit_rows());
  const std::int64_t group = units * engine_.unit_rows();
  const std::int64_t of_task =
      sums_ && team.size() > 1 ? group / (kTasksOfThread * team.size()) : engine_.unit_rows();
  for (RowShare::Range rows{local.begin, 0}; rows.begin < local.end; rows.begin = rows.end) {
    rows.end = std::min((rows.begin / group + 1) * group, local.end);
    forget();
    team.for_each(rows.end - rows.begin, std::clamp<std::int64_t>(of_task, 1, kMostRows),
                  [&](ThreadTeam::Range range, int worker) {
                    body({rows.begin + range.begin, rows.begin + range.end}, worker);
                  });
  }
}

template <class Level>
const Level* PostReader<Level>::with_tubes(std::span<const std::uint32_t> ids, const Level* levels) {
  const auto n = static_cast<std::size_t>(engine_.row_length());
  safe_.assign(engine_.row_words(), 0);
  std::size_t first = engine_.tables();
  for (BoxReader<std::uint8_t>& reader : tubes_) {
    const std::uint8_t* inside = reader.minimum(ids.subspan(first, engine_.tables()));
    reader.kernels().top_bits(inside, one_.data(), n);
    for (std::size_t w = 0; w < one_.size(); ++w) safe_[w] |= one_[w];
    first += engine_.tables();
  }
  kernels().spread(safe_.data(), lanes_.data(), n);
  result_.assign(boxes_.lanes(), 0);
  kernels().raise_where(levels, lanes_.data(), result_.data(), n);
  return result_.data();
}

template class PostReader<std::uint8_t>;
template class PostReader<std::uint16_t>;
template class PostReader<std::uint32_t>;
template class PostReader<std::uint64_t>;

}  // namespace coordreq
