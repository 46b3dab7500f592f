#include "engine/post_reader.hpp"

namespace coordreq {

template <class Level>
PostReader<Level>::PostReader(const RowEngine& engine, const LevelRows<Level>& levels)
    : engine_(engine), boxes_(engine, engine.posts(), engine.outer(), levels), posts_(&boxes_) {
  if (!engine.posts().is_cut()) posts_ = &sums_.emplace(engine, levels);
  for (const RowEngine::Demand& demand : engine.demands())
    tubes_.emplace_back(engine, demand.family, 0, *demand.inside);
  if (tubes_.empty()) return;
  one_.resize(engine.row_words());
  lanes_.resize(boxes_.lanes());
  result_.resize(boxes_.lanes());
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
